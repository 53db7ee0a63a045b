#include "diagnosis/inference/record_landscape.hpp"

#include <algorithm>
#include <utility>

#include "diagnosis/inference/calibrate.hpp"
#include "diagnosis/inference/loud_fault.hpp"
#include "diagnosis/inference/ranking.hpp"
#include "diagnosis/inference/record_file_fits.hpp"
#include "diagnosis/inference/refine_shape.hpp"
#include "diagnosis/model/divergence.hpp"

namespace levitas::diagnosis {
namespace {

/// Spans of records that are longer than the effort allows; empty when they are not.
std::vector<Record> PartOf(const std::vector<Record>& records, const Effort& effort,
                           double period_s) {
  std::size_t total = 0;
  for (const Record& record : records) total += record.rows.size();
  if (total <= effort.rows) return {};
  return effort.first_cause_only ? QuickSpans(records, period_s)
                                 : Spans(records, effort.rows, period_s);
}

}  // namespace

RecordLandscape::RecordLandscape(const RigView& rig, const std::vector<Record>& recorded,
                                 const Settings& settings, const Effort& effort,
                                 const std::vector<Term>& terms)
    : rig_(rig),
      terms_(terms),
      settings_(settings),
      passes_(effort.passes),
      search_(rig, terms, settings.only, settings.judging.model_error_share),
      part_(PartOf(recorded, effort, rig.period_s)),
      records_(part_.empty() ? recorded : part_),
      gains_(search_.DesignGains(records_, kSpeeds[0])),
      refiner_(search_, terms_, records_, gains_, rig.axes) {
  search_.StopWhen(settings.stop);
}

void RecordLandscape::Observe(std::size_t speed) {
  speed_ = speed;
  gains_ = search_.DesignGains(records_, kSpeeds[speed]);
}

void RecordLandscape::LineariseAt(const Point& point) { Linearise(point, kWhiteningOrder); }

void RecordLandscape::LineariseUnfiltered(const Point& point) { Linearise(point, 0); }

Runs RecordLandscape::RunsAt(const Point& point) const {
  return std::make_shared<const std::vector<Trajectory>>(RunAt(point));
}

bool RecordLandscape::ModelDivergesAt(const Point& point) const {
  return ModelDiverges(rig_, RunAt(point));
}

bool RecordLandscape::IsLoudAt(const Point& point) const { return IsLoud(RunAt(point), rig_.axes); }

Whitener RecordLandscape::PlainFilterOf(const std::vector<Trajectory>& runs) const {
  return search_.WhitenerOf(runs, 0);
}

std::unique_ptr<FileFits> RecordLandscape::FitsFromFile() const {
  return std::make_unique<RecordFileFits>(search_, terms_, records_);
}

double RecordLandscape::MisfitOf(const Causes& causes, const Point& point) const {
  return refiner_.Misfit(point, kWhiteningOrder, causes);
}

void RecordLandscape::Linearise(Point at, std::size_t whitening_order) {
  view_ = {};  // two of them do not fit into a gigabyte
  view_ = search_.Linearise(records_, gains_, at, whitening_order, search_.Everything());
}

double RecordLandscape::GainOf(const Hypothesis& cause, const Causes& given) const {
  return EvidenceGiven(given).Gain(cause);
}

double RecordLandscape::GainAt(const Refined& fit, const Hypothesis& cause,
                               const Causes& given) const {
  return Evidence(fit.problem, terms_, given).Gain(cause);
}

std::vector<Candidate> RecordLandscape::Screen(const Causes& given) const {
  std::vector<Candidate> screened = diagnosis::Screen(EvidenceGiven(given), search_.hypotheses());
  for (Candidate& candidate : screened) {
    candidate.place = PlaceAt(view_.point, search_.hypotheses()[candidate.hypothesis]);
  }
  return screened;
}

double RecordLandscape::EvidenceOf(const Causes& set) const {
  return Refiner::EvidenceOfSet(view_.problem, terms_, set);
}

Point RecordLandscape::SolutionOf(const Causes& set) const {
  return {search_.Solve(view_.problem, set), view_.point.shapes};
}

Point RecordLandscape::SolutionAt(const Refined& fit, const Causes& set) const {
  return {search_.Solve(fit.problem, set), fit.point.shapes};
}

Refined RecordLandscape::Fit(const Causes& set, const Point& start, int passes,
                             double worth) const {
  return refiner_.Fit(set, start, view_, passes, worth);
}

Refined RecordLandscape::Refit(const Causes& set, double worth) const {
  return Fit(set, SolutionOf(set), passes_, worth);
}

Refined RecordLandscape::RefineShapeOf(const Causes& set, std::size_t at, Refined fit,
                                       double worth) const {
  if (!HasShape(set[at])) return fit;
  const RefinerMemberFits fits(refiner_, set, view_, passes_);
  return RefineShape(fits, set[at], std::move(fit), terms_, worth);
}

bool RecordLandscape::HasShape(const Hypothesis& cause) const { return HasFamily(cause, terms_); }

std::string RecordLandscape::PlaceAt(const Point& point, const Hypothesis& cause) const {
  return HasShape(cause) ? TermAt(terms_, point, cause.terms.front()).location.name : cause.place;
}

std::vector<ModeProbe> RecordLandscape::Probes() const {
  return ProbeModes(rig_, terms_, search_.hypotheses(), *view_.runs);
}

void RecordLandscape::ReportProgress(double share, const std::string& what) const {
  if (!settings_.progress) return;
  // Stage lengths depend on the data: progress never decreases, and 100 % is reported once.
  progress_ = std::max(progress_, std::min(share, share < 1.0 ? 0.98 : 1.0));
  settings_.progress(progress_, what);
}

}  // namespace levitas::diagnosis
