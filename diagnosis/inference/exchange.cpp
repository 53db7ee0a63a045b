#include "diagnosis/inference/exchange.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "diagnosis/inference/ranking.hpp"
#include "diagnosis/inference/refine_shape.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kOthers = 2;  ///< tried in the place of one cause
constexpr int kRounds = 2;

using Shapes = std::vector<Family::Shape>;

Shapes ShapesOf(const std::vector<Term>& terms) {
  Shapes shapes;
  shapes.reserve(terms.size());
  for (const Term& term : terms) shapes.push_back(term.family.shape);
  return shapes;
}

void Restore(const Shapes& shapes, std::vector<Term>& terms) {
  for (std::size_t i = 0; i < terms.size(); ++i) {
    if (!terms[i].family.member || terms[i].family.shape == shapes[i]) continue;
    Term before = terms[i].family.member(shapes[i]);
    before.family.linearised_as = terms[i].family.linearised_as;
    terms[i] = std::move(before);
  }
}

/// Refines the shapes of all families among the causes in turn, where `worth` can be reached.
Refined SharpenAll(SearchState& state, const std::vector<Hypothesis>& causes, Refined fit,
                   double worth) {
  for (const Hypothesis& cause : causes) {
    if (!fit.ok || !HasFamily(cause, state.terms)) continue;
    fit = RefineShape(state.refiner, cause, causes, state.view, state.effort.passes, std::move(fit),
                      state.terms, worth);
  }
  return fit;
}

/// Alternatives whose evidence is near that of a cause, given the other causes; best first.
std::vector<Candidate> Near(const SearchState& state, std::size_t at) {
  const double own = state.GainOf(at);
  std::vector<Candidate> near =
      Screen(Evidence(state.view.problem, state.terms, Without(state.causes, at)),
             state.search.hypotheses());
  std::erase_if(near, [&](const Candidate& c) {
    return c.score < own - std::max(state.settings.judging.near_nat,
                                    state.settings.judging.exchange_share * own) ||
           std::any_of(state.causes.begin(), state.causes.end(),
                       [&c](const Hypothesis& h) { return h.effect == c.effect; });
  });
  near.resize(std::min(near.size(), kOthers));
  return near;
}

void Keep(SearchState& state, std::vector<Hypothesis> causes, const Refined& fit) {
  for (Hypothesis& cause : causes) {
    if (HasFamily(cause, state.terms)) state.TakePlace(cause);
  }
  state.causes = std::move(causes);
  state.theta = fit.theta;
}

/// True when another one was better.
bool ExchangeOne(SearchState& state, std::size_t at, Refined& best) {
  bool better = false;
  Shapes shapes = ShapesOf(state.terms);
  std::vector<Hypothesis> winner = state.causes;
  for (const Candidate& other : Near(state, at)) {
    state.ReportProgress(0.74, "exchanging " + state.causes[at].effect + " for " + other.effect);
    std::vector<Hypothesis> causes = state.causes;
    causes[at] = state.search.hypotheses()[other.hypothesis];
    Refined fit = SharpenAll(state, causes, state.Refit(causes), best.evidence);
    if (fit.ok && fit.evidence > best.evidence) {
      best = std::move(fit);
      winner = std::move(causes);
      shapes = ShapesOf(state.terms);
      better = true;
    } else {
      Restore(shapes, state.terms);
    }
  }
  if (better) Keep(state, std::move(winner), best);
  return better;
}

}  // namespace

void ExchangeCauses(SearchState& state) {
  if (state.causes.size() < 2) return;
  for (int round = 0; round < kRounds; ++round) {
    Refined best = state.refiner.Fit(state.causes, state.theta, state.view, state.effort.passes);
    best =
        SharpenAll(state, state.causes, std::move(best), -std::numeric_limits<double>::infinity());
    if (!best.ok) return;
    Keep(state, state.causes, best);
    state.LineariseAll();
    // Whitened anew: only what is fitted with the same whitening can be compared.
    best = state.refiner.Fit(state.causes, state.theta, state.view, 1);
    if (!best.ok) return;
    bool better = false;
    for (std::size_t at = 0; at < state.causes.size() && !better; ++at) {
      better = ExchangeOne(state, at, best);
    }
    if (!better) return;
    state.LineariseAll();
  }
}

}  // namespace levitas::diagnosis
