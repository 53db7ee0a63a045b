#include "cli/study/bench_spoilt.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
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

constexpr int kKinds = 9;  ///< of errors that are drawn

struct Outcome {
  std::string group, made;
  std::vector<std::string> said;
  bool named{}, accused{};
  std::string failure;
};

/// One trial: its seed, its group, and the kind of error or the effect by number.
struct Plan {
  std::uint64_t seed{};
  const char* group{};
  int which{};
};

std::vector<Plan> PlansOf(const BenchOptions& options) {
  std::vector<Plan> plans;
  const auto wanted = [&](const std::string& kind) {
    return options.kinds.empty() || std::ranges::find(options.kinds, kind) != options.kinds.end();
  };
  std::vector<int> kinds;
  for (int kind = 0; kind < kKinds; ++kind) {
    if (wanted(diagnosis::Name(static_cast<diagnosis::RecordErrorKind>(kind))))
      kinds.push_back(kind);
  }
  const auto add = [&](const char* group, int count) {
    for (int i = 0; i < count; ++i) plans.push_back({options.first + plans.size(), group, i});
  };
  if (!kinds.empty()) add("spoilt", options.spoilt);
  for (Plan& plan : plans) plan.which = kinds[plan.seed % kinds.size()];
  if (wanted("healthy")) add("healthy", options.spoilt);
  if (wanted("effect"))
    add("effect", options.kinds.empty() ? 2 * options.spoilt / 5 : options.spoilt);
  return plans;
}

accuracy::Spoilt Make(const Plan& plan, const accuracy::Trial& trial, Outcome& out) {
  if (plan.group != std::string("spoilt")) return {{}, {}, 0.0, trial.records};
  const auto kind = static_cast<diagnosis::RecordErrorKind>(plan.which);
  const std::uint64_t seed = plan.seed * 77 + 1;
  accuracy::Spoilt made = accuracy::Spoil(trial.rig, trial.records, kind, seed);
  out.made = fmt::format("{} {} {:.4g}", diagnosis::Name(made.kind), fmt::join(made.columns, ","),
                         made.size);
  return made;
}

Outcome TrySpoilt(const BenchOptions& options, const accuracy::TestRig& bench, const Plan& plan) {
  Outcome out;
  out.group = plan.group;
  accuracy::TrialPlan trial_plan;
  trial_plan.seed = plan.seed;
  trial_plan.bits_per_axis = options.bits;
  trial_plan.runup_s = std::max(1.0, trial_plan.runup_s * options.bits / 2047.0);
  if (out.group == "effect") {
    const auto& of = bench.trials.effects;
    const effect::Id id = of[static_cast<std::size_t>(plan.which) % of.size()].id;
    trial_plan.hidden = {id};
    out.made = effect::At(id).name;
  }
  const accuracy::Trial trial = options.shipped ? accuracy::MakeTrial(bench, trial_plan)
                                                : accuracy::MakeDrawnTrial(bench, trial_plan);
  const accuracy::Spoilt made = Make(plan, trial, out);
  const diagnosis::RigView view(trial.rig.numbers, trial.rig.plant);
  for (const auto& found : diagnosis::FindErrorsOfRecords(view, made.records)) {
    const bool named = out.group == "spoilt" && accuracy::IsNamed(made, found);
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
  const std::vector<Plan> plans = PlansOf(options);
  std::vector<Outcome> outcomes(plans.size());
  std::mutex printing;
  ForEachTrial(outcomes.size(), options.jobs, [&](std::size_t i) {
    Outcome& out = outcomes[i];
    try {
      out = TrySpoilt(options, bench, plans[i]);
    } catch (const Problem& problem) {  // a rig that does not levitate is no trial
      out.group = "none";
      out.failure = problem.what();
    }
    const std::lock_guard lock(printing);
    if (out.failure.empty() && Right(out) && !options.explain) return;
    fmt::print("{:>6} {:<8}{:<50} -> {}{}\n", plans[i].seed, out.group, out.made,
               fmt::join(out.said, "; "),
               Right(out) ? "" : (out.named ? "   (and more)" : "   WRONG"));
    std::fflush(stdout);
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
