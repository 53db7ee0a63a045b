#include "common/problem.hpp"
#include "diagnosis/inference/alternatives.hpp"
#include "diagnosis/inference/calibrate.hpp"
#include "diagnosis/inference/events.hpp"
#include "diagnosis/inference/exchange.hpp"
#include "diagnosis/inference/fit_gain.hpp"
#include "diagnosis/inference/moved_calibration.hpp"
#include "diagnosis/inference/ranking.hpp"
#include "diagnosis/inference/selection.hpp"
#include "diagnosis/inference/suspicion.hpp"
#include "diagnosis/inference/validation.hpp"
#include "diagnosis/model/divergence.hpp"

namespace levitas::diagnosis {
namespace {

bool IsUnexplained(const Judging& judging, const Residual& remainder, bool named,
                   double explained) {
  if (!(remainder.sigma > judging.unexplained_sigma)) return false;
  const bool stands_out = remainder.sigma > judging.stands_out_sigma;
  return !named || explained < (stands_out ? judging.nearly_all_share : judging.explained_share);
}

constexpr Effort kQuick{5, 3, 3, 0, kQuickRows, true};
constexpr Effort kThorough{40, 6, 8, 5, kMostRows, false};

/// Fits the nuisance parameters only. Causes are searched afterwards: away from the optimum the
/// linearisation gives every hypothesis spurious evidence.
void Calibrate(SearchState& state) {
  state.ReportProgress(0.02, "calibrating");
  for (;; state.Observe(state.speed + 1)) {
    const Refined fit =
        CalibrateNuisances(state.rig, state.search, state.terms, state.all_records, state.records,
                           state.gains, kSpeeds[state.speed], state.effort.calibrations);
    const bool fastest = state.speed + 1 == kSpeeds.size();
    if (!fit.ok && fastest) {
      throw BadInput(
          "the model cannot be made to follow these records: is it this rig's file, and are the "
          "units and signs of currents and positions right?");
    }
    state.theta = state.calibrated = fit.theta;
    if (fastest || (fit.ok && !ModelDiverges(state.rig, state.search.Run(state.records, state.gains,
                                                                         state.theta))))
      return;
    state.ReportProgress(0.02, "calibrating with a faster observer");
  }
}

void Describe(const SearchState& state, const Fit& fit, SearchResult& answer) {
  for (std::size_t i = 0; i < state.terms.size(); ++i) {
    const Term& t = state.terms[i];
    const double deviation = fit.deviation[static_cast<Eigen::Index>(i)] * t.scale();
    const Estimate estimate{i, state.theta[i], deviation};
    if (Moves(state.causes, i)) {
      answer.parameters.push_back(estimate);
    } else if (t.nuisance()) {
      answer.calibration.push_back(estimate);
    }
  }
}

/// Causes that no term describes. They explain none of what the other causes do; the stronger one
/// leads.
void AddEvents(SearchState& state, const Residual& remainder) {
  const Judging& judging = state.settings.judging;
  for (const Candidate& event : FindEvents(state.rig, state.all_records, remainder)) {
    if (event.effect == "sensor_noise" && remainder.sigma > judging.unexplained_sigma) continue;
    state.candidates.push_back(event);
    if (event.score < judging.decisive_nat) continue;
    Hypothesis cause;
    cause.effect = event.effect;
    cause.place = event.place;
    cause.directions =
        Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(state.terms.size()), Eigen::Index{0});
    const bool leads = state.causes.empty() || event.score > state.candidates.front().score;
    state.causes.insert(leads ? state.causes.begin() : state.causes.end(), cause);
  }
  SortByScore(state.candidates);
}

/// A cause far ahead of all others, though it leaves a residual. Not of a chain that the search had
/// to cut off: as many causes as it may have imitate what is not in the vocabulary.
bool LeadsFar(const SearchState& state) {
  if (state.causes.size() >= state.settings.most_causes && state.settings.most_causes > 1)
    return false;
  const auto& all = state.candidates;
  if (state.causes.empty() || all.empty() || all.front().effect != state.causes.front().effect)
    return false;
  const double suspected = state.settings.judging.suspected_nat;
  const double next = all.size() > 1 ? all[1].score : 0.0;
  return all.front().refitted && all.front().score - std::max(0.0, next) > suspected;
}

Verdict VerdictOf(SearchState& state, bool unexplained) {
  if (unexplained) {
    if (!LeadsFar(state)) return Verdict::kUnknown;
    state.doubt = Doubt::kResidualIsLeft;
    state.probability = ProbabilityOfLeader(state.candidates, state.settings.judging.decisive_nat);
    return Verdict::kSuspected;
  }
  if (state.causes.empty()) return Verdict::kNone;
  return state.doubt == Doubt::kNothing ? Verdict::kEffect : Verdict::kSuspected;
}

/// Of all fitted numbers, before an unknown verdict forgets the causes that theta holds.
Eigen::MatrixXd SpreadOf(const SearchState& state) {
  Eigen::MatrixXd spread = Evidence(state.view.problem, state.terms, state.causes).Spread();
  for (std::size_t i = 0; i < state.terms.size(); ++i) {
    spread.row(static_cast<Eigen::Index>(i)) *= state.terms[i].scale();
  }
  return spread;
}

SearchResult Conclude(SearchState& state) {
  state.ReportProgress(0.9, "analysing the residual");
  const Judging& judging = state.settings.judging;
  SearchResult answer;
  answer.speed = kSpeeds[state.speed];
  auto runs = std::make_shared<const std::vector<Trajectory>>(
      state.search.Run(state.records, state.gains, state.theta));
  const double held = HeldGain(*state.calibrated_runs, *runs, state.view.whitener);
  if (!state.causes.empty() && state.doubt == Doubt::kNothing && held < -judging.harm_nat) {
    // What does harm where it was not fitted is no cause.
    state.causes.clear();
    state.theta = state.calibrated;
    runs = state.calibrated_runs;
  }
  answer.theta_extended = state.theta;
  answer.theta_calibrated = state.calibrated;
  answer.remainder = AnalyseResidual(state.rig, *runs);
  if (const std::string why = WhyNotJudged(state.rig, *runs); !why.empty()) throw BadInput(why);
  answer.explained =
      Explained(AnalyseResidual(state.rig, *state.calibrated_runs), answer.remainder);
  const bool unexplained =
      IsUnexplained(judging, answer.remainder, !state.causes.empty(), answer.explained);
  answer.spread = SpreadOf(state);
  const Verdict verdict = VerdictOf(state, unexplained);
  if (verdict == Verdict::kUnknown) state.causes.clear();
  const std::size_t found = state.causes.size();
  AddEvents(state, answer.remainder);
  const Fit fit = Evidence(state.view.problem, state.terms, state.causes).Solve();
  const Fit null = Evidence(state.view.problem, state.terms, {}).Solve();
  answer.evidence = fit.log_evidence - null.log_evidence;
  Describe(state, fit, answer);
  answer.also_possible =
      Ties(state.candidates, state.causes, judging.decisive_nat, judging.form_share);
  answer.causes = state.causes;
  answer.candidates = state.candidates;
  // An event is seen as such: it is named whatever else is doubted.
  answer.verdict = state.causes.size() > found ? Verdict::kEffect : verdict;
  if (answer.verdict == Verdict::kSuspected) {
    answer.doubt = state.doubt;
    answer.probability = state.probability;
  }
  state.ReportProgress(1.0, "done");
  return answer;
}

}  // namespace

SearchResult Diagnose(const RigView& rig, const std::vector<Record>& records,
                      const std::vector<Record>& validation, const Settings& settings,
                      std::vector<Term>& terms) {
  SearchState state(rig, records, validation, settings, settings.quick ? kQuick : kThorough, terms);
  Calibrate(state);
  FindCauses(state);
  if (state.effort.first_cause_only) {
    DropUnproven(state);
    RankCandidates(state);
  } else {
    MergeCauses(state);
    ExchangeCauses(state);
    do {
      DropUnproven(state);
      RankCandidates(state);
      RefitAlternatives(state);
    } while (LeaderFails(state));
  }
  DropUngained(state);
  NameMovedCalibration(state);
  JudgeOnValidation(state);
  SuspectCause(state);
  return Conclude(state);
}

}  // namespace levitas::diagnosis
