#include "diagnosis/isolability/separation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "diagnosis/inference/moved_calibration.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();

/// Of one effect over its places.
struct Best {
  std::string place;
  double gain{kNever};
  double explained{kNever};
  double paid{};  ///< at the place of the largest gain
};

std::map<effect::Id, Best, effect::ByName> BestOfEffects(
    const Evidence& base, const std::vector<Hypothesis>& hypotheses) {
  std::map<effect::Id, Best, effect::ByName> best;
  for (const Hypothesis& h : hypotheses) {
    const Evidence::Weight weight = base.Weigh(h);
    auto [at, added] = best.try_emplace(h.effect);
    Best& of = at->second;
    if (added) of.paid = weight.paid();
    of.explained = std::max(of.explained, weight.explained);
    if (!(weight.gain() > of.gain)) continue;
    of.gain = weight.gain();
    of.paid = weight.paid();
    of.place = h.place;
  }
  return best;
}

/// That a gain of this mean exceeds the threshold.
double ChanceOf(double mean_nat, double threshold_nat) {
  const double deviation = std::sqrt(2.0 * std::max(mean_nat, 0.5));
  return 0.5 * std::erfc((threshold_nat - mean_nat) / (deviation * std::numbers::sqrt2));
}

/// Whether calibration of the effect's own numbers would go beyond moved_tolerances.
bool MovesItsNumber(effect::Id effect, const Fit& fit, const std::vector<Term>& terms,
                    double tolerances) {
  std::vector<double> theta;
  theta.reserve(terms.size());
  for (std::size_t i = 0; i < terms.size(); ++i) {
    theta.push_back(terms[i].healthy_mean +
                    fit.theta[static_cast<Eigen::Index>(i)] * terms[i].scale());
  }
  const std::vector<std::size_t> moved = MovedBeyond(terms, fit, theta, {}, tolerances);
  return std::any_of(moved.begin(), moved.end(),
                     [&](std::size_t i) { return terms[i].effect == effect; });
}

/// From evidence and alternatives, which are in order.
void Judge(const Judging& judging, Prediction& p) {
  const bool decisive = p.evidence_nat >= judging.decisive_nat;
  const double first = p.alternatives.empty() ? kNever : p.alternatives.front().evidence_nat;
  p.by_moved_number = !decisive && p.by_moved_number && p.evidence_nat > 0.0;
  if (!decisive && !p.by_moved_number && !(first >= judging.decisive_nat)) return;
  const double lead = std::max(p.evidence_nat, first);
  const double near = std::max(judging.decisive_nat, judging.form_share * lead);
  for (const Alternative& other : p.alternatives) {
    if (other.evidence_nat < judging.decisive_nat || other.evidence_nat <= lead - near) break;
    p.ties.push_back(other.effect);
  }
  if (p.evidence_nat <= lead - near) {
    p.isolation = Isolation::kTakenFor;
  } else {
    p.isolation = p.ties.empty() ? Isolation::kFound : Isolation::kTied;
  }
}

}  // namespace

const char* Word(Isolation isolation) noexcept {
  switch (isolation) {
    case Isolation::kFound:
      return "found";
    case Isolation::kTied:
      return "tied";
    case Isolation::kTakenFor:
      return "taken_for";
    case Isolation::kNotVisible:
      break;
  }
  return "not_visible";
}

Prediction Predict(effect::Id effect, const LinearProblem& signature,
                   const std::vector<Term>& terms, const std::vector<Hypothesis>& hypotheses,
                   const Judging& judging) {
  Prediction p;
  p.effect = effect;
  const Evidence base(signature, terms, {});
  const Fit calibrated = base.Solve();
  p.detectable_nat = std::max(0.0, 0.5 * (calibrated.squared_sum + calibrated.penalty));
  p.evidence_nat = kNever;
  for (const auto& [other, best] : BestOfEffects(base, hypotheses)) {
    if (other == effect) {
      // Its own law on the nonlinear model leaves nothing but the prior of its size.
      constexpr double kPrior = 0.5;
      p.evidence_nat = std::max(best.gain, p.detectable_nat - best.paid - kPrior);
      continue;
    }
    p.alternatives.push_back({other, best.place, best.gain,
                              std::max(0.0, p.detectable_nat - std::max(0.0, best.explained))});
  }
  std::stable_sort(
      p.alternatives.begin(), p.alternatives.end(),
      [](const Alternative& a, const Alternative& b) { return a.evidence_nat > b.evidence_nat; });
  const double paid = p.detectable_nat - p.evidence_nat;
  p.visible_from = std::sqrt((judging.decisive_nat + std::max(0.0, paid)) /
                             std::max(p.detectable_nat, std::numeric_limits<double>::min()));
  p.by_moved_number = MovesItsNumber(effect, calibrated, terms, judging.moved_tolerances);
  p.probability = ChanceOf(p.evidence_nat, judging.decisive_nat);
  Judge(judging, p);
  return p;
}

Prediction PredictEvent(effect::Id effect, double evidence_nat, const Judging& judging) {
  Prediction p;
  p.effect = effect;
  p.detectable_nat = p.evidence_nat = evidence_nat;
  p.probability = ChanceOf(evidence_nat, judging.decisive_nat);
  Judge(judging, p);
  return p;
}

}  // namespace levitas::diagnosis
