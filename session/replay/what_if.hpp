#pragma once
// What another controller would have commanded on the recorded inputs: the same positions and
// operator commands through another control cycle, its currents beside the recorded ones.
//
// Meaning    the rotor does not answer: it moves as recorded, whatever this controller says. Large
//            or growing differences say that the two disagree, not what the rotor would have done.
// Compared   cycles in which both have their coils energised.
// Imported   data have neither modes nor commands: the law runs alone, without a supervisor
//            (controller/cycle/law_alone.hpp), and the first 0.1 s, in which its filters fill, are
//            left out.
// Failure    BadInput when the file starts in the middle of a run.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "controller/cycle/control_cycle.hpp"
#include "session/log/session_reader.hpp"

namespace levitas::session {

struct ChannelDifference {
  std::string channel;
  double recorded_rms_a{};
  double mean_a{};      ///< of other minus recorded; the integrators' share
  double rms_a{};       ///< of other minus recorded, mean included
  double max_a{};       ///< largest magnitude of it
  double max_time_s{};  ///< when, counted from the first record
};

struct WhatIfReport {
  std::uint64_t cycles{};
  std::uint64_t compared{};
  std::uint64_t mode_differs{};  ///< cycles in which the modes differ
  std::uint64_t first_compared_cycle{};
  Fault fault{Fault::kNone};  ///< with which the other controller would have tripped
  std::uint64_t fault_cycle{};
  std::vector<ChannelDifference> channels;
};

/// Given each compared record and the other's outputs.
using WhatIfSink = std::function<void(const cycle::CycleRecord&, const cycle::CycleOutputs&)>;

[[nodiscard]] WhatIfReport WhatIf(SessionReader& reader, const cycle::CycleConfig& config,
                                  const std::string& session_path, const WhatIfSink& sink = {});

}  // namespace levitas::session
