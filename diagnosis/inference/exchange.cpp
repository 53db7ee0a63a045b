#include "diagnosis/inference/exchange.hpp"

#include <algorithm>
#include <utility>

#include "diagnosis/inference/ranking.hpp"
#include "diagnosis/inference/sharpen.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kOthers = 2;  ///< tried in the place of one cause
constexpr double kShare = 0.4;      ///< of its gain, by which the screen may be wrong
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

/// Refines the shapes of all families among the causes in turn.
Refined SharpenAll(Inquiry& q, const std::vector<Hypothesis>& causes, Refined fit) {
  for (const Hypothesis& cause : causes) {
    if (!fit.ok || !HasFamily(cause, q.terms)) continue;
    fit = Sharpen(q.refiner, cause, causes, q.view, q.effort.passes, std::move(fit), q.terms);
  }
  return fit;
}

/// Alternatives whose evidence is near that of a cause, given the other causes; best first.
std::vector<Candidate> Near(const Inquiry& q, std::size_t at) {
  const double own = q.GainOf(at);
  std::vector<Candidate> near =
      Screen(Evidence(q.view.problem, q.terms, Without(q.causes, at)), q.search.hypotheses());
  std::erase_if(near, [&](const Candidate& c) {
    return c.score < own - std::max(kNear, kShare * own) ||
           std::any_of(q.causes.begin(), q.causes.end(),
                       [&c](const Hypothesis& h) { return h.effect == c.effect; });
  });
  near.resize(std::min(near.size(), kOthers));
  return near;
}

void Keep(Inquiry& q, std::vector<Hypothesis> causes, const Refined& fit) {
  for (Hypothesis& cause : causes) {
    if (HasFamily(cause, q.terms)) q.TakePlace(cause);
  }
  q.causes = std::move(causes);
  q.theta = fit.theta;
}

/// True when another one was better.
bool ExchangeOne(Inquiry& q, std::size_t at, Refined& best) {
  bool better = false;
  Shapes shapes = ShapesOf(q.terms);
  std::vector<Hypothesis> winner = q.causes;
  for (const Candidate& other : Near(q, at)) {
    q.Tell(0.74, "exchanging " + q.causes[at].effect + " for " + other.effect);
    std::vector<Hypothesis> causes = q.causes;
    causes[at] = q.search.hypotheses()[other.hypothesis];
    Refined fit = SharpenAll(q, causes, q.Refit(causes));
    if (fit.ok && fit.evidence > best.evidence) {
      best = std::move(fit);
      winner = std::move(causes);
      shapes = ShapesOf(q.terms);
      better = true;
    } else {
      Restore(shapes, q.terms);
    }
  }
  if (better) Keep(q, std::move(winner), best);
  return better;
}

}  // namespace

void ExchangeCauses(Inquiry& q) {
  if (q.causes.size() < 2) return;
  for (int round = 0; round < kRounds; ++round) {
    Refined best = q.refiner.Fit(q.causes, q.theta, q.view, q.effort.passes);
    best = SharpenAll(q, q.causes, std::move(best));
    if (!best.ok) return;
    Keep(q, q.causes, best);
    q.LineariseAll();
    // Whitened anew: only what is fitted with the same whitening can be compared.
    best = q.refiner.Fit(q.causes, q.theta, q.view, 1);
    if (!best.ok) return;
    bool better = false;
    for (std::size_t at = 0; at < q.causes.size() && !better; ++at) {
      better = ExchangeOne(q, at, best);
    }
    if (!better) return;
    q.LineariseAll();
  }
}

}  // namespace levitas::diagnosis
