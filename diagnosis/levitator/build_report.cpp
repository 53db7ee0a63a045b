#include "diagnosis/levitator/build_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "diagnosis/inference/judging.hpp"
#include "diagnosis/inference/ranking.hpp"
#include "diagnosis/levitator/causes.hpp"
#include "diagnosis/levitator/plan.hpp"
#include "diagnosis/levitator/report_fits.hpp"
#include "diagnosis/levitator/report_values.hpp"
#include "diagnosis/levitator/words.hpp"
#include "diagnosis/report/affected_part.hpp"
#include "diagnosis/report/report_text.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::levitator {
namespace {

using diagnosis::Candidate;
using diagnosis::Hypothesis;

std::string NameOf(effect::Id id) { return std::string(effect::At(id).name); }

/// A candidate whose parameters include all of a named cause's is that cause with one more free
/// parameter, not a tie.
bool Contains(const Hypothesis& cause, const Hypothesis& named) {
  return std::all_of(named.terms.begin(), named.terms.end(),
                     [&](std::size_t i) { return diagnosis::Moves(cause, i); });
}

/// The cause itself among those in its place.
const Candidate* OwnOf(const Found& found, std::size_t k) {
  const auto& all = found.in_place[k];
  const auto own = std::find_if(all.begin(), all.end(), [&](const Candidate& c) {
    return c.effect == found.causes[k].effect;
  });
  return own == all.end() ? nullptr : &*own;
}

/// Effects that the data do not separate from the cause; a screen's word is not enough.
std::vector<effect::Id> TiesOf(const Found& found, std::size_t k) {
  std::vector<Candidate> fitted = found.in_place[k];
  const Hypothesis& cause = found.causes[k];
  std::erase_if(fitted, [&](const Candidate& c) {
    return c.effect != cause.effect && (!c.refitted || Contains(AllCauses()[c.hypothesis], cause));
  });
  // No set adapts to the validation data here: what foretells them a little worse is not refuted.
  for (Candidate& c : fitted) c.validation_nat.reset();
  std::vector<Hypothesis> causes = diagnosis::Without(found.causes, k);
  causes.insert(causes.begin(), cause);
  return diagnosis::Ties(fitted, causes, diagnosis::kDecisive, kFormOfTie);
}

/// An effect that is not named, in the place of the cause that it does most for.
struct InPlace {
  Candidate candidate;
  std::size_t of{};
  double behind_nat{};
};

std::vector<InPlace> Others(const Found& found) {
  std::vector<InPlace> others;
  for (std::size_t k = 0; k < found.in_place.size(); ++k) {
    const Candidate* own = found.causes.empty() ? nullptr : OwnOf(found, k);
    for (const Candidate& c : found.in_place[k]) {
      if (diagnosis::HasEffect(found.causes, c.effect)) continue;
      const InPlace here{c, k, (own == nullptr ? 0.0 : own->score) - c.score};
      const auto same = std::find_if(others.begin(), others.end(), [&](const InPlace& o) {
        return o.candidate.effect == c.effect;
      });
      if (same == others.end()) {
        others.push_back(here);
      } else if (std::pair(!c.refitted, here.behind_nat) <
                 std::pair(!same->candidate.refitted, same->behind_nat)) {
        *same = here;
      }
    }
  }
  std::stable_sort(others.begin(), others.end(), [](const InPlace& a, const InPlace& b) {
    return a.candidate.score > b.candidate.score;
  });
  return others;
}

std::string ReasonOf(const Found& found, const InPlace& other,
                     const std::vector<diagnosis::ReportTie>& ties) {
  if (found.causes.empty()) return {};
  const diagnosis::ReportTie& tie = ties[other.of];
  const std::string name = NameOf(other.candidate.effect);
  return std::find(tie.others.begin(), tie.others.end(), name) != tie.others.end()
             ? fmt::format("not separable from {}", tie.cause)
             : fmt::format("explains {:.0f} nat less than {} in its place", other.behind_nat,
                           tie.cause);
}

void AddCandidate(const Candidate& c, std::string reason, diagnosis::DiagnosisReport& report) {
  diagnosis::ReportCandidate& entry = report.candidates.emplace_back();
  entry.effect = NameOf(c.effect);
  entry.place = c.place;
  entry.evidence_nat = c.score;
  entry.refitted = c.refitted;
  entry.reason = std::move(reason);
  entry.validation_nat = c.validation_nat;
}

std::string PlaceOf(const Found& found, const diagnosis::DiagnosisReport& report) {
  if (!found.causes.empty()) return diagnosis::PlaceOfEffect(found.causes.front().effect);
  if (report.verdict == diagnosis::Verdict::kNone) return "";
  return diagnosis::PlaceOfResidual(report.residual.coherent_with);
}

}  // namespace

void ReportCauses(const Found& found, diagnosis::DiagnosisReport& report) {
  for (std::size_t k = 0; k < found.causes.size(); ++k) {
    const Hypothesis& cause = found.causes[k];
    report.causes.push_back({NameOf(cause.effect), cause.place});
    report.ties.push_back({NameOf(cause.effect), effect::NamesOf(TiesOf(found, k))});
    if (const Candidate* own = OwnOf(found, k)) AddCandidate(*own, "", report);
  }
  if (!report.ties.empty()) report.also_possible = report.ties.front().others;
  for (const InPlace& other : Others(found)) {
    AddCandidate(other.candidate, ReasonOf(found, other, report.ties), report);
  }
  report.evidence_nat = found.evidence;
}

diagnosis::DiagnosisReport BuildReport(const configuration::RigFile& rig, const NominalRig& nominal,
                                       const std::vector<Series>& data,
                                       const LevitatorResult& result) {
  diagnosis::DiagnosisReport report;
  report.rig_name = rig.numbers.name;
  report.own_words = OwnWords();
  report.rig_channels = rig.numbers.channels;
  ReportCauses(result.found, report);
  AddResidual(nominal, data, result.found, report);
  const std::string& channel = rig.numbers.channels.front();
  report.place = PlaceOf(result.found, report);
  if (report.verdict != diagnosis::Verdict::kNone) report.channels = {channel};
  report.parameters = ReportParameters(rig, nominal.origin, result.found);
  report.calibrated = ReportCalibration(rig, nominal.origin, result.found);
  for (const Series& series : data) {
    report.seconds_of_data += static_cast<double>(series.size()) * nominal.period_s;
  }
  report.seconds_used = report.seconds_of_data;
  const bool probes = data.front().has_currents();
  report.fitted = MeanFit(result.fitted, probes, channel);
  report.validation = MeanFit(result.validation, probes, channel);
  report.fitted_runs = ReportRuns(result.fitted);
  report.validation_runs = ReportRuns(result.validation);
  const std::vector<std::string> separations = Separations(report);
  report.needs_experiment = !separations.empty();
  report.next_experiment = report.needs_experiment ? fmt::format("{}", fmt::join(separations, "; "))
                                                   : diagnosis::kNoneNeeded;
  diagnosis::CompleteReport(report);
  report.extended_rig = ExtendedRig(rig, nominal.origin, result.found);
  report.calibrated_rig = CalibratedRig(rig, nominal.origin, result.found);
  return report;
}

}  // namespace levitas::levitator
