#include "diagnosis/inference/moved_calibration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "diagnosis/inference/ranking.hpp"

namespace levitas::diagnosis {
namespace {

constexpr double kSurely = 1.645;  // deviations: 95 %, one side

/// The hypothesis of the term's effect that moves it and that evidence prefers.
std::optional<std::size_t> BestOf(const SearchState& state, std::size_t term) {
  const Evidence base(state.view.problem, state.terms, state.causes);
  const auto& all = state.search.hypotheses();
  std::optional<std::size_t> best;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].effect != state.terms[term].effect_name() || !Moves(all[i], term)) continue;
    const double gain = base.Gain(all[i]);
    if (gain <= most) continue;
    most = gain;
    best = i;
  }
  return best;
}

/// [nat] by which the data alone refuse the number of the file.
double AgainstFile(const SearchState& state, const Fit& fit, std::size_t term) {
  const Term& t = state.terms[term];
  const double deviation = fit.deviation[static_cast<Eigen::Index>(term)] * t.scale();
  return 0.5 * std::pow((state.theta[term] - t.healthy_mean) / deviation, 2);
}

/// Puts the candidate of the effect where its evidence says, or adds it.
void Rank(SearchState& state, Candidate named) {
  std::erase_if(state.candidates, [&](const Candidate& c) { return c.effect == named.effect; });
  state.candidates.push_back(std::move(named));
  SortByScore(state.candidates);
}

/// True when a cause was added.
bool NameOne(SearchState& state) {
  const Fit fit = Evidence(state.view.problem, state.terms, state.causes).Solve();
  const std::vector<std::size_t> moved = MovedBeyond(state.terms, fit, state.theta, state.causes,
                                                     state.settings.judging.moved_tolerances);
  if (moved.empty()) return false;
  const Refined before = state.refiner.Fit(state.causes, state.theta, state.view, 1);
  if (!before.ok) return false;
  const Judging& judging = state.settings.judging;
  const double explained =
      std::max(0.0, before.evidence - Refiner::EvidenceOfSet(state.view.problem, state.terms, {}));
  const double enough = judging.decisive_nat + judging.form_share * explained;
  CauseSet best;
  for (const std::size_t term : moved) {
    const auto at = BestOf(state, term);
    if (!at || AgainstFile(state, fit, term) < enough) continue;
    std::vector<Hypothesis> causes = state.causes;
    causes.push_back(state.search.hypotheses()[*at]);
    state.ReportProgress(0.88, "refitting " + causes.back().effect);
    best.Take(causes, state.Refit(causes, before.evidence));
  }
  if (!best.fit.ok || best.fit.evidence <= before.evidence) return false;
  const bool first = state.causes.empty();
  state.causes = std::move(best.causes);
  state.theta = best.fit.theta;
  const Hypothesis& named = state.causes.back();
  if (first) {
    const auto& all = state.search.hypotheses();
    const auto own = std::find_if(all.begin(), all.end(), [&named](const Hypothesis& h) {
      return h.effect == named.effect && h.place == named.place;
    });
    Rank(state, {named.effect, named.place, best.fit.evidence - before.evidence,
                 static_cast<std::size_t>(own - all.begin()), true});
  }
  return true;
}

}  // namespace

std::vector<std::size_t> MovedBeyond(const std::vector<Term>& terms, const Fit& fit,
                                     const std::vector<double>& theta,
                                     const std::vector<Hypothesis>& causes, double tolerances) {
  std::vector<std::pair<double, std::size_t>> moved;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Term& term = terms[i];
    if (!term.nuisance() || !term.effect || Moves(causes, i)) continue;
    const double deviation = fit.deviation[static_cast<Eigen::Index>(i)] * term.scale();
    const double away = std::abs(theta[i] - term.healthy_mean) - kSurely * deviation;
    if (away > tolerances * term.tolerance) moved.emplace_back(away / term.tolerance, i);
  }
  std::sort(moved.rbegin(), moved.rend());
  std::vector<std::size_t> indices;
  indices.reserve(moved.size());
  for (const auto& [away, i] : moved) indices.push_back(i);
  return indices;
}

void NameMovedCalibration(SearchState& state) {
  while (state.causes.size() < state.settings.most_causes && NameOne(state)) {
  }
}

}  // namespace levitas::diagnosis
