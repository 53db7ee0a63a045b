#include "diagnosis/inference/moved_calibration.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "diagnosis/inference/ranking.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {
namespace {

constexpr double kSurely = 1.645;  // deviations: 95 %, one side

/// The hypothesis of the term's effect that moves it and that evidence prefers.
std::optional<std::size_t> BestOf(const RecordLandscape& landscape,
                                  const std::vector<Hypothesis>& causes, std::size_t term) {
  const Evidence base = landscape.EvidenceGiven(causes);
  const auto& all = landscape.hypotheses();
  std::optional<std::size_t> best;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].effect != landscape.terms()[term].effect || !Moves(all[i], term)) continue;
    const double gain = base.Gain(all[i]);
    if (gain <= most) continue;
    most = gain;
    best = i;
  }
  return best;
}

/// [nat] by which the data alone refuse the number of the file.
double AgainstFile(const Term& t, const Fit& fit, double theta, std::size_t term) {
  const double deviation = fit.deviation[static_cast<Eigen::Index>(term)] * t.scale();
  return 0.5 * std::pow((theta - t.healthy_mean) / deviation, 2);
}

/// Puts the candidate of the effect where its evidence says, or adds it.
void Rank(std::vector<Candidate>& candidates, Candidate named) {
  std::erase_if(candidates, [&](const Candidate& c) { return c.effect == named.effect; });
  candidates.push_back(std::move(named));
  SortByScore(candidates);
}

/// Ranks the cause that was named last.
void RankNamed(const RecordLandscape& landscape, double gain_nat, CauseSelection& found) {
  const Hypothesis& named = found.causes.back();
  Rank(found.candidates,
       {named.effect, named.place, gain_nat, IndexOf(landscape.hypotheses(), named), true});
}

/// True when a cause was added.
bool NameOne(const RecordLandscape& landscape, const SelectionRules& rules, CauseSelection& found) {
  const Fit fit = landscape.EvidenceGiven(found.causes).Solve();
  const std::vector<std::size_t> moved = MovedBeyond(landscape.terms(), fit, found.point.theta,
                                                     found.causes, rules.judging.moved_tolerances);
  if (moved.empty()) return false;
  const Refined before = landscape.Fit(found.causes, found.point, 1);
  if (!before.ok) return false;
  const Judging& judging = rules.judging;
  const double explained =
      std::max(0.0, before.evidence - landscape.EvidenceOf(OfExactForm(found.causes)));
  const double enough = judging.decisive_nat + judging.form_share * explained;
  CauseSet best;
  for (const std::size_t term : moved) {
    const auto at = BestOf(landscape, found.causes, term);
    if (!at || AgainstFile(landscape.terms()[term], fit, found.point.theta[term], term) < enough)
      continue;
    std::vector<Hypothesis> causes = found.causes;
    causes.push_back(landscape.hypotheses()[*at]);
    landscape.ReportProgress(0.88,
                             fmt::format("refitting {}", effect::At(causes.back().effect).name));
    best.Take(causes, landscape.Refit(causes, before.evidence));
  }
  if (!best.fit.ok || best.fit.evidence <= before.evidence) return false;
  const bool first = found.causes.empty();
  found.causes = std::move(best.causes);
  found.point = best.fit.point;
  if (first) RankNamed(landscape, best.fit.evidence - before.evidence, found);
  return true;
}

}  // namespace

double SurelyAway(const Term& term, const Fit& fit, const std::vector<double>& theta,
                  std::size_t index) {
  const double deviation = fit.deviation[static_cast<Eigen::Index>(index)] * term.scale();
  return (std::abs(theta[index] - term.healthy_mean) - kSurely * deviation) / term.tolerance;
}

std::vector<std::size_t> MovedBeyond(const std::vector<Term>& terms, const Fit& fit,
                                     const std::vector<double>& theta,
                                     const std::vector<Hypothesis>& causes, double tolerances) {
  std::vector<std::pair<double, std::size_t>> moved;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Term& term = terms[i];
    if (!term.nuisance() || !term.effect || Moves(causes, i)) continue;
    const double away = SurelyAway(term, fit, theta, i);
    if (away > tolerances) moved.emplace_back(away, i);
  }
  std::sort(moved.rbegin(), moved.rend());
  std::vector<std::size_t> indices;
  indices.reserve(moved.size());
  for (const auto& [away, i] : moved) indices.push_back(i);
  return indices;
}

void DropNeedless(const RecordLandscape& landscape, const SelectionRules& rules, std::size_t from,
                  CauseSelection& found) {
  Refined whole = landscape.Fit(found.causes, found.point, rules.effort.passes);
  for (std::size_t i = from; whole.ok && i + 1 < found.causes.size();) {
    const std::vector<Hypothesis> rest = Without(found.causes, i);
    Point start = whole.point;
    for (const std::size_t term : found.causes[i].terms) {
      const Term& t = landscape.terms()[term];
      if (!t.nuisance() && !Moves(rest, term)) start.theta[term] = t.healthy_mean;
    }
    Refined fit = landscape.Fit(rest, start, rules.effort.passes, whole.evidence);
    if (!fit.ok || fit.evidence < whole.evidence) {
      ++i;
      continue;
    }
    std::erase_if(found.candidates,
                  [&](const Candidate& c) { return c.effect == found.causes[i].effect; });
    found.causes = rest;
    found.point = fit.point;
    whole = std::move(fit);
  }
  if (found.causes.size() != 1) return;
  const Refined null = landscape.Fit({}, found.WithoutCauses(), 1);
  if (null.ok && whole.ok) RankNamed(landscape, whole.evidence - null.evidence, found);
}

void NameMovedCalibration(const RecordLandscape& landscape, const SelectionRules& rules,
                          CauseSelection& found) {
  const std::size_t before = found.causes.size();
  while (found.causes.size() < rules.most_causes && NameOne(landscape, rules, found)) {
  }
  if (found.causes.size() > before + 1) DropNeedless(landscape, rules, before, found);
}

}  // namespace levitas::diagnosis
