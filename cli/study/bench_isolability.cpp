#include "cli/study/bench_isolability.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <fstream>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>

#include "benchmark/accuracy/agreement.hpp"
#include "benchmark/accuracy/drawn_rig.hpp"
#include "cli/study/bench_workers.hpp"
#include "common/problem.hpp"
#include "diagnosis/isolability/foretell.hpp"
#include "diagnosis/records/levitated_interval.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::cli {
namespace {

using diagnosis::Isolation;
using diagnosis::Prediction;

/// Of a diagnosis, as far as it is compared.
struct Answer {
  std::vector<effect::Id> truth, named, ties;
  std::string verdict;
};

struct Compared {
  std::uint64_t seed{};
  effect::Id hidden{};
  std::optional<Prediction> prediction;  ///< none: there is no healthy record of this rig
  Isolation answered{};
  std::vector<effect::Id> named_or_tied;
  accuracy::RowEntries entries;

  [[nodiscard]] bool agrees() const noexcept { return prediction->isolation == answered; }
};

std::vector<effect::Id> EffectsOf(const nlohmann::json& names) {
  const auto read = names.get<std::vector<std::string>>();
  std::vector<effect::Id> ids = effect::IdsOf(read);
  if (ids.size() == read.size()) return ids;
  throw BadInput(
      fmt::format("--answered: not all are effects of the catalogue: {}", fmt::join(read, ", ")));
}

std::map<std::uint64_t, Answer> ReadAnswers(const std::string& path) {
  std::map<std::uint64_t, Answer> answers;
  if (path.empty()) return answers;
  std::ifstream file(path);
  try {
    for (const auto& trial : nlohmann::json::parse(file).at("trials")) {
      answers[trial.at("seed")] = {EffectsOf(trial.at("truth")), EffectsOf(trial.at("named")),
                                   EffectsOf(trial.at("ties")), trial.at("verdict")};
    }
  } catch (const nlohmann::json::exception& wrong) {
    throw BadInput(fmt::format("{}: no --json of amb bench diagnosis: {}", path, wrong.what()));
  }
  return answers;
}

accuracy::Trial TrialOf(const accuracy::TrialPlan& plan, const accuracy::TestRig& bench,
                        const BenchOptions& options) {
  return options.shipped ? accuracy::MakeTrial(bench, plan) : accuracy::MakeDrawnTrial(bench, plan);
}

std::optional<Prediction> PredictionOf(const accuracy::TrialPlan& plan,
                                       const accuracy::Trial& trial, const accuracy::TestRig& bench,
                                       const BenchOptions& options) {
  accuracy::TrialPlan nothing = plan;
  nothing.hidden.clear();
  accuracy::Trial healthy = TrialOf(nothing, bench, options);
  // A rig that did not levitate with the effect has been drawn anew.
  if (configuration::WriteRig(healthy.rig) != configuration::WriteRig(trial.rig))
    return std::nullopt;
  const diagnosis::RigView view(healthy.rig.numbers, healthy.rig.plant);
  for (diagnosis::Record& record : healthy.records) diagnosis::LeaveOutContactAndWays(view, record);
  const diagnosis::HealthyModel model(healthy.rig, std::move(healthy.records), true,
                                      options.judging);
  return Foretell(model, nullptr, trial.ground_truth.hidden, options.judging);
}

Answer Diagnosed(const accuracy::TrialPlan& plan, const accuracy::Trial& trial,
                 const BenchOptions& options) {
  diagnosis::Settings settings;
  settings.quick = options.quick;
  settings.judging = options.judging;
  const auto report = DiagnoseTrial(trial, settings, false);
  const accuracy::TrialScore score = accuracy::Judge(plan, trial.ground_truth, report);
  return {score.truth, score.named, score.ties, score.verdict};
}

Compared Compare(const accuracy::TrialPlan& plan, const accuracy::TestRig& bench,
                 const BenchOptions& options, const std::map<std::uint64_t, Answer>& answers) {
  const accuracy::Trial trial = TrialOf(plan, bench, options);
  Compared out;
  out.seed = plan.seed;
  out.hidden = trial.ground_truth.effects.front();
  Answer answer;
  if (answers.empty()) {
    answer = Diagnosed(plan, trial, options);
  } else {
    const auto found = answers.find(plan.seed);
    if (found == answers.end() || found->second.truth != trial.ground_truth.effects) {
      throw BadInput(fmt::format("--answered: no answer for trial {} ({})", plan.seed,
                                 effect::At(out.hidden).name));
    }
    answer = found->second;
  }
  out.named_or_tied = accuracy::NamedOrTied(answer.verdict, answer.named, answer.ties);
  out.answered = accuracy::KindOf(out.hidden, out.named_or_tied);
  out.prediction = PredictionOf(plan, trial, bench, options);
  if (out.prediction) out.entries = accuracy::CompareRow(*out.prediction, out.named_or_tied);
  return out;
}

void PrintCompared(const Compared& one) {
  if (!one.prediction) {
    fmt::print("{:>6} {:<25} no healthy record of this rig\n", one.seed,
               effect::At(one.hidden).name);
    return;
  }
  const Prediction& p = *one.prediction;
  fmt::print("{:>6} {:<25} {:<12}{:>7.1f} nat {:>3.0f} % -> {:<12} {}{}\n", one.seed,
             effect::At(one.hidden).name, Word(p.isolation), p.evidence_nat, 100.0 * p.probability,
             Word(one.answered), fmt::join(effect::NamesOf(one.named_or_tied), ", "),
             one.agrees() ? ""
                          : fmt::format("   DIFFERS (foretold: {})",
                                        fmt::join(effect::NamesOf(accuracy::Foretold(p)), ", ")));
  static_cast<void>(std::fflush(stdout));
}

nlohmann::ordered_json ComparedJson(const Compared& one) {
  const Prediction& p = *one.prediction;
  return {{"seed", one.seed},
          {"hidden", effect::At(one.hidden).name},
          {"foretold", Word(p.isolation)},
          {"foretold_named", effect::NamesOf(accuracy::Foretold(p))},
          {"detectable_nat", p.detectable_nat},
          {"evidence_nat", p.evidence_nat},
          {"probability", p.probability},
          {"answered", Word(one.answered)},
          {"answered_named", effect::NamesOf(one.named_or_tied)},
          {"agrees", one.agrees()},
          {"entries", one.entries.all},
          {"entries_right", one.entries.right}};
}

void RefuseOtherThanSingle(const std::vector<accuracy::TrialPlan>& plans) {
  for (const accuracy::TrialPlan& plan : plans) {
    if (plan.hidden.size() == 1 && plan.outside == accuracy::Unmodelled::kNothing) continue;
    throw Problem(ExitStatus::kUsage,
                  "--isolability foretells single effects: give --seeds, not --clean, --outside, "
                  "--pairs or --weak");
  }
}

}  // namespace

nlohmann::ordered_json RunIsolability(const BenchOptions& options, const accuracy::TestRig& bench) {
  const auto plans = Plans(options, bench);
  RefuseOtherThanSingle(plans);
  const auto answers = ReadAnswers(options.answered_path);
  std::vector<Compared> compared(plans.size());
  std::mutex printing;
  ForEachTrial(plans.size(), options.jobs, [&](std::size_t i) {
    compared[i] = Compare(plans[i], bench, options, answers);
    const std::lock_guard lock(printing);
    PrintCompared(compared[i]);
  });
  nlohmann::ordered_json json;
  std::size_t trials = 0;
  std::size_t agree = 0;
  accuracy::RowEntries entries;
  json["trials"] = nlohmann::ordered_json::array();
  for (const Compared& one : compared) {
    if (!one.prediction) continue;
    ++trials;
    agree += one.agrees() ? 1U : 0U;
    entries.all += one.entries.all;
    entries.right += one.entries.right;
    json["trials"].push_back(ComparedJson(one));
  }
  const auto percent = [](std::size_t part, std::size_t all) {
    return all == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(all);
  };
  fmt::print(
      "\nForetold and answered alike (found, tied, taken for another, not visible): {} of {} "
      "trials "
      "({:.1f} %)\nEntries of the matrix (which effects are named or tied): {} of {} ({:.1f} %)\n",
      agree, trials, percent(agree, trials), entries.right, entries.all,
      percent(entries.right, entries.all));
  json["agree"] = agree;
  json["entries_right"] = entries.right;
  json["entries"] = entries.all;
  return json;
}

}  // namespace levitas::cli
