#include "diagnosis/inference/exchange.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "diagnosis/inference/ranking.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kOthers = 2;  ///< tried in the place of one cause
constexpr int kRounds = 2;

/// Refines the shapes of all families among the causes in turn, where `worth` can be reached.
Refined RefineShapes(EvidenceLandscape& landscape, const std::vector<Hypothesis>& causes,
                     Refined fit, double worth) {
  for (std::size_t i = 0; i < causes.size() && fit.ok; ++i) {
    fit = landscape.RefineShapeOf(causes, i, std::move(fit), worth);
  }
  return fit;
}

/// Alternatives whose evidence is near that of a cause, given the other causes; best first.
std::vector<Candidate> Near(const EvidenceLandscape& landscape, const Judging& judging,
                            const std::vector<Hypothesis>& causes, std::size_t at) {
  const std::vector<Hypothesis> others = Without(causes, at);
  const double own = landscape.GainOf(causes[at], others);
  std::vector<Candidate> near = landscape.Screen(others);
  std::erase_if(near, [&](const Candidate& c) {
    return c.score < own - std::max(judging.near_nat, judging.exchange_share * own) ||
           std::any_of(causes.begin(), causes.end(),
                       [&c](const Hypothesis& h) { return h.effect == c.effect; });
  });
  near.resize(std::min(near.size(), kOthers));
  return near;
}

void Keep(EvidenceLandscape& landscape, std::vector<Hypothesis> causes, const Refined& fit,
          CauseSelection& found) {
  for (Hypothesis& cause : causes) landscape.TakePlace(cause);
  found.causes = std::move(causes);
  found.theta = fit.theta;
}

/// True when another one was better.
bool ExchangeOne(EvidenceLandscape& landscape, const SelectionRules& rules, std::size_t at,
                 Refined& best, CauseSelection& found) {
  bool better = false;
  EvidenceLandscape::AllShapes shapes = landscape.Shapes();
  std::vector<Hypothesis> winner = found.causes;
  for (const Candidate& other : Near(landscape, rules.judging, found.causes, at)) {
    landscape.ReportProgress(
        0.74, fmt::format("exchanging {} for {}", effect::At(found.causes[at].effect).name,
                          effect::At(other.effect).name));
    std::vector<Hypothesis> causes = found.causes;
    causes[at] = landscape.hypotheses()[other.hypothesis];
    Refined fit = RefineShapes(landscape, causes, landscape.Refit(causes), best.evidence);
    if (fit.ok && fit.evidence > best.evidence) {
      best = std::move(fit);
      winner = std::move(causes);
      shapes = landscape.Shapes();
      better = true;
    } else {
      landscape.Restore(shapes);
    }
  }
  if (better) Keep(landscape, std::move(winner), best, found);
  return better;
}

}  // namespace

void ExchangeCauses(EvidenceLandscape& landscape, const SelectionRules& rules,
                    CauseSelection& found) {
  if (found.causes.size() < 2) return;
  for (int round = 0; round < kRounds; ++round) {
    Refined best = landscape.Fit(found.causes, found.theta, rules.effort.passes);
    best = RefineShapes(landscape, found.causes, std::move(best), kAnyEvidence);
    if (!best.ok) return;
    Keep(landscape, found.causes, best, found);
    landscape.LineariseAt(found.theta);
    // Whitened anew: only what is fitted with the same whitening can be compared.
    best = landscape.Fit(found.causes, found.theta, 1);
    if (!best.ok) return;
    bool better = false;
    for (std::size_t at = 0; at < found.causes.size() && !better; ++at) {
      better = ExchangeOne(landscape, rules, at, best, found);
    }
    if (!better) return;
    landscape.LineariseAt(found.theta);
  }
}

}  // namespace levitas::diagnosis
