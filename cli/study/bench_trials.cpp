#include "cli/study/bench_trials.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>

#include "benchmark/accuracy/available_evidence.hpp"
#include "benchmark/accuracy/drawn_rig.hpp"
#include "cli/json_file.hpp"
#include "cli/study/bench_workers.hpp"
#include "common/output_file.hpp"
#include "common/problem.hpp"
#include "diagnosis/report/build_report.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::cli {
namespace {

constexpr double kShortestRunUpS = 1.0;

std::vector<effect::Id> Chosen(const BenchOptions& options, const accuracy::TestRig& bench) {
  std::vector<effect::Id> ids;
  for (const accuracy::SizeOnRig& on : bench.trials.effects) {
    const std::string name(effect::At(on.id).name);
    if (options.effects.empty() ||
        std::find(options.effects.begin(), options.effects.end(), name) != options.effects.end()) {
      ids.push_back(on.id);
    }
  }
  if (ids.empty()) {
    throw BadInput(fmt::format("--effect: no effect of that name is hidden in rig {}",
                               bench.rig.numbers.name));
  }
  return ids;
}

void WriteTrial(const accuracy::Trial& trial, const std::string& root, std::uint64_t seed) {
  const std::string folder = fmt::format("{}/{}", root, seed);
  std::filesystem::create_directories(folder + "/ground_truth");
  accuracy::WriteCsv(trial.records, trial.rig.numbers, folder);
  WriteWholeFile(folder + "/rig.yaml", configuration::WriteRig(trial.rig));
  nlohmann::ordered_json truth{{"effects", effect::NamesOf(trial.ground_truth.effects)},
                               {"outside", Name(trial.ground_truth.outside)}};
  WriteJsonFile(folder + "/ground_truth/truth.json", truth);
}

/// Available evidence for one hidden effect, given the other hidden effects.
std::optional<double> HeldFor(const accuracy::Trial& trial, effect::Id effect) {
  std::vector<effect::EffectConfig> one;
  std::vector<effect::EffectConfig> rest;
  for (const effect::EffectConfig& entry : trial.ground_truth.hidden) {
    (entry.id == effect ? one : rest).push_back(entry);
  }
  return accuracy::AvailableEvidence(trial.rig, trial.records, one, rest);
}

void ListMissed(const accuracy::Trial& trial, accuracy::TrialScore& outcome) {
  for (const effect::Id effect : outcome.truth) {
    if (!outcome.Names(effect)) outcome.missed.emplace_back(effect, HeldFor(trial, effect));
  }
}

accuracy::TrialScore Try(const accuracy::TrialPlan& plan, const accuracy::TestRig& bench,
                         const BenchOptions& options) {
  const accuracy::Trial trial =
      options.shipped ? accuracy::MakeTrial(bench, plan) : accuracy::MakeDrawnTrial(bench, plan);
  if (!options.write_folder.empty()) WriteTrial(trial, options.write_folder, plan.seed);
  diagnosis::Settings settings;
  settings.quick = options.quick;
  settings.judging = options.judging;
  const auto start = std::chrono::steady_clock::now();
  const diagnosis::DiagnosisReport report = DiagnoseTrial(trial, settings, options.runup_validates);
  accuracy::TrialScore outcome = accuracy::Judge(plan, trial.ground_truth, report);
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (outcome.truth.size() > 1 && plan.side_size == 1.0) ListMissed(trial, outcome);
  if (!outcome.truth.empty() && !outcome.Right()) {
    // What the records hold for an effect that was not named is found by being told of it.
    settings.only = outcome.truth.front();
    const auto informed = DiagnoseTrial(trial, settings, options.runup_validates);
    const bool known =
        !outcome.missed.empty() && outcome.missed.front().first == outcome.truth.front();
    accuracy::AddInformedDiagnosis(
        informed, known ? outcome.missed.front().second : HeldFor(trial, outcome.truth.front()),
        outcome);
  }
  return outcome;
}

std::string Hidden(const accuracy::TrialScore& o) {
  if (!o.truth.empty()) return fmt::format("{}", fmt::join(effect::NamesOf(o.truth), "+"));
  if (!o.in_file.empty())
    return fmt::format("({} in the file)", fmt::join(effect::NamesOf(o.in_file), "+"));
  return o.outside.empty() ? "(nothing)" : o.outside;
}

void PrintOne(const accuracy::TrialScore& o) {
  fmt::print("{:>6} {:<26}{:<9}-> {:<10}{:<58}{:>7.1f} nat {:.1f} s{}\n", o.seed, Hidden(o),
             o.truth.empty() ? "" : accuracy::Name(o.size()), o.verdict,
             fmt::format("{}{}{}", fmt::join(effect::NamesOf(o.named), ", "),
                         o.ties.empty() ? "" : " | ", fmt::join(effect::NamesOf(o.ties), ", ")),
             o.score_nat, o.seconds, o.Right() ? "" : (o.Partly() ? "   (partly)" : "   WRONG"));
  for (const auto& [effect, held] : o.missed) {
    fmt::print("       not named: {}, of which the records hold {} given the others\n",
               effect::At(effect).name,
               held ? fmt::format("{:.1f} nat", *held) : "an unknown amount");
  }
  if (o.informed_failed) {
    fmt::print("       informed diagnosis failed: it does not name {}; the records hold {}\n",
               effect::At(o.truth.front()).name,
               o.record_nat < 0.0 ? "an unknown amount" : fmt::format("{:.1f} nat", o.record_nat));
  }
  static_cast<void>(std::fflush(stdout));
}

void Explain(const accuracy::TrialScore& o) {
  fmt::print(
      "       {:.2f} of the excess explained, {:.1f} sigma left, gain on validation data {:.3f}; "
      "{}\n",
      o.explained, o.remainder_sigma, o.achieved, fmt::join(o.nearest, ", "));
  static_cast<void>(std::fflush(stdout));
}

}  // namespace

diagnosis::DiagnosisReport DiagnoseTrial(const accuracy::Trial& trial,
                                         const diagnosis::Settings& settings,
                                         bool runup_validates) {
  const auto judging = trial.records.end() - (runup_validates ? 1 : 0);
  const std::vector<diagnosis::Record> fitted(trial.records.begin(), judging);
  const std::vector<diagnosis::Record> validation(judging, trial.records.end());
  return diagnosis::BuildReport(
      diagnosis::DiagnoseRecords(trial.rig, fitted, validation, settings));
}

std::vector<accuracy::TrialPlan> Plans(const BenchOptions& options,
                                       const accuracy::TestRig& bench) {
  const auto ids = Chosen(options, bench);
  std::vector<accuracy::TrialPlan> plans;
  const auto add = [&](std::vector<effect::Id> hidden, double size) -> accuracy::TrialPlan& {
    accuracy::TrialPlan plan;
    plan.seed = options.first + plans.size();
    plan.hidden = std::move(hidden);
    plan.size = size;
    plan.in_file = options.in_file;
    plan.runup_s = std::max(kShortestRunUpS, plan.runup_s * options.bits / plan.bits_per_axis);
    plan.bits_per_axis = options.bits;
    return plans.emplace_back(plan);
  };
  for (int i = 0; i < options.seeds; ++i) {
    const auto at = static_cast<std::size_t>(i);
    add({ids[at % ids.size()]}, options.sizes[at / ids.size() % options.sizes.size()]);
  }
  for (int i = 0; i < options.clean; ++i) add({}, 0.0);
  for (int i = 0; i < options.outside; ++i) {
    add({}, 1.0).outside = static_cast<accuracy::Unmodelled>(1 + i % 5);
  }
  for (int i = 0; i < options.pairs; ++i) {
    const auto at = static_cast<std::size_t>(i);
    add({ids[at % ids.size()], ids[(at * 7 + 3) % ids.size()]}, 1.0);
  }
  for (int i = 0; i < options.weak; ++i) {
    const auto at = static_cast<std::size_t>(i);
    add({ids[at % ids.size()], ids[(at + 5) % ids.size()], ids[(at + 13) % ids.size()],
         ids[(at + 22) % ids.size()]},
        1.0)
        .side_size = 0.15;
  }
  return plans;
}

nlohmann::ordered_json Json(const accuracy::TrialScore& o) {
  auto missed = nlohmann::ordered_json::array();
  for (const auto& [effect, held] : o.missed) {
    missed.push_back({{"effect", effect::At(effect).name}, {"held_nat", held.value_or(-1.0)}});
  }
  return {{"seed", o.seed},
          {"truth", effect::NamesOf(o.truth)},
          {"outside", o.outside},
          {"in_file", effect::NamesOf(o.in_file)},
          {"drawn", o.drawn},
          {"size", o.truth.empty() ? "" : accuracy::Name(o.size())},
          {"verdict", o.verdict},
          {"named", effect::NamesOf(o.named)},
          {"ties", effect::NamesOf(o.ties)},
          {"score_nat", o.score_nat},
          {"available_nat", o.available_nat},
          {"held_nat", o.record_nat},
          {"informed_failed", o.informed_failed},
          {"missed", missed},
          {"explained", o.explained},
          {"remainder_sigma", o.remainder_sigma},
          {"nearest", o.nearest},
          {"right", o.Right()},
          {"partly", o.Partly()},
          {"achieved", o.achieved},
          {"parameter_error", o.parameter_error},
          {"parameter_sigmas", o.parameter_sigmas},
          {"seconds", o.seconds}};
}

std::vector<accuracy::TrialScore> TryAll(const std::vector<accuracy::TrialPlan>& plans,
                                         const accuracy::TestRig& bench,
                                         const BenchOptions& options) {
  std::vector<accuracy::TrialScore> outcomes(plans.size());
  std::mutex printing;
  ForEachTrial(plans.size(), options.jobs, [&](std::size_t i) {
    outcomes[i] = Try(plans[i], bench, options);
    const std::lock_guard lock(printing);
    PrintOne(outcomes[i]);
    if (options.explain) Explain(outcomes[i]);
  });
  return outcomes;
}

}  // namespace levitas::cli
