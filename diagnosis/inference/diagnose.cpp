#include "common/problem.hpp"
#include "diagnosis/inference/alternatives.hpp"
#include "diagnosis/inference/calibrate.hpp"
#include "diagnosis/inference/events.hpp"
#include "diagnosis/inference/exchange.hpp"
#include "diagnosis/inference/find_causes.hpp"
#include "diagnosis/inference/fit_gain.hpp"
#include "diagnosis/inference/grade.hpp"
#include "diagnosis/inference/moved_calibration.hpp"
#include "diagnosis/inference/ranking.hpp"
#include "diagnosis/inference/selection_steps.hpp"
#include "diagnosis/inference/suspicion.hpp"
#include "diagnosis/inference/validation.hpp"
#include "diagnosis/model/divergence.hpp"

namespace levitas::diagnosis {
namespace {

constexpr Effort kQuick{5, 3, 3, 2, kQuickRows, true};
constexpr Effort kThorough{40, 6, 8, 5, kMostRows, false};

/// Fits the nuisance parameters only. Causes are searched afterwards: away from the optimum the
/// linearisation gives every hypothesis spurious evidence.
void Calibrate(RecordLandscape& landscape, const std::vector<Record>& all_records, int passes,
               CauseSelection& found) {
  landscape.ReportProgress(0.02, "calibrating");
  for (;; landscape.Observe(landscape.speed() + 1)) {
    const Refined fit = CalibrateNuisances(landscape.rig(), landscape.search(), landscape.terms(),
                                           all_records, landscape.records(), landscape.gains(),
                                           kSpeeds[landscape.speed()], passes);
    const bool fastest = landscape.speed() + 1 == kSpeeds.size();
    if (!fit.ok && fastest) {
      throw BadInput(
          "the model cannot be made to follow these records: is it this rig's file, and are the "
          "units and signs of currents and positions right?");
    }
    found.point = found.calibrated = fit.point;
    if (fastest || (fit.ok && !landscape.ModelDivergesAt(found.point))) return;
    landscape.ReportProgress(0.02, "calibrating with a faster observer");
  }
}

void Describe(const std::vector<Term>& terms, const CauseSelection& found, const Fit& fit,
              SearchResult& answer) {
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Term& t = terms[i];
    const double deviation = fit.deviation[static_cast<Eigen::Index>(i)] * t.scale();
    const Estimate estimate{i, found.point.theta[i], deviation};
    if (Moves(found.causes, i)) {
      answer.parameters.push_back(estimate);
    } else if (t.nuisance()) {
      answer.calibration.push_back(estimate);
    }
  }
}

/// Causes that no term describes. They explain none of what the other causes do; the stronger one
/// leads.
void AddEvents(const RecordLandscape& landscape, const std::vector<Record>& all_records,
               const Judging& judging, const Residual& residual, CauseSelection& found) {
  for (const Candidate& event : FindEvents(landscape.rig(), all_records, residual)) {
    if (event.effect == effect::Id::kSensorNoise && residual.sigma > judging.unexplained_sigma)
      continue;
    found.candidates.push_back(event);
    if (event.score < judging.decisive_nat) continue;
    Hypothesis cause;
    cause.effect = event.effect;
    cause.place = event.place;
    cause.directions =
        Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(landscape.terms().size()), Eigen::Index{0});
    const bool leads = found.causes.empty() || event.score > found.candidates.front().score;
    found.causes.insert(leads ? found.causes.begin() : found.causes.end(), cause);
  }
  SortByScore(found.candidates);
}

/// Of all fitted numbers, before an unknown verdict forgets the causes that the point holds.
Eigen::MatrixXd SpreadOf(const RecordLandscape& landscape, const std::vector<Hypothesis>& causes) {
  Eigen::MatrixXd spread = landscape.EvidenceGiven(causes).Spread();
  for (std::size_t i = 0; i < landscape.terms().size(); ++i) {
    spread.row(static_cast<Eigen::Index>(i)) *= landscape.terms()[i].scale();
  }
  return spread;
}

void RefuseLostSensitivities(const RecordLandscape& landscape) {
  if (SensitivitiesAreLost(landscape.view().sum)) {
    throw BadInput(
        "what the rig's numbers do to these records grows without end under every observer, so "
        "that nothing can be judged: are the speed's unit, and the modes of the rig file with "
        "their damping, those of the rig? (amb modes)");
  }
}

/// The model's runs with the causes. Causes that lower the likelihood of the validation data are
/// dropped.
std::shared_ptr<const std::vector<Trajectory>> RunsWithProvenCauses(
    const RecordLandscape& landscape, const Judging& judging, CauseSelection& found) {
  auto runs = std::make_shared<const std::vector<Trajectory>>(landscape.RunAt(found.point));
  const double held = HeldGain(*found.calibrated_runs, *runs, landscape.view().whitener);
  if (!found.causes.empty() && found.doubt == Doubt::kNothing && held < -judging.harm_nat) {
    found.causes.clear();
    found.point = found.WithoutCauses();
    runs = found.calibrated_runs;
  }
  return runs;
}

SearchResult Conclude(const RecordLandscape& landscape, const std::vector<Record>& all_records,
                      const SelectionRules& rules, CauseSelection& found) {
  landscape.ReportProgress(0.9, "analysing the residual");
  RefuseLostSensitivities(landscape);
  const Judging& judging = rules.judging;
  SearchResult answer;
  answer.speed = kSpeeds[landscape.speed()];
  const auto runs = RunsWithProvenCauses(landscape, judging, found);
  answer.extended = found.point;
  answer.calibrated = found.calibrated;
  answer.residual = AnalyseResidual(landscape.rig(), *runs);
  if (const std::string why = WhyNotJudged(landscape.rig(), *runs); !why.empty())
    throw BadInput(why);
  answer.stopped = found.stopped;
  answer.explained =
      Explained(AnalyseResidual(landscape.rig(), *found.calibrated_runs), answer.residual);
  answer.spread = SpreadOf(landscape, found.causes);
  const Verdict verdict = GradeOf(rules, {answer.residual.sigma, answer.explained}, found);
  if (verdict == Verdict::kUnknown) found.causes.clear();
  const std::size_t named = found.causes.size();
  AddEvents(landscape, all_records, judging, answer.residual, found);
  const Fit fit = landscape.EvidenceGiven(found.causes).Solve();
  const Fit null = landscape.EvidenceGiven({}).Solve();
  answer.evidence = fit.log_evidence - null.log_evidence;
  Describe(landscape.terms(), found, fit, answer);
  answer.also_possible =
      Ties(found.candidates, found.causes, judging.decisive_nat, judging.form_share);
  answer.causes = found.causes;
  for (Hypothesis& cause : answer.causes) cause.place = landscape.PlaceAt(found.point, cause);
  answer.candidates = found.candidates;
  // An event is seen as such: it is named whatever else is doubted.
  answer.verdict = found.causes.size() > named ? Verdict::kEffect : verdict;
  if (answer.verdict == Verdict::kSuspected) {
    answer.doubt = found.doubt;
    answer.probability = found.probability;
  }
  landscape.ReportProgress(1.0, "done");
  return answer;
}

}  // namespace

SearchResult Diagnose(const RigView& rig, const std::vector<Record>& records,
                      const std::vector<Record>& validation, const Settings& settings,
                      const std::vector<Term>& terms) {
  const Effort effort = settings.quick ? kQuick : kThorough;
  const SelectionRules rules{settings.judging, effort, settings.most_causes};
  RecordLandscape landscape(rig, records, settings, effort, terms);
  CauseSelection found;
  found.point = landscape.search().HealthyPoint();
  Calibrate(landscape, records, effort.calibrations, found);
  FindCauses(landscape, rules, found);
  if (effort.first_cause_only || landscape.StopAsked()) {
    DropUnproven(landscape, rules, found);
    RankCandidates(landscape, rules, found);
    if (found.whitened_anew) RefitAlternatives(landscape, rules, found);
  } else {
    MergeCauses(landscape, rules, found);
    ExchangeCauses(landscape, rules, found);
    do {
      DropUnproven(landscape, rules, found);
      RankCandidates(landscape, rules, found);
      RefitAlternatives(landscape, rules, found);
    } while (!landscape.StopAsked() && DropFailedLeader(landscape, rules, found));
  }
  DropUngained(landscape, rules.judging, found);
  found.stopped = landscape.StopAsked();
  if (!found.stopped) {
    NameMovedCalibration(landscape, rules, found);
    JudgeOnValidation(landscape, validation, rules.judging, found);
    DoubtCutOffChain(landscape, rules, found);
    SuspectCause(landscape, rules.judging, found);
  }
  return Conclude(landscape, records, rules, found);
}

}  // namespace levitas::diagnosis
