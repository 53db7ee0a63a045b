#include "controller/loop/control_loop.hpp"

#include <algorithm>

#include "common/standard_arithmetic.hpp"
#include "controller/supervisor/radius.hpp"
#include "controller/supervisor/supervisor.hpp"
#include "rt/next_wake.hpp"

namespace levitas::loop {

namespace {
constexpr std::int64_t kSliceNs = 50'000'000;  // how long a wait may overlook an Abort
}  // namespace

ControlLoop::ControlLoop(const LoopOptions& options, port::RigPort& port,
                         cycle::ControlCycle& cycle, OperatorSource& source, RecordSink& sink,
                         rt::Clock& clock) noexcept
    : options_(options),
      port_(port),
      cycle_(cycle),
      source_(source),
      sink_(sink),
      clock_(clock),
      timer_(clock, statistics_),
      cycles_per_second_(static_cast<std::uint64_t>(1'000'000'000 / options.period_ns)) {}

void ControlLoop::Run() noexcept {
  UseStandardArithmetic();
  if (options_.pace == Pace::kLockstep) {
    RunLockstep();
  } else {
    RunRealtime();
  }
}

bool ControlLoop::AwaitFrame(SensorFrame& frame) noexcept {
  while (!Ends()) {
    if (port_.Read(frame, clock_.NowNs() + kSliceNs) == port::ReadResult::kFrame) {
      heard_.fetch_add(1, std::memory_order_relaxed);
      return true;
    }
  }
  return false;
}

void ControlLoop::Date(SensorFrame& frame) noexcept {
  const std::int64_t now_ns = clock_.NowNs();
  const std::int64_t at_ns = frame.sample_time_ns;
  if (at_ns >= now_ns - options_.farthest_ns && at_ns <= now_ns + options_.farthest_ns) return;
  frame.sample_time_ns = now_ns - options_.phase_ns;
  ++statistics_.undated_frames;
}

bool ControlLoop::Repeated(const SensorFrame& frame) const noexcept {
  const SensorFrame& previous = record_.in.frame;
  return answered_ && frame.rig_session == previous.rig_session && frame.cycle == previous.cycle;
}

bool ControlLoop::Overtaken(const SensorFrame& frame) const noexcept {
  const SensorFrame& previous = record_.in.frame;
  return answered_ && frame.rig_session == previous.rig_session && frame.cycle < previous.cycle;
}

void ControlLoop::Cycle(bool frame_present, const SensorFrame& frame,
                        std::uint32_t missed) noexcept {
  const std::int64_t start_ns = timer_.last_ns();
  const OperatorView view{.cycle = statistics_.cycles,
                          .mode = record_.out.mode,
                          .fault = record_.out.fault,
                          .amplifiers_enabled = record_.out.current.amplifiers_enabled,
                          .command_refused = record_.out.command_refused,
                          .standing = cycle_.decision().standing,
                          .speed_rad_per_s = frame.speed_rad_per_s,
                          .radius_m = supervisor::LargestRadius(frame),
                          .position_m = frame.position_m};
  record_.in.cycle = statistics_.cycles;
  record_.in.frame_present = frame_present;
  record_.in.frame = frame;
  record_.in.missed_deadlines = missed;
  record_.in.op = source_.Next(view);
  record_.out = cycle_.Step(record_.in, &timer_);
  port_.Write(record_.out.current);
  timer_.Ended(cycle::Stage::kWrite);
  written_ns_ = timer_.last_ns();
  statistics_.compute.Add(written_ns_ - start_ns);
  if (const std::int64_t received_ns = source_.stop_received_ns(); received_ns != 0) {
    statistics_.emergency_stop.Add(written_ns_ - received_ns);
  }
  if (statistics_.cycles == 0) statistics_.first_ns = start_ns;
  statistics_.last_ns = written_ns_;
  ++statistics_.cycles;
  if (!frame_present) ++statistics_.missing_frames;
  answered_ = true;
  while (port_.TakeTorsion(torsion_)) sink_.PostTorsion(torsion_);
  sink_.Post(record_);
  if (statistics_.cycles % cycles_per_second_ == 0) sink_.Post(statistics_);
  timer_.Ended(cycle::Stage::kRecord);
}

void ControlLoop::RunLockstep() noexcept {
  SensorFrame frame;
  while (!Ends()) {
    timer_.Start(clock_.NowNs());
    if (!AwaitFrame(frame)) return;
    if (Overtaken(frame)) {  // its answer was written when it was new, or a newer one was
      ++statistics_.old_frames;
      continue;
    }
    if (Repeated(frame)) {
      ++statistics_.repeated_frames;
      port_.Write(record_.out.current);
      continue;
    }
    timer_.Ended(cycle::Stage::kWait);
    Cycle(true, frame, 0);
  }
}

// Behind a frame that was overtaken the new one may still come. Without a new one the newest stays;
// only the stop chain is taken, a line of its own.
bool ControlLoop::ReadNew(SensorFrame& frame, std::int64_t deadline_ns) noexcept {
  constexpr int kMostReads = 4;  // a flood of old ones is not waited for
  for (int reads = 0; reads < kMostReads; ++reads) {
    if (port_.Read(frame, deadline_ns) != port::ReadResult::kFrame) return false;
    heard_.fetch_add(1, std::memory_order_relaxed);
    Date(frame);
    if (!Overtaken(frame)) return !Repeated(frame);
    ++statistics_.old_frames;
    const std::uint32_t stop = frame.rig_status & kRigEmergencyStop;
    frame = record_.in.frame;
    frame.rig_status |= stop;
  }
  return false;
}

void ControlLoop::CountOverrun(std::int64_t skipped) noexcept {
  statistics_.skipped_periods += static_cast<std::uint64_t>(skipped);
  ++statistics_.overruns;
  statistics_.last_blamed = timer_.Longest();
  ++statistics_.blamed[static_cast<std::size_t>(statistics_.last_blamed)];
}

void ControlLoop::RunRealtime() noexcept {
  SensorFrame frame;
  if (!AwaitFrame(frame)) return;
  Date(frame);
  const std::int64_t phase_ns = frame.sample_time_ns + options_.phase_ns;
  std::int64_t due_ns = rt::FirstWake(phase_ns, options_.period_ns, clock_.NowNs());
  std::uint32_t missed = 0;
  while (!Ends()) {
    clock_.SleepUntil(due_ns);
    timer_.Start(due_ns);
    timer_.Ended(cycle::Stage::kWait);
    statistics_.wakeup.Add(timer_.last_ns() - due_ns);
    const bool present = ReadNew(frame, due_ns + options_.grace_ns);
    timer_.Ended(cycle::Stage::kRead);
    Cycle(present, frame, missed);
    if (present) statistics_.latency.Add(written_ns_ - frame.sample_time_ns);
    const rt::Wake wake = rt::NextWake(due_ns, options_.period_ns, timer_.last_ns());
    if (wake.skipped > 0) CountOverrun(wake.skipped);
    missed =
        static_cast<std::uint32_t>(std::min<std::int64_t>(wake.skipped, std::int64_t{UINT32_MAX}));
    due_ns = wake.due_ns;
  }
}

}  // namespace levitas::loop
