#include "benchmark/lives/virtual_bench.hpp"

#include <algorithm>
#include <utility>

namespace levitas::lives {

VirtualBench::VirtualBench(const BenchOptions& options,
                           std::shared_ptr<const plant::PlantModel> model)
    : options_(options),
      plant_(std::move(model), options.seed),
      frames_(options.frame_way_ns, options.keeps_order, options.seed + 1),
      currents_(options.current_way_ns, options.keeps_order, options.seed + 2),
      fiber_([this] { RunRig(); }) {
  plant_.RestInTouchdown();
}

VirtualBench::~VirtualBench() {
  over_ = true;
  while (!fiber_.ended()) {
    if (rig_ != nullptr) rig_->Stop();
    fiber_.Resume();
  }
}

void VirtualBench::RunRig() {
  while (!over_) {
    // Statistics of a loop are too much for the fiber's stack.
    const auto rig = std::make_unique<plant_run::PlantLoop>(
        plant_run::PlantLoopOptions{.realtime = true,
                                    .period_ns = options_.period_ns,
                                    .rig_session = rig_session_++,
                                    .stay = true,
                                    .watchdog_periods = options_.watchdog_periods},
        plant_, link_, rig_clock_);
    rig_ = rig.get();
    rig->Run();
    rig_ = nullptr;
    RestBetweenRigs();
  }
}

void VirtualBench::RestBetweenRigs() {
  const std::int64_t until_ns = rig_ns_ + rig_off_ns_;
  while (!over_ && rig_ns_ < until_ns) {
    SensorFrame nobody_s = plant_.Sample();
    if (on_sample) on_sample(rig_ns_, plant_, false, nobody_s);
    plant_.Advance({.amplifiers_enabled = false});
    rig_clock_.SleepUntil(rig_ns_ + options_.period_ns);
  }
  frames_.Forget();
  CurrentLetter unheard;
  (void)currents_.TakeLast(rig_ns_, unheard);
}

void VirtualBench::RestartRig(std::int64_t off_ns) noexcept {
  rig_off_ns_ = off_ns;
  if (rig_ != nullptr) rig_->Stop();
}

void VirtualBench::LetRigRun(std::int64_t until_ns) noexcept {
  while (rig_wake_ns_ <= until_ns && !fiber_.ended()) fiber_.Resume();
}

void VirtualBench::Pass(std::int64_t until_ns) {
  LetRigRun(until_ns);
  now_ns_ = std::max(now_ns_, until_ns);
}

void VirtualBench::ControllerClock::SleepUntil(std::int64_t due_ns) noexcept {
  if (bench_.dead_) return;
  const std::int64_t late_ns = std::exchange(bench_.stall_ns_, 0);
  bench_.Pass(due_ns + late_ns);
  if (bench_.on_wait) bench_.on_wait(bench_.now_ns_);
}

void VirtualBench::RigClock::SleepUntil(std::int64_t due_ns) noexcept {
  if (bench_.over_ || due_ns <= bench_.rig_ns_) return;
  bench_.rig_wake_ns_ = due_ns;
  bench_.fiber_.Yield();
  bench_.rig_ns_ = due_ns;
}

port::ReadResult VirtualBench::Port::Read(SensorFrame& frame, std::int64_t deadline_ns) noexcept {
  while (!bench_.dead_) {
    // As the sockets read: of what is queued the newest, which is not always the last to arrive.
    SensorFrame next;
    bool found = false;
    while (bench_.frames_.TakeNext(bench_.now_ns_, next)) {
      if (found && next.rig_session == frame.rig_session && next.cycle < frame.cycle) continue;
      frame = next;
      found = true;
    }
    if (found) return port::ReadResult::kFrame;
    if (bench_.now_ns_ >= deadline_ns) break;
    // Up to the next frame that is under way, or the rig's next turn, which may send one.
    const std::int64_t next_ns = std::min(bench_.frames_.NextArrival(), bench_.rig_wake_ns_);
    bench_.Pass(std::clamp(next_ns, bench_.now_ns_, deadline_ns));
  }
  return port::ReadResult::kNothing;
}

bool VirtualBench::Port::Write(const CurrentFrame& frame) noexcept {
  if (bench_.dead_) return true;
  bench_.currents_.Send({frame, false}, bench_.currents_sent_++,
                        bench_.now_ns_ + bench_.options_.compute_ns);
  return true;
}

void VirtualBench::Port::SayGoodbye(const CurrentFrame& last) noexcept {
  for (int time = 0; time < 3 && !bench_.dead_; ++time) {
    bench_.currents_.Send({last, true}, bench_.currents_sent_++,
                          bench_.now_ns_ + bench_.options_.compute_ns);
  }
}

bool VirtualBench::Link::Send(const SensorFrame& frame) noexcept {
  SensorFrame sent = frame;
  if (bench_.on_sample) {
    bench_.on_sample(frame.sample_time_ns, bench_.plant_,
                     bench_.rig_ != nullptr && bench_.rig_->energised(), sent);
  }
  bench_.frames_.Send(sent, frame.cycle, frame.sample_time_ns);
  return true;
}

port::RigLink::ReceiveResult VirtualBench::Link::Receive(CurrentFrame& frame,
                                                         std::int64_t /*deadline_ns*/) noexcept {
  CurrentLetter letter;
  bool found = false;
  while (bench_.currents_.TakeNext(bench_.rig_ns_, letter)) {
    if (found && !letter.goodbye && letter.frame.cycle < frame.cycle) continue;
    found = true;
    frame = letter.frame;
    if (letter.goodbye) return ReceiveResult::kGoodbye;  // what comes after it waits
  }
  return found ? ReceiveResult::kCurrent : ReceiveResult::kNothing;
}

}  // namespace levitas::lives
