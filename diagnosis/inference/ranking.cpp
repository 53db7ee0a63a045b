#include "diagnosis/inference/ranking.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {

std::vector<Candidate> Screen(const Evidence& base, const std::vector<Hypothesis>& hypotheses) {
  std::vector<double> gains;
  gains.reserve(hypotheses.size());
  for (const Hypothesis& h : hypotheses) gains.push_back(base.Gain(h));
  return BestOfEachEffect(hypotheses, gains);
}

std::vector<Candidate> BestOfEachEffect(const std::vector<Hypothesis>& hypotheses,
                                        const std::vector<double>& gains) {
  std::map<effect::Id, Candidate, effect::ByName> best;
  for (std::size_t i = 0; i < hypotheses.size(); ++i) {
    if (!std::isfinite(gains[i])) continue;
    const Candidate candidate{hypotheses[i].effect, hypotheses[i].place, gains[i], i, false};
    const auto [at, added] = best.try_emplace(candidate.effect, candidate);
    if (!added && candidate.score > at->second.score) at->second = candidate;
  }
  std::vector<Candidate> sorted;
  sorted.reserve(best.size());
  for (const auto& [effect, candidate] : best) sorted.push_back(candidate);
  SortByScore(sorted);
  return sorted;
}

void SortByScore(std::vector<Candidate>& candidates) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
}

std::vector<effect::Id> Ties(const std::vector<Candidate>& candidates,
                             const std::vector<Hypothesis>& causes, double tie_nat,
                             double form_share) {
  std::vector<effect::Id> ties;
  if (causes.empty()) return ties;
  const auto own = std::find_if(candidates.begin(), candidates.end(), [&causes](const auto& c) {
    return c.effect == causes.front().effect;
  });
  if (own == candidates.end() || own->score < tie_nat) return ties;
  for (const Candidate& c : candidates) {
    const bool also = HasEffect(causes, c.effect);
    const bool refuted = c.validation_nat && own->validation_nat &&
                         *c.validation_nat < *own->validation_nat - tie_nat;
    const double near = c.refitted ? std::max(tie_nat, form_share * own->score) : tie_nat;
    if (!also && !refuted && c.score > own->score - near) ties.push_back(c.effect);
  }
  return ties;
}

double Explained(const Residual& before, const Residual& after) {
  double excess_before = 0.0;
  double excess_after = 0.0;
  for (std::size_t a = 0; a < before.channels.size(); ++a) {
    for (std::size_t i = 1; i < before.channels[a].ratio.size() * 2 / 3; ++i) {
      excess_before += before.channels[a].ratio[i] - 1.0;
      excess_after += after.channels[a].ratio[i] - 1.0;
    }
  }
  return excess_before > 0.0 ? 1.0 - excess_after / excess_before : 1.0;
}

double HeldGain(const std::vector<Trajectory>& first, const std::vector<Trajectory>& second,
                const Whitener& whitener) {
  const auto square = [&whitener](const Trajectory& run, std::size_t n, std::size_t axis) {
    double e = 0.0;
    for (std::size_t k = 0; k <= whitener.order; ++k) {
      e += whitener.filter[axis][k] * static_cast<double>(run.moments[n - k].innovation_m[axis]);
    }
    return e * e;
  };
  double gain = 0.0;
  for (std::size_t r = 0; r < first.size() && r < second.size(); ++r) {
    const auto& moments = first[r].moments;
    for (std::size_t n = whitener.order; n < moments.size(); ++n) {
      if (!moments[n].held) continue;
      for (std::size_t a = 0; a < whitener.filter.size(); ++a) {
        gain += 0.5 * (square(first[r], n, a) - square(second[r], n, a));
      }
    }
  }
  return gain;
}

std::vector<Hypothesis> OfExactForm(const std::vector<Hypothesis>& causes) {
  std::vector<Hypothesis> exact;
  std::ranges::copy_if(causes, std::back_inserter(exact), [](const Hypothesis& cause) {
    return cause.effect == effect::Id::kMainsPickup;
  });
  return exact;
}

std::vector<Hypothesis> With(std::vector<Hypothesis> causes, const Hypothesis& cause) {
  causes.push_back(cause);
  return causes;
}

std::vector<Hypothesis> Without(const std::vector<Hypothesis>& causes, std::size_t at) {
  std::vector<Hypothesis> others = causes;
  if (at < others.size()) others.erase(others.begin() + static_cast<std::ptrdiff_t>(at));
  return others;
}

}  // namespace levitas::diagnosis
