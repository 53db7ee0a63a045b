#include "diagnosis/inference/search_state.hpp"

#include <algorithm>

#include "diagnosis/inference/calibrate.hpp"
#include "diagnosis/inference/ranking.hpp"

namespace levitas::diagnosis {
namespace {

/// Spans of records that are longer than `rows`; empty when they are not.
std::vector<Record> PartOf(const std::vector<Record>& records, std::size_t rows) {
  std::size_t total = 0;
  for (const Record& record : records) total += record.rows.size();
  return total > rows ? Spans(records, rows) : std::vector<Record>{};
}

}  // namespace

SearchState::SearchState(const RigView& of, const std::vector<Record>& recorded,
                         const std::vector<Record>& aside, const Settings& asked,
                         const Effort& spent, std::vector<Term>& all)
    : rig(of),
      all_records(recorded),
      validation(aside),
      terms(all),
      settings(asked),
      effort(spent),
      search(rig, terms, asked.only, asked.judging.model_error_share),
      part(PartOf(recorded, spent.rows)),
      records(part.empty() ? recorded : part),
      gains(search.DesignGains(records, kSpeeds[0])),
      refiner(search, terms, records, gains, rig.axes),
      theta(search.Usual()) {}

void SearchState::ReportProgress(double share, const std::string& what) const {
  if (!settings.progress) return;
  // Stage lengths depend on the data: progress never decreases, and 100 % is reported once.
  progress_ = std::max(progress_, std::min(share, share < 1.0 ? 0.98 : 1.0));
  settings.progress(progress_, what);
}

void SearchState::Observe(std::size_t with) {
  speed = with;
  gains = search.DesignGains(records, kSpeeds[with]);
}

void SearchState::LineariseAll() {
  for (Term& term : terms) term.family.linearised_as = term.family.shape;
  view = {};  // two of them do not fit into a gigabyte
  view = search.Linearise(records, gains, theta, kWhiteningOrder, search.Everything());
}

Refined SearchState::Refit(const std::vector<Hypothesis>& set, double worth) const {
  return refiner.Fit(set, search.Solve(view.problem, set), view, effort.passes, worth);
}

void SearchState::TakePlace(Hypothesis& member) {
  member.place = terms[member.terms.front()].location.name;
  search.Rename(member.terms, member.place);
}

double SearchState::GainOf(std::size_t cause) const {
  return Evidence(view.problem, terms, Without(causes, cause)).Gain(causes[cause]);
}

}  // namespace levitas::diagnosis
