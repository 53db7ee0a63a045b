#pragma once
// What `amb design pid` and `amb design schedule` both take: requirements, and how long to search.
// Thread   that of the caller.

#include <CLI/App.hpp>
#include <string>

#include "cli/options/analysis_options.hpp"
#include "cli/study/design/gate_options.hpp"
#include "design/pid/pid_search.hpp"

namespace levitas::cli {

struct PidCommandOptions {
  AnalysisOptions loop;
  GateCommandOptions gate;
  design::PidSearchOptions search;
  std::string out_path;
  std::string html_path;
  double sensitivity{3.0};
  /// 0: the rig's own, or not asked.
  double damping_percent{}, complementary{}, control_a_per_m{}, singular{}, standing_um{},
      spinning_um{};
  double current_a{}, noise_a{}, stiffness_n_per_m{}, compliance_um_per_n{};
  double corner_sensitivity{};
  double unknown_damping_percent{0.3};
  bool shared_filters{};
  bool tilt{};  ///< PIDs of translation and tilt instead of the axes
};

void AddPidSearchOptions(CLI::App& command, PidCommandOptions& options);

/// The requirements that the options ask of this rig.
[[nodiscard]] design::PidLimits LimitsOf(const PidCommandOptions& options,
                                         const configuration::RigFile& rig);

/// Rig and protections of the search, and what of it the other options say.
void CompleteSearch(const configuration::RigFile& rig, PidCommandOptions& options);

}  // namespace levitas::cli
