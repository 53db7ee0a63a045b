#pragma once
// `amb diagnose --plan` without --out: before a diagnosis, what records can tell apart.
//
// Records  those given, or what `amb run` would record of the simulated rig under each --scenario.
// Thread   blocks the caller. Failure: BadInput; usage Problem for options that exclude each other.

#include <string>
#include <vector>

#include "cli/options/analysis_options.hpp"
#include "common/problem.hpp"

namespace levitas::cli {

struct PlanOptions {
  std::vector<std::string> data;
  std::vector<std::string> scenarios;
  std::string controller_name;  ///< empty: the one that the rig names
  std::string scenario_path;    ///< the experiment that splits most is written here; may be empty
  double size{1.0};             ///< of the faults, as a share of the clear one
  std::string json_path;
};

[[nodiscard]] ExitStatus Plan(const PlanOptions& options, const configuration::RigFile& rig);

}  // namespace levitas::cli
