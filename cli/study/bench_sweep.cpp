#include "cli/study/bench_sweep.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/problem.hpp"

namespace levitas::cli {
namespace {

/// One of the numbers that decide, and the values it is to have in turn.
struct Sweep {
  const diagnosis::JudgingRow* row{};
  std::vector<double> values;
};

Sweep ParseSweep(const std::string& text) {
  const auto refuse = [&] {
    throw Problem(ExitStatus::kUsage,
                  fmt::format("--sweep: found '{}', allowed: NAME=V,V,... with a name of "
                              "--constants, for example decisive_nat=2,5,10",
                              text));
  };
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) refuse();
  Sweep sweep{&diagnosis::FindJudging(text.substr(0, equals)), {}};
  std::istringstream list(text.substr(equals + 1));
  for (std::string value; std::getline(list, value, ',');) {
    double number = 0.0;
    if (!CLI::detail::lexical_cast(value, number) || !std::isfinite(number)) refuse();
    sweep.values.push_back(number);
  }
  if (sweep.values.empty()) refuse();
  return sweep;
}

/// Right, of how many, among trials that satisfy a condition.
template <class Condition>
std::string Counted(const std::vector<accuracy::TrialScore>& outcomes, Condition counts) {
  std::size_t of = 0;
  std::size_t right = 0;
  for (const accuracy::TrialScore& outcome : outcomes) {
    if (!counts(outcome)) continue;
    ++of;
    if (outcome.Right()) ++right;
  }
  return of == 0 ? "-" : fmt::format("{} of {}", right, of);
}

}  // namespace

nlohmann::ordered_json RunSweep(const BenchOptions& options, const accuracy::TestRig& bench) {
  const Sweep sweep = ParseSweep(options.sweep);
  const std::vector<accuracy::TrialPlan> plans = Plans(options, bench);
  std::string table = fmt::format("{:>18} {:>12} {:>12} {:>12} {:>12}\n", sweep.row->name, "hidden",
                                  "several", "nothing", "outside");
  auto rows = nlohmann::ordered_json::array();
  for (const double value : sweep.values) {
    BenchOptions with = options;
    with.judging.*sweep.row->value = value;
    const std::vector<accuracy::TrialScore> outcomes = TryAll(plans, bench, with);
    using Score = accuracy::TrialScore;
    const std::string hidden =
        Counted(outcomes, [](const Score& o) { return o.truth.size() == 1; });
    const std::string several =
        Counted(outcomes, [](const Score& o) { return o.truth.size() > 1; });
    const std::string none =
        Counted(outcomes, [](const Score& o) { return o.truth.empty() && o.outside.empty(); });
    const std::string outside =
        Counted(outcomes, [](const Score& o) { return !o.outside.empty(); });
    table +=
        fmt::format("{:>18g} {:>12} {:>12} {:>12} {:>12}\n", value, hidden, several, none, outside);
    auto trials = nlohmann::ordered_json::array();
    for (const Score& outcome : outcomes) trials.push_back(Json(outcome));
    rows.push_back({{"value", value}, {"trials", trials}});
  }
  fmt::print("\nright answers with each value ({}; as shipped: {:g})\n{}", sweep.row->unit,
             diagnosis::Judging{}.*sweep.row->value, table);
  return {{"swept", sweep.row->name}, {"rows", rows}};
}

}  // namespace levitas::cli
