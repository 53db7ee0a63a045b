#pragma once
// Options and output of the gate, for the commands that judge a law.
// Thread   that of the caller.

#include <CLI/App.hpp>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/options/analysis_options.hpp"
#include "design/file/design_file.hpp"
#include "design/gate/gate.hpp"

namespace levitas::cli {

struct GateCommandOptions {
  std::string design_path;     ///< design file; empty: default weights
  std::string from{"stated"};  ///< as ParametersOf takes it
  std::size_t draws{20};
  std::size_t corners{8};
  std::uint64_t seed{1};
  double sensitivity{4.0};
  std::optional<double> corner_sensitivity, mu;  ///< limits where given
  double third_n{0.0};
  bool tolerances{};
};

void AddGateOptions(CLI::App& command, GateCommandOptions& options);

void AddUncertaintyOption(CLI::App& command, std::string& from);

/// `from`: "stated", "tolerances", or a file of `amb identify modal --json`.
[[nodiscard]] std::vector<uncertainty::Parameter> ParametersOf(const configuration::RigFile& rig,
                                                               const std::string& from);

/// The design file that was named, or the default weights.
[[nodiscard]] design::DesignFile DesignOf(const GateCommandOptions& options);

/// What the options ask of the gate on this rig, by these weights.
[[nodiscard]] design::GateOptions GateOf(const GateCommandOptions& options,
                                         const uncertainty::AnalysisWeights& weights,
                                         const configuration::RigFile& rig);

/// Judges with a progress bar on a terminal, prints the figures.
[[nodiscard]] design::GateResult JudgeAndPrint(const configuration::RigFile& rig,
                                               const law::LawConfig& law,
                                               const GateCommandOptions& options,
                                               const uncertainty::AnalysisWeights& weights);

[[nodiscard]] nlohmann::ordered_json GateJson(const design::GateResult& result);

}  // namespace levitas::cli
