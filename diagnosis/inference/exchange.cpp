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
Refined RefineShapes(const EvidenceLandscape& landscape, const std::vector<Hypothesis>& causes,
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
           HasEffect(causes, c.effect);
  });
  near.resize(std::min(near.size(), kOthers));
  return near;
}

/// True when another one was better.
bool ExchangeOne(const EvidenceLandscape& landscape, const SelectionRules& rules, std::size_t at,
                 Refined& best, CauseSelection& found) {
  bool better = false;
  std::vector<Hypothesis> winner = found.causes;
  for (const Candidate& other : Near(landscape, rules.judging, found.causes, at)) {
    landscape.ReportProgress(
        0.74, fmt::format("exchanging {} for {}", effect::At(found.causes[at].effect).name,
                          effect::At(other.effect).name));
    std::vector<Hypothesis> causes = found.causes;
    causes[at] = landscape.hypotheses()[other.hypothesis];
    const Point start{landscape.SolutionOf(causes).theta, best.point.shapes};
    Refined fit = landscape.Fit(causes, start, rules.effort.passes);
    fit = RefineShapes(landscape, causes, std::move(fit), best.evidence);
    if (!fit.ok || !(fit.evidence > best.evidence)) continue;
    best = std::move(fit);
    winner = std::move(causes);
    better = true;
  }
  if (!better) return false;
  found.causes = std::move(winner);
  found.point = best.point;
  return true;
}

}  // namespace

void ExchangeCauses(EvidenceLandscape& landscape, const SelectionRules& rules,
                    CauseSelection& found) {
  if (found.causes.size() < 2) return;
  for (int round = 0; round < kRounds; ++round) {
    Refined best = landscape.Fit(found.causes, found.point, rules.effort.passes);
    best = RefineShapes(landscape, found.causes, std::move(best), kAnyEvidence);
    if (!best.ok) return;
    found.point = best.point;
    landscape.LineariseAt(found.point);
    // Whitened anew: only what is fitted with the same whitening can be compared.
    best = landscape.Fit(found.causes, found.point, 1);
    if (!best.ok) return;
    bool better = false;
    for (std::size_t at = 0; at < found.causes.size() && !better; ++at) {
      better = ExchangeOne(landscape, rules, at, best, found);
    }
    if (!better) return;
    landscape.LineariseAt(found.point);
  }
}

}  // namespace levitas::diagnosis
