#include "cli/study/bench_spoilt.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <mutex>
#include <nlohmann/json.hpp>

#include "benchmark/accuracy/drawn_rig.hpp"
#include "benchmark/accuracy/spoilt_record.hpp"
#include "cli/study/bench_workers.hpp"
#include "common/problem.hpp"
#include "diagnosis/record_errors/find.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::cli {
namespace {

constexpr int kKinds = 8;  ///< of errors that are drawn

struct Outcome {
  std::string group, made;
  std::vector<std::string> said;
  bool named{}, accused{};
  std::string failure;
};

accuracy::TrialPlan PlanOf(const BenchOptions& options, int number) {
  accuracy::TrialPlan plan;
  plan.seed = options.first + static_cast<std::uint64_t>(number);
  plan.bits_per_axis = options.bits;
  plan.runup_s = std::max(1.0, plan.runup_s * options.bits / 2047.0);
  return plan;
}

Outcome TrySpoilt(const BenchOptions& options, const accuracy::TestRig& bench, int number) {
  Outcome out;
  accuracy::TrialPlan plan = PlanOf(options, number);
  const bool spoilt = number < options.spoilt;
  const int effect = number - 2 * options.spoilt;
  if (effect >= 0) {
    const auto& of = bench.trials.effects;
    const effect::Id id = of[static_cast<std::size_t>(effect) % of.size()].id;
    plan.hidden = {id};
    out.made = effect::At(id).name;
  }
  out.group = spoilt ? "spoilt" : effect >= 0 ? "effect" : "healthy";
  const accuracy::Trial trial =
      options.shipped ? accuracy::MakeTrial(bench, plan) : accuracy::MakeDrawnTrial(bench, plan);
  const diagnosis::RigView view(trial.rig.numbers, trial.rig.plant);
  accuracy::Spoilt made{{}, {}, 0.0, trial.records, {{}, {}, {}}};
  if (spoilt) {
    made = accuracy::Spoil(trial.rig, trial.records,
                           static_cast<diagnosis::RecordErrorKind>(number % kKinds),
                           plan.seed * 77 + 1);
    out.made = fmt::format("{} {} {:.4g}", diagnosis::Name(made.kind), fmt::join(made.columns, ","),
                           made.size);
  }
  for (std::size_t r = 0; r < made.records.size(); ++r) {
    const auto found = diagnosis::FindRecordErrors(view, made.records[r], made.times_s[r]);
    const bool named = spoilt && accuracy::IsNamed(made, found);
    out.named = out.named || named;
    out.accused = out.accused || found.errors.size() > (named ? 1U : 0U);
    for (const auto& error : found.errors) {
      out.said.push_back(fmt::format("{}: {} [{}] {:.4g}", found.record,
                                     diagnosis::Name(error.kind), fmt::join(error.columns, ","),
                                     error.size));
    }
  }
  return out;
}

bool Right(const Outcome& o) {
  return o.failure.empty() && !o.accused && (o.named || o.group != "spoilt");
}

}  // namespace

nlohmann::ordered_json RunSpoilt(const BenchOptions& options, const accuracy::TestRig& bench) {
  const int count = 2 * options.spoilt + 2 * options.spoilt / 5;
  std::vector<Outcome> outcomes(static_cast<std::size_t>(count));
  std::mutex printing;
  ForEachTrial(outcomes.size(), options.jobs, [&](std::size_t i) {
    Outcome& out = outcomes[i];
    try {
      out = TrySpoilt(options, bench, static_cast<int>(i));
    } catch (const Problem& problem) {  // a rig that does not levitate is no trial
      out.group = "none";
      out.failure = problem.what();
    }
    const std::lock_guard lock(printing);
    if (out.failure.empty() && Right(out) && !options.explain) return;
    fmt::print("{:>6} {:<8}{:<50} -> {}{}\n", options.first + i, out.group, out.made,
               fmt::join(out.said, "; "),
               Right(out) ? "" : (out.named ? "   (and more)" : "   WRONG"));
  });
  auto json = nlohmann::ordered_json::array();
  for (const char* group : {"spoilt", "healthy", "effect"}) {
    int right = 0;
    int of = 0;
    for (const Outcome& out : outcomes) {
      if (out.group != group) continue;
      ++of;
      right += Right(out) ? 1 : 0;
    }
    fmt::print("{}: right {} of {}\n", group, right, of);
  }
  for (const Outcome& out : outcomes) {
    json.push_back(
        {{"group", out.group}, {"made", out.made}, {"said", out.said}, {"right", Right(out)}});
  }
  return {{"trials", json}};
}

}  // namespace levitas::cli
