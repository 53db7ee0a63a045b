#include "diagnosis/inference/inquiry.hpp"

#include <algorithm>

#include "diagnosis/inference/calibrate.hpp"
#include "diagnosis/inference/ranking.hpp"

namespace levitas::diagnosis {

Inquiry::Inquiry(const RigView& of, const std::vector<Record>& recorded, const Settings& asked,
                 const Effort& spent, std::vector<Term>& all)
    : rig(of),
      all_records(recorded),
      terms(all),
      settings(asked),
      effort(spent),
      search(rig, terms, asked.only),
      records(Spans(recorded, spent.rows)),
      gains(search.DesignGains(records, kSpeeds[0])),
      refiner(search, terms, records, gains, rig.axes),
      theta(search.Usual()) {}

void Inquiry::Tell(double share, const std::string& what) const {
  if (!settings.progress) return;
  // Stage lengths depend on the data: progress never decreases, and 100 % is reported once.
  told_ = std::max(told_, std::min(share, share < 1.0 ? 0.98 : 1.0));
  settings.progress(told_, what);
}

void Inquiry::Observe(std::size_t with) {
  speed = with;
  gains = search.DesignGains(records, kSpeeds[with]);
}

void Inquiry::LineariseAll() {
  for (Term& term : terms) term.family.linearised_as = term.family.shape;
  view = search.Linearise(records, gains, theta, kWhiteningOrder, search.Everything());
}

Refined Inquiry::Refit(const std::vector<Hypothesis>& set, double worth) const {
  return refiner.Fit(set, search.Solve(view.problem, set), view, effort.passes, worth);
}

void Inquiry::TakePlace(Hypothesis& member) {
  member.place = terms[member.terms.front()].place;
  search.Rename(member.terms, member.place);
}

double Inquiry::GainOf(std::size_t cause) const {
  return Evidence(view.problem, terms, Without(causes, cause)).Gain(causes[cause]);
}

}  // namespace levitas::diagnosis
