#pragma once
// What a law over speed buys: |S| and damping at every speed, beside the laws without it.
// Thread   that of the caller.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "cli/study/design/pid_page.hpp"
#include "design/gate/gate.hpp"

namespace levitas::cli {

struct LawOverSpeed {
  std::string name;
  /// At the same speeds of every law; where a loop is unstable its numbers are NaN.
  std::vector<double> speed_rpm, peak, singular, damping_ratio;

  [[nodiscard]] bool stable() const;
  [[nodiscard]] double largest_peak() const;
};

/// From rest to the rated speed; the last law is the table.
[[nodiscard]] std::vector<LawOverSpeed> FiguresOverSpeed(const configuration::RigFile& rig,
                                                         const std::vector<NamedLaw>& laws);

/// Table and, in one sentence, what the table of laws buys.
void PrintOverSpeed(const std::vector<LawOverSpeed>& laws);

[[nodiscard]] nlohmann::ordered_json OverSpeedJson(const std::vector<LawOverSpeed>& laws);

[[nodiscard]] std::string SchedulePage(const configuration::RigFile& rig,
                                       const std::vector<LawOverSpeed>& laws,
                                       const law::LawConfig& table,
                                       const design::GateResult& result);

}  // namespace levitas::cli
