#pragma once
// Derives what a person should know from consecutive cycle records: mode changes, trips, refused
// commands, a rotor that turns while the amplifiers are off, missing frames, missed deadlines,
// restarts of the rig, blocks of synchronous control that begin or
// end, laws that change places over speed, records lost on the way here.
//
// Purity   same records, same events; no clock, no I/O.
// Flood    missing frames, missed deadlines and lost records are summed up: one event at the
//          first, then at most one per second of record time, with the count.
// Thread   the recorder's, or any reader's; allocates texts.

#include <cstdint>
#include <string>
#include <vector>

#include "controller/cycle/cycle_io.hpp"
#include "session/log/lift_watch.hpp"
#include "session/log/session_header.hpp"

namespace levitas::session {

class EventDeriver {
 public:
  EventDeriver(std::vector<std::string> channels, std::int64_t period_ns,
               SynchronousLabels synchronous = {});

  /// Appends what `record`, following the previous one given, has to tell.
  void Step(const cycle::CycleRecord& record, std::vector<Event>& events);
  /// Appends what was summed up and not yet told.
  void Finish(std::vector<Event>& events);

 private:
  /// Sums up something that may happen in every cycle.
  struct Tally {
    std::uint64_t untold{};
    std::uint64_t first_cycle{};
    std::uint64_t last_told_cycle{};
    bool ever_told{};
  };

  [[nodiscard]] Event Make(const cycle::CycleRecord& record, Event::Severity severity,
                           std::string text) const;
  void Lost(const cycle::CycleRecord& record, std::vector<Event>& events);
  void Command(const cycle::CycleRecord& record, std::vector<Event>& events) const;
  void ModeAndFault(const cycle::CycleRecord& record, std::vector<Event>& events) const;
  void Synchronous(const cycle::CycleRecord& record, std::vector<Event>& events) const;
  void ActingLaw(const cycle::CycleRecord& record, std::vector<Event>& events) const;
  void Turning(const cycle::CycleRecord& record, std::vector<Event>& events);
  void Add(Tally& tally, std::uint64_t count, std::uint64_t first_cycle,
           const cycle::CycleRecord& record, const char* what, std::vector<Event>& events) const;
  void Tell(Tally& tally, const cycle::CycleRecord& record, const char* what,
            std::vector<Event>& events) const;

  std::vector<std::string> channels_;
  SynchronousLabels synchronous_;
  std::uint64_t second_cycles_;
  bool have_previous_{false};
  cycle::CycleRecord previous_;
  LiftWatch lift_;
  bool turning_told_{false};  ///< since the mode became off
  Tally lost_records_;
  Tally missing_frames_;
  Tally missed_deadlines_;
};

/// One sentence on a trip: cause, channel, value and limit with unit, cycle, what the safe state
/// does, how to reset. `lift`: what the records of the lift before it showed, may be null; with it
/// a lift that failed names its reason and what helps.
[[nodiscard]] std::string TripText(const cycle::CycleRecord& record,
                                   const std::vector<std::string>& channels,
                                   const LiftWatch* lift = nullptr);

}  // namespace levitas::session
