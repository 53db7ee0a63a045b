#include "plant_sim/loop/plant_loop.hpp"

#include "common/standard_arithmetic.hpp"
#include "plant_sim/loop/pacer.hpp"
#include "plant_sim/loop/torsion_gauge.hpp"
#include "plant_sim/plant/command_of.hpp"
#include "rt/next_wake.hpp"

namespace levitas::plant_run {

namespace {
using ReceiveResult = port::RigLink::ReceiveResult;
constexpr std::uint64_t kTimeEvery = 16;
constexpr std::int64_t kRepeatNs = 100'000'000;  // lockstep: ask again
constexpr std::int64_t kLookNs = 12'000;         // real time: before the next instant
constexpr double kFallS = 0.5;                   // a rotor lies still after less
}  // namespace

void PlantLoop::Run() noexcept {
  UseStandardArithmetic();
  if (options_.realtime) {
    RunRealtime();
  } else {
    RunLockstep();
  }
}

SensorFrame PlantLoop::Sample(std::int64_t sample_time_ns) noexcept {
  SensorFrame frame = plant_.Sample();
  frame.cycle = statistics_.cycles;
  frame.sample_time_ns = sample_time_ns;
  frame.rig_session = options_.rig_session;
  frame.rig_status |= status_ | gate_status_;
  frame.held_currents = static_cast<std::uint32_t>(statistics_.held_currents);
  if (timed_events_ != nullptr) timed_events_->Disturb(frame.cycle, frame);
  if (torsion_ != nullptr) {
    const TorsionBatch* batch = torsion_->Sample(plant_, frame.cycle, frame.rig_session);
    if (batch != nullptr) link_.SendTorsion(*batch);
  }
  return frame;
}

void PlantLoop::Take(const CurrentFrame& current) noexcept {
  command_ = plant::CommandOf(current);
  driven_.store(current.drive_enabled, std::memory_order_relaxed);
  status_ = 0;
  if (latched_ && !current.amplifiers_enabled) {
    latched_ = false;
    events_.Post({RigEventKind::kRearmed, statistics_.cycles, 0.0});
  }
}

plant::PlantCommand PlantLoop::Allowed() noexcept {
  AmplifierGate::State gate;
  if (gate_ != nullptr) gate = gate_->Sample(clock_.NowNs());
  gate_status_ = gate.rig_status;
  const bool wanted = command_.amplifiers_enabled && !latched_;
  const RigEventKind why = latched_               ? RigEventKind::kWatchdog
                           : wanted && !gate.open ? RigEventKind::kGateShut
                                                  : RigEventKind::kSwitchedOff;
  NoteEnergised(wanted && gate.open, why);
  if (energised()) return command_;
  plant::PlantCommand off = command_;
  off.control_current_a.fill(0.0);
  off.bias_current_a = 0.0;
  off.amplifiers_enabled = false;
  return off;
}

void PlantLoop::NoteEnergised(bool energised, RigEventKind why) noexcept {
  if (energised == this->energised()) return;
  energised_.store(energised, std::memory_order_relaxed);
  falling_ = !energised;
  const RigEventKind kind = energised ? RigEventKind::kEnergised : why;
  events_.Post({kind, statistics_.cycles,
                kind == RigEventKind::kWatchdog ? static_cast<double>(held_in_a_row_) : 0.0});
}

void PlantLoop::NoteContact() noexcept {
  if (!falling_) return;
  const double force_n = plant_.ContactForce();
  if (force_n <= 0.0) return;
  falling_ = false;
  ++statistics_.landings;
  events_.Post({RigEventKind::kLanded, statistics_.cycles, force_n});
}

void PlantLoop::Advance() noexcept {
  // Timed now and then only: two readings of the clock cost a tenth of what they measure.
  const bool timed = statistics_.cycles % kTimeEvery == 0;
  const plant::PlantCommand command = Allowed();
  const std::int64_t start_ns = timed ? clock_.NowNs() : 0;
  if (timed_events_ != nullptr) timed_events_->Change(statistics_.cycles, plant_);
  plant_.Advance(command);
  if (gate_ != nullptr) gate_->Turn(plant_.angle_rad());
  if (timed) statistics_.advance.Add(clock_.NowNs() - start_ns);
  ++statistics_.cycles;
  NoteContact();
}

bool PlantLoop::AwaitCurrent(std::uint64_t cycle, std::int64_t deadline_ns,
                             bool& goodbye) noexcept {
  CurrentFrame current;
  for (;;) {
    const ReceiveResult answer = link_.Receive(current, deadline_ns);
    if (answer == ReceiveResult::kNothing) return false;
    heard_.fetch_add(1, std::memory_order_relaxed);
    if (answer == ReceiveResult::kGoodbye) {
      current.amplifiers_enabled = false;
      Take(current);  // the drive goes on braking where the controller left a turning rotor
      goodbye = true;
      return false;
    }
    if (current.cycle == cycle) {
      taken_cycle_ = cycle;
      if (timed_events_ != nullptr) timed_events_->Answered(cycle);
      Take(current);
      return true;
    }
    ++statistics_.stale_currents;
    // Late, but newer than what is held: it acts, and somebody is there.
    if (!options_.realtime || (answered_once_ && current.cycle <= taken_cycle_)) continue;
    Take(current);
    taken_cycle_ = current.cycle;
    late_ = answered_once_ = true;
  }
}

void PlantLoop::RunLockstep() noexcept {
  const bool paced = options_.pace_factor > 0.0;
  Pacer pacer(paced ? options_.pace_factor : 1.0, options_.period_ns);
  while (!stopped_.load(std::memory_order_relaxed)) {
    if (paced) clock_.SleepUntil(pacer.Due(statistics_.cycles, clock_.NowNs()));
    const SensorFrame frame =
        Sample(static_cast<std::int64_t>(statistics_.cycles) * options_.period_ns);
    link_.Send(frame);
    const std::int64_t asked_ns = options_.silence_ns > 0 ? clock_.NowNs() : 0;
    bool goodbye = false;
    bool alone = false;
    while (!alone && !AwaitCurrent(frame.cycle, clock_.NowNs() + kRepeatNs, goodbye)) {
      if ((goodbye && !options_.stay) || stopped_.load(std::memory_order_relaxed)) return;
      if (goodbye) answered_once_ = false;
      goodbye = false;
      alone = options_.silence_ns > 0 && answered_once_ &&
              clock_.NowNs() - asked_ns >= options_.silence_ns;
      if (alone) break;
      link_.Send(frame);
      ++statistics_.repeated_frames;
    }
    if (alone) {
      GoOnAlone();
    } else {
      answered_once_ = true;
      held_in_a_row_ = 0;
      Advance();
    }
  }
}

void PlantLoop::GoOnAlone() noexcept {
  while (answered_once_) {
    Hold();
    Advance();
  }
  const auto periods =
      static_cast<std::uint64_t>(kFallS * 1e9) / static_cast<std::uint64_t>(options_.period_ns);
  for (std::uint64_t period = 0; period < periods; ++period) Advance();
}

void PlantLoop::Hold() noexcept {
  if (!answered_once_) return;  // nobody is there yet: nothing is held
  ++statistics_.held_currents;
  status_ |= kRigCurrentHeld;
  if (late_) {
    late_ = false;
    held_in_a_row_ = 0;
    return;
  }
  if (++held_in_a_row_ < options_.watchdog_periods) return;
  ++statistics_.watchdog_trips;
  command_ = {.amplifiers_enabled = false};
  latched_ = true;
  answered_once_ = false;
  status_ = 0;
}

void PlantLoop::RunRealtime() noexcept {
  Take({});
  std::int64_t due_ns = rt::FirstWake(0, options_.period_ns, clock_.NowNs());
  clock_.SleepUntil(due_ns);
  while (!stopped_.load(std::memory_order_relaxed)) {
    const SensorFrame frame = Sample(due_ns);
    link_.Send(frame);
    bool goodbye = false;
    clock_.SleepUntil(due_ns + options_.period_ns - kLookNs);
    if (AwaitCurrent(frame.cycle, 0, goodbye)) {
      answered_once_ = true;
      held_in_a_row_ = 0;
    } else if (goodbye) {
      if (!options_.stay) return;
      answered_once_ = false;
    } else {
      Hold();
    }
    Advance();
    const rt::Wake wake = rt::NextWake(due_ns, options_.period_ns, clock_.NowNs());
    statistics_.skipped_periods += static_cast<std::uint64_t>(wake.skipped);
    // The rotor goes on moving while the simulation does not keep up.
    for (std::int64_t period = 0; period < wake.skipped; ++period) {
      Hold();
      Advance();
    }
    due_ns = wake.due_ns;
    rt::SpinUntil(due_ns);
    statistics_.wakeup.Add(clock_.NowNs() - due_ns);
  }
}

}  // namespace levitas::plant_run
