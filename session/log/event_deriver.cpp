#include "session/log/event_deriver.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/rotational_speed.hpp"
#include "session/log/block_events.hpp"

namespace levitas::session {
namespace {

constexpr const char* kMissingFrame = "cycle(s) without a new sensor frame";
constexpr const char* kLostRecord =
    "record(s) lost: the recorder could not keep up; the control cycle was not affected";
constexpr const char* kMissedDeadline = "period(s) skipped: the loop was too late";

std::string Speed(double rad_per_s) { return fmt::format("{:.0f} rpm", RadPerSToRpm(rad_per_s)); }

bool FrameUsable(const cycle::CycleRecord& record) noexcept { return record.in.frame_present; }

}  // namespace

EventDeriver::EventDeriver(std::vector<std::string> channels, std::int64_t period_ns,
                           SynchronousLabels synchronous)
    : channels_(std::move(channels)),
      synchronous_(std::move(synchronous)),
      second_cycles_(
          static_cast<std::uint64_t>(1'000'000'000 / std::max<std::int64_t>(period_ns, 1))),
      lift_(1e-9 * static_cast<double>(period_ns)) {}

Event EventDeriver::Make(const cycle::CycleRecord& record, Event::Severity severity,
                         std::string text) const {
  return {.cycle = record.in.cycle,
          .time_ns = record.in.frame.sample_time_ns,
          .severity = severity,
          .mode = record.out.mode,
          .fault = record.out.fault,
          .axis = record.out.fault_axis,
          .value = record.out.fault_value,
          .limit = record.out.fault_limit,
          .text = std::move(text)};
}

void EventDeriver::Lost(const cycle::CycleRecord& record, std::vector<Event>& events) {
  const std::uint64_t expected = previous_.in.cycle + 1;
  const bool gap = have_previous_ && record.in.cycle > expected;
  Add(lost_records_, gap ? record.in.cycle - expected : 0, gap ? expected : 0, record, kLostRecord,
      events);
}

void EventDeriver::Command(const cycle::CycleRecord& record, std::vector<Event>& events) const {
  const OperatorCommand command = record.in.op.command;
  if (command == OperatorCommand::kNone) return;
  const Mode before = have_previous_ ? previous_.out.mode : Mode::kOff;
  if (record.out.command_refused) {
    events.push_back(Make(record, Event::Severity::kWarning,
                          fmt::format("command {} refused in mode {} (cycle {})", Name(command),
                                      Name(before), record.in.cycle)));
    return;
  }
  const std::string with = command == OperatorCommand::kSpin
                               ? fmt::format(" to {}", Speed(record.in.op.speed_rad_per_s))
                               : std::string{};
  events.push_back(
      Make(record, Event::Severity::kInformation,
           fmt::format("command {}{} (cycle {})", Name(command), with, record.in.cycle)));
}

void EventDeriver::ModeAndFault(const cycle::CycleRecord& record,
                                std::vector<Event>& events) const {
  const Mode mode_before = have_previous_ ? previous_.out.mode : Mode::kOff;
  const Fault fault_before = have_previous_ ? previous_.out.fault : Fault::kNone;
  if (record.out.fault != Fault::kNone && record.out.fault != fault_before) {
    events.push_back(Make(record, Event::Severity::kTrip, TripText(record, channels_, &lift_)));
  } else if (record.out.mode != mode_before) {
    events.push_back(Make(record, Event::Severity::kInformation,
                          fmt::format("{} -> {} (cycle {})", Name(mode_before),
                                      Name(record.out.mode), record.in.cycle)));
  }
}

// In off the drive is on only to brake a rotor that was found turning.
void EventDeriver::Turning(const cycle::CycleRecord& record, std::vector<Event>& events) {
  const bool off = record.out.mode == Mode::kOff;
  if (off && record.out.current.drive_enabled && !turning_told_) {
    turning_told_ = true;
    events.push_back(
        Make(record, Event::Severity::kWarning,
             fmt::format(
                 "the rotor turns at {} with the amplifiers off: the drive brakes it, and a lift "
                 "is refused until it stands (cycle {})",
                 Speed(record.in.frame.speed_rad_per_s), record.in.cycle)));
  }
  turning_told_ = turning_told_ && off;
}

// A block that ends by its speed does what it was told; any other end is a warning.
void EventDeriver::Synchronous(const cycle::CycleRecord& record, std::vector<Event>& events) const {
  using synchronous::BlockState;
  for (std::size_t k = 0; k < record.out.synchronous_blocks; ++k) {
    const synchronous::BlockStatus& now = record.out.synchronous[k];
    const BlockState before =
        have_previous_ ? previous_.out.synchronous[k].state : BlockState::kOff;
    if (now.state == before) continue;
    const std::string name =
        k < synchronous_.blocks.size() ? synchronous_.blocks[k] : fmt::format("block {}", k + 1);
    const std::string where =
        fmt::format("at {} (cycle {})", Speed(record.in.frame.speed_rad_per_s), record.in.cycle);
    if (now.state == BlockState::kActing) {
      events.push_back(Make(record, Event::Severity::kInformation,
                            BlockBegins(name, where, synchronous_.angle_from)));
    } else if (now.state == BlockState::kFading || before == BlockState::kActing) {
      const bool planned = now.ending == synchronous::Ending::kSpeed;
      events.push_back(Make(record,
                            planned ? Event::Severity::kInformation : Event::Severity::kWarning,
                            BlockEnds(name, where, now.ending)));
    }
  }
}

// A law that starts with a lift is none that takes over.
void EventDeriver::ActingLaw(const cycle::CycleRecord& record, std::vector<Event>& events) const {
  if (!have_previous_ || record.out.acting_law == previous_.out.acting_law) return;
  if (!record.out.current.amplifiers_enabled || !previous_.out.current.amplifiers_enabled) return;
  events.push_back(
      Make(record, Event::Severity::kInformation,
           fmt::format("law {} of the schedule takes over from law {} at {} (cycle {})",
                       record.out.acting_law + 1, previous_.out.acting_law + 1,
                       Speed(record.in.frame.speed_rad_per_s), record.in.cycle)));
}

void EventDeriver::Tell(Tally& tally, const cycle::CycleRecord& record, const char* what,
                        std::vector<Event>& events) const {
  events.push_back(
      Make(record, Event::Severity::kWarning,
           fmt::format("{} {}, the first in cycle {}", tally.untold, what, tally.first_cycle)));
  tally.untold = 0;
  tally.last_told_cycle = record.in.cycle;
  tally.ever_told = true;
}

void EventDeriver::Add(Tally& tally, std::uint64_t count, std::uint64_t first_cycle,
                       const cycle::CycleRecord& record, const char* what,
                       std::vector<Event>& events) const {
  if (count > 0) {
    if (tally.untold == 0) tally.first_cycle = first_cycle;
    tally.untold += count;
  }
  const bool due = !tally.ever_told || record.in.cycle >= tally.last_told_cycle + second_cycles_;
  if (tally.untold > 0 && due) Tell(tally, record, what, events);
}

void EventDeriver::Step(const cycle::CycleRecord& record, std::vector<Event>& events) {
  Lost(record, events);
  const bool both_frames = have_previous_ && FrameUsable(record) && previous_.in.frame.axes > 0;
  if (both_frames && record.in.frame.rig_session != previous_.in.frame.rig_session) {
    events.push_back(Make(record, Event::Severity::kWarning,
                          fmt::format("the rig restarted (cycle {})", record.in.cycle)));
  }
  Command(record, events);
  ModeAndFault(record, events);
  Synchronous(record, events);
  ActingLaw(record, events);
  Turning(record, events);
  Add(missed_deadlines_, record.in.missed_deadlines, record.in.cycle, record, kMissedDeadline,
      events);
  // Before the rig's first frame nothing is missing: it is being waited for.
  const bool rig_known = record.in.frame.axes > 0;
  Add(missing_frames_, rig_known && !FrameUsable(record) ? 1 : 0, record.in.cycle, record,
      kMissingFrame, events);
  lift_.Add(record);
  previous_ = record;
  have_previous_ = true;
}

void EventDeriver::Finish(std::vector<Event>& events) {
  if (lost_records_.untold > 0) Tell(lost_records_, previous_, kLostRecord, events);
  if (missed_deadlines_.untold > 0) Tell(missed_deadlines_, previous_, kMissedDeadline, events);
  if (missing_frames_.untold > 0) Tell(missing_frames_, previous_, kMissingFrame, events);
}

}  // namespace levitas::session
