#include "diagnosis/refine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace levitas::diagnosis {

double Refiner::Penalty(const std::vector<double>& theta,
                        const std::vector<Hypothesis>& causes) const {
  double penalty = 0.0;
  for (std::size_t i = 0; i < theta.size(); ++i) {
    const Term& term = terms_[i];
    const bool moved = std::any_of(causes.begin(), causes.end(), [i](const Hypothesis& h) {
      return std::find(h.terms.begin(), h.terms.end(), i) != h.terms.end();
    });
    double variance = term.nuisance() ? term.tolerance * term.tolerance : 0.0;
    if (moved) variance += term.scale() * term.scale();
    const double away = theta[i] - term.usual;
    if (variance > 0.0) penalty += away * away / variance;
  }
  return penalty;
}

double Refiner::SetEvidence(const LinearProblem& problem, const std::vector<Term>& terms,
                            const std::vector<Hypothesis>& causes) {
  const auto fit = Evidence(problem, terms, causes).Solve();
  double evidence = fit.log_evidence - 0.5 * problem.ete;
  for (const Hypothesis& h : causes) {
    evidence += h.log_prior + (h.positive ? std::log(2.0) : 0.0);
  }
  return evidence;
}

Refined Refiner::Fit(const std::vector<Hypothesis>& causes, std::vector<double> start,
                     const Whitener& whitener, int passes) const {
  constexpr double kWorse = 0.5;  // [nat]
  constexpr int kMostHalvings = 3;
  Refined best;
  double best_cost = std::numeric_limits<double>::infinity();
  std::vector<double> theta = std::move(start);
  int halvings = 0;
  for (int pass = 0; pass < passes;) {
    const auto runs = search_.Run(records_, gains_, theta);
    const double cost =
        0.5 * (SquaredSum(runs, whitener.filter.size(), whitener) + Penalty(theta, causes));
    if (!std::isfinite(cost) || cost > best_cost + kWorse) {
      if (++halvings > kMostHalvings) break;
      // Without a run to go back to, towards the usual rig.
      for (std::size_t i = 0; i < theta.size(); ++i) {
        theta[i] = 0.5 * (theta[i] + (best.ok ? best.theta[i] : terms_[i].usual));
      }
      continue;
    }
    const double gained = best_cost - cost;
    best.theta = theta;
    best_cost = cost;
    best.ok = true;
    best.problem = search_.Linearise(runs, theta, whitener, search_.NuisancesAnd(causes));
    theta = search_.Solve(best.problem, causes);
    ++pass;
    if (gained < kWorse) break;
  }
  if (!best.ok) return best;
  best.evidence = SetEvidence(best.problem, terms_, causes);
  if (!std::isfinite(best.evidence)) best.ok = false;
  // The last step is taken on trust when it was not found too long.
  if (halvings == 0) best.theta = theta;
  return best;
}

Refined Refiner::Approach(std::vector<double> start, std::size_t whitening_order,
                          int passes) const {
  constexpr double kSettled = 2.0;  // [nat]
  constexpr int kMostHalvings = 3;
  Refined best;
  std::vector<double> theta = std::move(start);
  Whitener whitener;
  double before = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < passes; ++pass) {
    auto runs = search_.Run(records_, gains_, theta);
    double gained = before;
    for (int halving = 0; pass > 0; ++halving) {
      gained = before - 0.5 * (SquaredSum(runs, axes_, whitener) + Penalty(theta, {}));
      if (std::isfinite(gained) && gained > -kSettled) break;
      if (halving == kMostHalvings) return best;
      for (std::size_t i = 0; i < theta.size(); ++i) theta[i] = 0.5 * (theta[i] + best.theta[i]);
      runs = search_.Run(records_, gains_, theta);
    }
    whitener = MakeWhitener(runs, axes_, whitening_order);
    before = 0.5 * (SquaredSum(runs, axes_, whitener) + Penalty(theta, {}));
    if (!std::isfinite(before)) break;
    best.theta = theta;
    best.ok = true;
    if (pass > 0 && gained < kSettled) break;
    best.problem = search_.Linearise(runs, theta, whitener, search_.Nuisances());
    best.evidence = SetEvidence(best.problem, terms_, {});
    theta = search_.Solve(best.problem, {});
  }
  return best;
}

}  // namespace levitas::diagnosis
