#include "diagnosis/inference/rivals.hpp"

#include <algorithm>
#include <utility>

#include "diagnosis/inference/ranking.hpp"

namespace levitas::diagnosis {

void RankCandidates(Inquiry& q) {
  q.Tell(0.75, "ranking");
  double strongest = -1.0;
  for (std::size_t i = 0; i < q.causes.size(); ++i) {
    const double gain = q.GainOf(i);
    if (gain <= strongest) continue;
    strongest = gain;
    std::swap(q.causes[0], q.causes[i]);
  }
  const Evidence others(q.view.problem, q.terms, Without(q.causes, 0));
  q.candidates = Screen(others, q.search.hypotheses());
  if (q.causes.empty() || q.effort.first_cause_only) {
    // Evidence predicted by the screen that the nonlinear model did not confirm.
    for (Candidate& c : q.candidates) {
      for (const Candidate& known : q.refitted) {
        if (known.effect == c.effect) c = known;
      }
    }
    SortByScore(q.candidates);
    return;
  }
  // The leader is the hypothesis that was chosen, at the place that was chosen.
  const Hypothesis& first = q.causes[0];
  for (Candidate& c : q.candidates) {
    if (c.effect != first.effect) continue;
    for (std::size_t i = 0; i < q.search.hypotheses().size(); ++i) {
      const Hypothesis& h = q.search.hypotheses()[i];
      if (h.effect == c.effect && h.place == first.place) c.hypothesis = i;
    }
    c.place = first.place;
    c.score = others.Gain(first);
  }
  SortByScore(q.candidates);
}

void RefitRivals(Inquiry& q) {
  if (q.causes.empty()) return;
  const Refined leader = q.refiner.Fit(q.causes, q.theta, q.view, 1);
  q.leader_evidence = leader.ok ? leader.evidence : std::numeric_limits<double>::infinity();
  if (!leader.ok) return;
  q.theta = leader.theta;
  const auto own = std::find_if(q.candidates.begin(), q.candidates.end(),
                                [&q](const auto& c) { return c.effect == q.causes[0].effect; });
  if (own == q.candidates.end()) return;
  const double lead = own->score;
  own->refitted = true;
  CauseSet best{q.causes, leader};
  std::size_t tried = 0;
  for (Candidate& candidate : q.candidates) {
    if (tried == q.effort.rivals || candidate.score < std::max(kDecisive, lead - 2.0 * kNear))
      break;
    if (candidate.refitted) continue;
    ++tried;
    q.Tell(0.78 + 0.03 * static_cast<double>(tried), "refitting " + candidate.effect);
    std::vector<Hypothesis> causes = q.causes;
    causes[0] = q.search.hypotheses()[candidate.hypothesis];
    Refined fit = q.Refit(causes, best.fit.evidence - kDecisive);
    if (!fit.ok) continue;
    candidate.score = lead + fit.evidence - leader.evidence;
    candidate.refitted = true;
    best.Take(causes, std::move(fit));
  }
  q.causes = std::move(best.causes);
  q.theta = best.fit.theta;
  q.leader_evidence = best.fit.evidence;
  SortByScore(q.candidates);
}

bool LeaderFails(Inquiry& q) {
  if (q.causes.empty()) return false;
  const std::vector<Hypothesis> rest = Without(q.causes, 0);
  const Refined fit =
      q.refiner.Fit(rest, rest.empty() ? q.calibrated : q.search.Solve(q.view.problem, rest),
                    q.view, q.effort.passes, q.leader_evidence - kDecisive);
  if (!fit.ok || q.leader_evidence - fit.evidence >= kDecisive) return false;
  q.causes = rest;
  q.theta = fit.theta;
  q.LineariseAll();
  return true;
}

}  // namespace levitas::diagnosis
