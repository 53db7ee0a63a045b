#include "diagnosis/inference/suspicion.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "diagnosis/inference/ranking.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {
namespace {

/// Of the leader's evidence: of an effect with less the data say nothing, and what they say of the
/// leader is not said of it.
constexpr double kSpokenFor = 0.5;

/// Fits the candidate's hypothesis and gives it the score of the nonlinear model, validation data
/// included: chance that was fitted does not come again where nothing was.
Refined Confirm(const RecordLandscape& landscape, const Point& calibrated, Candidate& candidate) {
  const std::vector<Hypothesis> causes{landscape.hypotheses()[candidate.hypothesis]};
  landscape.ReportProgress(0.88, fmt::format("refitting {}", effect::At(candidate.effect).name));
  const Refined before = landscape.Fit({}, calibrated, 1);
  Refined fit = landscape.Refit(causes);
  if (!before.ok || !fit.ok) return {};
  candidate.score = std::min(candidate.score, fit.evidence - before.evidence) +
                    HeldGain(landscape.RunAt(before.point), landscape.RunAt(fit.point),
                             landscape.view().whitener);
  candidate.refitted = true;
  return fit;
}

void Suspect(CauseSelection& found, const Hypothesis& cause, Refined fit, Doubt doubt,
             double probability) {
  found.causes = {cause};
  found.point = std::move(fit.point);
  found.doubt = doubt;
  found.probability = probability;
}

bool SuspectLeader(const RecordLandscape& landscape, const Judging& judging,
                   CauseSelection& found) {
  const double tie_nat = judging.decisive_nat;
  if (found.candidates.empty() || !(ProbabilityOfLeader(found.candidates, tie_nat) > kLikely))
    return false;
  const std::size_t hypothesis = found.candidates.front().hypothesis;
  Refined fit = Confirm(landscape, found.WithoutCauses(), found.candidates.front());
  SortByScore(found.candidates);
  if (!fit.ok || found.candidates.front().hypothesis != hypothesis) return false;
  const double probability = ProbabilityOfLeader(found.candidates, tie_nat);
  if (!(probability > kLikely)) return false;
  Suspect(found, landscape.hypotheses()[hypothesis], std::move(fit), Doubt::kWeakEvidence,
          probability);
  return true;
}

/// The hypothesis of the term's effect that moves nothing else.
std::optional<std::size_t> AloneOf(const RecordLandscape& landscape, std::size_t term) {
  const auto& all = landscape.hypotheses();
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].effect != landscape.terms()[term].effect || !Moves(all[i], term)) continue;
    if (!best || all[i].terms.size() < all[*best].terms.size()) best = i;
  }
  return best;
}

void SuspectNumber(const RecordLandscape& landscape, const Judging& judging,
                   CauseSelection& found) {
  const Fit posterior = landscape.EvidenceGiven({}).Solve();
  const auto moved = FurthestNumber(landscape.terms(), posterior, found.calibrated.theta);
  if (!moved || !(moved->chance < judging.number_chance)) return;
  const auto hypothesis = AloneOf(landscape, moved->term);
  if (!hypothesis) return;
  Refined fit = landscape.Refit({landscape.hypotheses()[*hypothesis]});
  if (!fit.ok) return;
  Suspect(found, landscape.hypotheses()[*hypothesis], std::move(fit), Doubt::kMovedNumber,
          1.0 - moved->chance);
  const auto& cause = found.causes.front();
  const auto own = std::find_if(found.candidates.begin(), found.candidates.end(),
                                [&cause](const Candidate& c) { return c.effect == cause.effect; });
  if (own == found.candidates.end()) return;
  own->place = cause.place;
  own->hypothesis = *hypothesis;
  std::rotate(found.candidates.begin(), own, own + 1);
}

}  // namespace

double ProbabilityOfLeader(const std::vector<Candidate>& candidates, double tie_nat) {
  if (candidates.empty() || !std::isfinite(candidates.front().score)) return 0.0;
  const double best = candidates.front().score;
  double leader = 0.0;
  double all = 0.0;
  for (const Candidate& c : candidates) {
    if (!std::isfinite(c.score)) continue;
    const double weight = std::exp(c.score - best);
    all += weight;
    if (c.score > best - tie_nat && c.score >= kSpokenFor * best) leader += weight;
  }
  return leader / (all + static_cast<double>(candidates.size()) * std::exp(-best));
}

double ChanceOfOne(double deviations, std::size_t numbers) {
  const double one = std::erfc(deviations / std::sqrt(2.0));
  return -std::expm1(static_cast<double>(numbers) * std::log1p(-one));
}

std::optional<MovedNumber> FurthestNumber(const std::vector<Term>& terms, const Fit& fit,
                                          const std::vector<double>& theta) {
  constexpr double kDetermined = 0.5;
  std::size_t determined = 0;
  std::optional<MovedNumber> furthest;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Term& term = terms[i];
    if (!term.nuisance() || !term.effect) continue;
    const double deviation = fit.deviation[static_cast<Eigen::Index>(i)] * term.scale();
    if (!(deviation < kDetermined * term.tolerance)) continue;
    ++determined;
    const double away = std::abs(theta[i] - term.healthy_mean) / term.tolerance;
    if (!furthest || away > furthest->tolerances) furthest = MovedNumber{i, away, 1.0};
  }
  if (furthest) furthest->chance = ChanceOfOne(furthest->tolerances, determined);
  return furthest;
}

void SuspectCause(const RecordLandscape& landscape, const Judging& judging, CauseSelection& found) {
  if (!found.causes.empty()) return;
  if (!SuspectLeader(landscape, judging, found)) SuspectNumber(landscape, judging, found);
}

}  // namespace levitas::diagnosis
