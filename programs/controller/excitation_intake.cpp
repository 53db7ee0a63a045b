#include "programs/controller/excitation_intake.hpp"

#include <exception>
#include <utility>

#include "configuration/excitation_request.hpp"
#include "rt/thread_trouble.hpp"

namespace levitas::controller_program {

ExcitationIntake::ExcitationIntake(const RigNumbers& rig, CommandInbox& inbox,
                                   const StopLatch& stops, Refused refused)
    : rig_(rig), inbox_(inbox), stops_(stops), refused_(std::move(refused)) {
  thread_ = std::thread([this] { Run(); });
}

ExcitationIntake::~ExcitationIntake() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

bool ExcitationIntake::Take(const transport::NetworkExcitation& request) {
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() >= kWaiting) return false;
    waiting_.push_back(request);
  }
  changed_.notify_all();
  return true;
}

void ExcitationIntake::EndWaiting() {
  const std::lock_guard lock(mutex_);
  to_end_ = waiting_.size() + (at_work_ ? 1 : 0);
}

/// Of the request at work, which this takes from the bench; under the lock.
bool ExcitationIntake::Ended() noexcept {
  at_work_ = false;
  if (to_end_ == 0) return false;
  --to_end_;
  return true;
}

void ExcitationIntake::Run() {
  for (;;) {
    transport::NetworkExcitation request;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return closing_ || !waiting_.empty(); });
      if (closing_) return;
      request = std::move(waiting_.front());
      waiting_.pop_front();
      at_work_ = true;
    }
    rt::Guarded("test signals", [&] {
      std::string why;
      try {
        why = Try(request);
      } catch (const std::exception& problem) {  // a stranger's text: whatever is wrong with it
        const std::lock_guard lock(mutex_);
        (void)Ended();
        why = problem.what();
      }
      if (!why.empty()) refused_("command excite refused: " + why, request.origin);
    });
  }
}

/// Empty when the arbiter has it.
std::string ExcitationIntake::Try(const transport::NetworkExcitation& request) {
  const scenario::Step step = configuration::ParseExcitation(request.step_yaml, "request", rig_);
  loop::ExcitationPool::Slot* place = shelf_.Put(step, rig_.period_s());
  std::string why = HandOver(request, place);
  if (!why.empty() && place != nullptr) loop::ExcitationPool::GiveBack(place);
  return why;
}

// Under one lock with the end of what waits: the command that ends a signal is never before it in
// the inbox.
std::string ExcitationIntake::HandOver(const transport::NetworkExcitation& request,
                                       loop::ExcitationPool::Slot* place) {
  const std::lock_guard lock(mutex_);
  if (Ended()) return "it was ended before it began";
  if (request.stops_before < stops_.asked()) return "an emergency stop came before it began";
  if (place == nullptr) return "too many at once";
  const bool posted = inbox_.Post({.command = OperatorCommand::kExcite,
                                   .excitation = place,
                                   .origin = request.origin,
                                   .stops_before = request.stops_before});
  return posted ? "" : "too many commands at once";
}

}  // namespace levitas::controller_program
