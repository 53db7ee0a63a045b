#pragma once
// Trials of `amb bench diagnosis`: effects hidden in simulated rigs are diagnosed, and printed.
//
// Trial    every seed is one; the plan is written by the options alone, so that the same options
//          give the same trials.
// Thread   blocks the caller; `jobs` threads inside.
// Failure  BadInput for an effect that the rig does not have.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "benchmark/accuracy/scores.hpp"
#include "diagnosis/inference/judging.hpp"

namespace levitas::cli {

struct BenchOptions {
  std::string rig{"flexible_rotor"};
  std::vector<std::string> controllers;
  std::vector<std::string> effects;
  std::vector<std::string> kinds;  ///< of --spoilt: errors of records, healthy, effect
  std::vector<double> sizes{1.0, 0.5, 0.25};
  std::uint64_t first{1000};
  int seeds{0}, clean{0}, outside{0}, pairs{0}, weak{0}, spoilt{0}, forecast{0};
  bool quick{}, explain{}, in_file{};
  bool runup_validates{};  ///< not fitted, as --holdout of a user
  bool shipped{};  ///< the rig file as it is; else rotor, magnets and noise are drawn by seed
  std::size_t jobs{1};
  int bits{2047};  ///< of the test signal, per axis; the run-up is as much shorter
  std::string json_path, markdown_path, write_folder;
  std::string sweep;  ///< NAME=V,V,...
  bool constants{};   ///< print them
  bool isolability{};
  std::string answered_path;  ///< --json of the same trials; empty: diagnose them
  diagnosis::Judging judging;
};

/// All records of a trial are fitted, or the last one, its run-up, is validation data.
[[nodiscard]] diagnosis::DiagnosisReport DiagnoseTrial(const accuracy::Trial& trial,
                                                       const diagnosis::Settings& settings,
                                                       bool runup_validates);

/// The trials that the options ask for, in the order of their seeds.
[[nodiscard]] std::vector<accuracy::TrialPlan> Plans(const BenchOptions& options,
                                                     const accuracy::TestRig& bench);

/// Several at a time, printed as they end, returned in the order of the plans.
[[nodiscard]] std::vector<accuracy::TrialScore> TryAll(
    const std::vector<accuracy::TrialPlan>& plans, const accuracy::TestRig& bench,
    const BenchOptions& options);

/// One trial for --json.
[[nodiscard]] nlohmann::ordered_json Json(const accuracy::TrialScore& o);

}  // namespace levitas::cli
