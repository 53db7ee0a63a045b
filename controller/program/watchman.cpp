#include "controller/program/watchman.hpp"

#include <fmt/core.h>

#include <chrono>
#include <thread>
#include <utility>

#include "controller/rt/clock.hpp"
#include "controller/rt/say.hpp"
#include "controller/rt/stop_signal.hpp"
#include "controller/rt/thread_trouble.hpp"

namespace levitas::controller_program {

namespace {
constexpr auto kLookEvery = std::chrono::milliseconds(20);
}  // namespace

Watchman::Watchman(loop::ControlLoop& loop, loop::CommandArbiter& desk,
                   const ControllerOptions& options, const RigConnection& rig,
                   const gpio::GpiodLines* lines, std::function<void()> tell_news)
    : loop_(loop),
      desk_(desk),
      options_(options),
      rig_(rig),
      lines_(lines),
      tell_news_(std::move(tell_news)),
      partner_(rt::MonotonicNowNs(), static_cast<std::int64_t>(options.partner_timeout_s * 1e9)) {}

bool Watchman::Watch(const std::atomic<bool>& running) noexcept {
  while (running.load()) {
    std::this_thread::sleep_for(kLookEvery);
    if (running.load()) rt::Guarded("main", [this] { Look(); });
  }
  return stayed_;
}

void Watchman::Look() {
  LookAtGuard();
  LookAtPartner();
  tell_news_();
  if (rt::QuitSignal()) {
    if (landing_since_ns_ == 0) desk_.RequestEmergencyStop();
    Land("emergency stop by SIGQUIT");
  }
  const int asked = rt::StopSignals();
  if (asked > 0) Land("landing, asked by a signal (the same signal again ends at once)");
  if (rt::Troubles() > 0) Land("landing, since a thread failed");
  if (landing_since_ns_ == 0) return;
  const bool overdue = rt::MonotonicNowNs() - landing_since_ns_ > kLandingLimitNs;
  // Without a rig there is nothing to land; who asks again does not wait for it.
  if (asked > 1 || overdue || !partner_.present()) loop_.Abort();
}

void Watchman::Land(const char* why) {
  if (landing_since_ns_ != 0) return;
  desk_.RequestStop();
  landing_since_ns_ = rt::MonotonicNowNs();
  rt::Say(fmt::format("amb-controller: {}", why));
}

void Watchman::LookAtGuard() {
  if (!guarded_ || lines_ == nullptr || lines_->guard_alive()) return;
  guarded_ = false;
  Land("the guard of the enable line has ended: landing");
}

void Watchman::LookAtPartner() {
  if (!stayed_) return;
  using Word = transport::PartnerWatch::Say;
  const Word word = partner_.Check(rt::MonotonicNowNs(), loop_.frames_heard());
  if (word == Word::kFound) rt::Say("amb-controller: rig found");
  if (word == Word::kMissing) {
    const std::string remedy =
        rig_.virtual_rig()
            ? fmt::format("start {} with the same --rig, --port and --pace", rig_.SimulatedRig())
            : "is the rig powered, and does candump show its positions (0x110)?";
    rt::Say(fmt::format(
        "amb-controller: no sensor frames at {}; {} (giving up {} s after its last message)",
        rig_.Where(), remedy, options_.partner_timeout_s));
  }
  if (word != Word::kGiveUp) return;
  rt::Say(fmt::format("amb-controller: no rig for {} s, ending", options_.partner_timeout_s));
  loop_.Abort();
  stayed_ = false;
}

}  // namespace levitas::controller_program
