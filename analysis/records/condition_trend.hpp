#pragma once
// Condition of geared shafts over sessions: whether what gear_condition.hpp measures has risen, by
// how much from session to session, and on which shaft.
//
// Baseline  the first sessions, which count as healthy: mean of their energies, and as their
//           scatter the larger of what they scatter and what each is uncertain by.
// Rise      z = (E - mean)/sqrt(dev^2 + scatter^2/B);  the last session has risen from 5 on, where
//           the growth lies in at least two lines, (sum g)^2/sum g^2: one line alone is another
//           tone, not a pulse, of which a resonance shows some lines more than others.
// Trend     of the amplitude sqrt(E) per session: median of the slopes of all pairs (Theil 1950;
//           Sen 1968, J. Am. Stat. Assoc. 63, 1379), its interval by the exact distribution of
//           Kendall's S; `coverage` is what that number of sessions allows.
// Which     by the lines. Where all of one shaft's are another's as well (ratio 2: the pinion's are
//           even multiples of the gear's), one pulse a turn of that other one makes both kinds
//           alike; growth per line that differs by more than a factor of 2 is two pulses a turn,
//           which the first shaft makes. Without a load on the teeth the pinion's two pulses may
//           differ so much, by the run-out of the gear, that they look like one: then both are
//           named (`or_else`), as where the gear's own multiples have not risen enough alone.
//           Under a load the factor is some hundreds.
// Comparable  speeds within 0.5 %, mesh lines within 25 %, means of position and current within 5 %
//           of clearance and bias of the first session: else Reasons() names what differs.
// Not done  no forecast: at which size a tooth breaks is not in these data.
// Units     SI. Thread: any; pure. Failure: none; too few sessions give no verdict.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "analysis/records/gear_condition.hpp"

namespace levitas::analysis {

struct TrendRule {
  std::size_t baseline{3};
  double rise{5.0};         ///< deviations
  double least_lines{2.0};  ///< among which a growth must lie
  double confidence{0.9};   ///< of the trend's interval
  bool loaded{true};        ///< the teeth carry a static load
};

struct Slope {
  double value{};
  double low{}, high{};
  double coverage{};  ///< of low to high
};

/// Per step from value to value; `values` are at least two.
[[nodiscard]] Slope RobustSlope(const std::vector<double>& values, double confidence);

struct ShaftTrend {
  std::size_t shaft{};
  std::string wheels;
  std::vector<double> rise;  ///< z of every session
  Slope amplitude_m;         ///< per session
  double rises_from_m{};     ///< amplitude at which a session as certain as the baseline has risen
  double lines{};            ///< among which the last session's growth lies
  double once_ratio{1.0};    ///< once a turn: last session over baseline
  bool risen{};
  std::optional<std::size_t> explained_by;  ///< shaft whose pulse makes these lines, too
  std::optional<std::size_t> or_else;       ///< shaft that may be it as well
};

/// Of at least rule.baseline + 1 sessions in order of time; fewer give none.
[[nodiscard]] std::vector<ShaftTrend> FollowCondition(const std::vector<GearCondition>& sessions,
                                                      const TrendRule& rule);

/// In words, one each, with the number of the session from 1; empty: comparable.
[[nodiscard]] std::vector<std::string> Reasons(const std::vector<GearCondition>& sessions,
                                               const plant::PlantConfig& rig);

}  // namespace levitas::analysis
