#include "benchmark/accuracy/scores.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "benchmark/accuracy/true_value.hpp"
#include "numerics/normal_distribution.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::accuracy {
namespace {

bool Holds(const std::vector<effect::Id>& list, effect::Id effect) {
  return std::find(list.begin(), list.end(), effect) != list.end();
}

std::string NameOf(effect::Id id) { return std::string(effect::At(id).name); }

std::string First(const TrialScore& o) {
  if ((o.verdict != "effect" && o.verdict != "suspected") || o.named.empty()) return o.verdict;
  return NameOf(o.named.front());
}

double Median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

std::string HeldText(const TrialScore& o) {
  return o.record_nat < 0.0 ? "evidence unknown"
                            : fmt::format("the records hold {:.0f} nat", o.record_nat);
}

struct Count {
  int right{}, partly{}, of{};
  void Add(const TrialScore& o) {
    ++of;
    right += o.Right() ? 1 : 0;
    partly += !o.Right() && o.Partly() ? 1 : 0;
  }
  [[nodiscard]] std::string Text() const { return of == 0 ? "-" : fmt::format("{}/{}", right, of); }
};

}  // namespace

bool TrialScore::Right() const {
  if (truth.empty() && outside.empty()) return verdict == "none";
  if (truth.empty()) return verdict == "unknown";
  return (verdict == "effect" || verdict == "suspected") && !named.empty() &&
         (named.front() == truth.front() || Holds(ties, truth.front()));
}

bool TrialScore::Names(effect::Id effect) const {
  return Holds(named, effect) || Holds(ties, effect);
}

bool TrialScore::Partly() const {
  return std::any_of(truth.begin(), truth.end(), [this](const auto& e) { return Names(e); });
}

bool TrialScore::NamesMain() const { return !truth.empty() && Names(truth.front()); }

bool TrialScore::NamesAll() const {
  return std::all_of(truth.begin(), truth.end(), [this](const auto& e) { return Names(e); });
}

bool TrialScore::HoldsAllClearly() const {
  return std::all_of(missed.begin(), missed.end(), [](const auto& effect) {
    return SizeOf(effect.second.value_or(std::numeric_limits<double>::infinity())) == Size::kClear;
  });
}

TrialScore Judge(const TrialPlan& plan, const GroundTruth& ground_truth,
                 const diagnosis::DiagnosisReport& report) {
  TrialScore o;
  o.seed = plan.seed;
  o.truth = ground_truth.effects;
  o.in_file = ground_truth.in_file;
  if (ground_truth.outside != Unmodelled::kNothing) o.outside = Name(ground_truth.outside);
  o.drawn = ground_truth.size;
  o.verdict = Word(report.verdict);
  for (const auto& cause : report.causes) {
    if (const effect::Row* row = effect::Find(cause.effect)) o.named.push_back(row->id);
  }
  o.ties = effect::IdsOf(report.also_possible);
  const std::string hidden = o.truth.empty() ? "" : NameOf(o.truth.front());
  o.score_nat = report.candidates.empty() ? 0.0 : report.candidates.front().evidence_nat;
  for (const auto& c : report.candidates) {
    if (!o.truth.empty() && c.effect == hidden) {
      o.available_nat = std::max(o.available_nat, c.evidence_nat);
    }
    if (o.nearest.size() < 7) {
      o.nearest.push_back(fmt::format("{} [{}] {:.1f}{}", c.effect, c.place, c.evidence_nat,
                                      c.refitted ? "" : "?"));
    }
  }
  o.explained = report.residual.explained;
  o.remainder_sigma = report.residual.sigma;
  o.achieved = report.validation.achieved.fraction;
  for (const auto& p : report.parameters) {
    if (o.truth.empty() || p.effect != hidden) continue;
    const double truth = TrueValue(p, ground_truth).value_or(0.0);
    if (truth == 0.0) continue;
    const double deviation = 0.5 * (p.high - p.low) / numerics::kInterval90;
    o.parameter_error = std::abs(p.value - truth) / std::abs(truth);
    o.parameter_sigmas = deviation > 0.0 ? std::abs(p.value - truth) / deviation : 99.0;
    break;
  }
  return o;
}

void AddInformedDiagnosis(const diagnosis::DiagnosisReport& informed, std::optional<double> held,
                          TrialScore& outcome) {
  const std::string truth = NameOf(outcome.truth.front());
  for (const auto& candidate : informed.candidates) {
    if (candidate.effect != truth) continue;
    outcome.available_nat = std::max(outcome.available_nat, candidate.evidence_nat);
  }
  outcome.record_nat = held.value_or(-1.0);
  const bool named = std::any_of(informed.causes.begin(), informed.causes.end(),
                                 [&truth](const auto& cause) { return cause.effect == truth; });
  const bool there =
      held ? *held >= kAvailableFrom : informed.verdict == diagnosis::Verdict::kUnknown;
  outcome.informed_failed = !named && there;
}

namespace {

/// Counts of a whole benchmark.
struct Tally {
  std::map<effect::Id, std::map<Size, Count>, effect::ByName> by_effect;
  std::map<Size, Count> by_size;
  Count clean, outside, several;
  int several_main = 0;
  int several_all = 0;
  int several_clear = 0;
  std::vector<double> achieved, seconds;
  std::string failed;
  int compared = 0;
  int good = 0;

  void Add(const TrialScore& o);

 private:
  void AddSeveral(const TrialScore& o);
  void AddSingle(const TrialScore& o);
};

void Tally::Add(const TrialScore& o) {
  seconds.push_back(o.seconds);
  if (o.truth.empty()) {
    (o.outside.empty() ? clean : outside).Add(o);
  } else if (o.truth.size() > 1) {
    AddSeveral(o);
  } else {
    AddSingle(o);
  }
}

void Tally::AddSeveral(const TrialScore& o) {
  several.Add(o);
  several_main += o.NamesMain() ? 1 : 0;
  several_all += o.NamesAll() ? 1 : 0;
  several_clear += o.HoldsAllClearly() ? 1 : 0;
}

void Tally::AddSingle(const TrialScore& o) {
  by_effect[o.truth.front()][o.size()].Add(o);
  by_size[o.size()].Add(o);
  if (o.informed_failed) {
    failed += fmt::format("  {} {} ({}, {})\n", o.seed, NameOf(o.truth.front()), Name(o.size()),
                          HeldText(o));
  }
  if (o.size() != Size::kClear || !o.Right()) return;
  achieved.push_back(o.achieved);
  if (o.parameter_error < 0.0) return;
  ++compared;
  good += o.parameter_error < 0.1 || o.parameter_sigmas < 2.0 ? 1 : 0;
}

}  // namespace

std::string Tables(const std::vector<TrialScore>& outcomes) {
  Tally tally;
  for (const TrialScore& o : outcomes) tally.Add(o);
  std::string out =
      fmt::format("{:<26}{:>9}{:>10}{:>8}{:>8}\n{:<26}{:>9}{:>10}{:>8}{:>8}\n", "effect", "clear",
                  "moderate", "faint", "below", "evidence in the records", "25 nat", "10", "5", "");
  const auto line = [&out](const std::string& name, std::map<Size, Count>& counts) {
    out += fmt::format("{:<26}{:>9}{:>10}{:>8}{:>8}\n", name, counts[Size::kClear].Text(),
                       counts[Size::kModerate].Text(), counts[Size::kFaint].Text(),
                       counts[Size::kBelow].Text());
  };
  for (auto& [effect, counts] : tally.by_effect) line(NameOf(effect), counts);
  line("all", tally.by_size);
  if (!tally.failed.empty()) {
    out += "\ninformed diagnosis failed, counted as not named in the size drawn:\n" + tally.failed;
  }
  out += fmt::format(
      "\nnothing hidden, called none: {}\noutside the vocabulary, called unknown: {}\n"
      "several hidden, main one named: {}/{}, first: {}; all named: {}/{}; where the records hold "
      "every one "
      "clearly: {}/{}\n",
      tally.clean.Text(), tally.outside.Text(), tally.several_main, tally.several.of,
      tally.several.Text(), tally.several_all, tally.several.of, tally.several_all,
      tally.several_clear);
  out += fmt::format(
      "clear and right: parameter within 10 % or two deviations {}/{}, median share of "
      "the achievable gain {:.3f}\nmedian wall time {:.1f} s\n",
      tally.good, tally.compared, Median(tally.achieved), Median(tally.seconds));
  return out;
}

std::string ConfusionTable(const std::vector<TrialScore>& outcomes) {
  std::map<std::string, std::map<std::string, int>> cells;
  for (const TrialScore& o : outcomes) {
    if (o.truth.size() > 1) continue;
    const std::string truth = !o.truth.empty()    ? NameOf(o.truth.front())
                              : o.outside.empty() ? "(nothing)"
                                                  : "(" + o.outside + ")";
    ++cells[truth][First(o)];
  }
  std::string out = "| hidden | named first (times) |\n|---|---|\n";
  for (const auto& [truth, row] : cells) {
    std::vector<std::pair<std::string, int>> sorted(row.begin(), row.end());
    std::sort(sorted.begin(), sorted.end(),
              [](const auto& a, const auto& b) { return a.second > b.second; });
    out += fmt::format("| {} |", truth);
    for (const auto& [named, times] : sorted)
      out += fmt::format(" {} {}", named, times) + (named == sorted.back().first ? "" : ",");
    out += " |\n";
  }
  return out;
}

}  // namespace levitas::accuracy
