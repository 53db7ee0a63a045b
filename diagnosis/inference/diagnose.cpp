#include <algorithm>

#include "common/problem.hpp"
#include "diagnosis/inference/calibrate.hpp"
#include "diagnosis/inference/events.hpp"
#include "diagnosis/inference/exchange.hpp"
#include "diagnosis/inference/ranking.hpp"
#include "diagnosis/inference/rivals.hpp"
#include "diagnosis/inference/selection.hpp"
#include "diagnosis/model/stray.hpp"

namespace levitas::diagnosis {
namespace {

/// Residual threshold [sigma]. Mode-shape errors outside the parametrisation leave about 10 on
/// healthy rigs.
constexpr double kUnexplained = 15.0;
constexpr double kExplained = 0.7;  ///< least share of the excess residual power
/// [sigma] An inexact force law does not leave a line that stands out so far, unless that law
/// explains nearly all of the excess.
constexpr double kStandsOut = 30.0;
constexpr double kNearlyAll = 0.95;
/// [nat] Allowed loss on the validation data. They are a sixth of the records; the gain of a cause
/// of some tens of nats scatters by a few nats there.
constexpr double kHarm = 2.0 * kDecisive;

bool IsUnexplained(const Remainder& remainder, bool named, double explained) {
  if (!(remainder.sigma > kUnexplained)) return false;
  return !named || explained < (remainder.sigma > kStandsOut ? kNearlyAll : kExplained);
}

constexpr Effort kQuick{5, 3, 3, 0, kQuickRows, true};
constexpr Effort kThorough{10, 6, 8, 5, kMostRows, false};

/// Fits the nuisance parameters only. Causes are searched afterwards: away from the optimum the
/// linearisation gives every hypothesis spurious evidence.
void Calibrate(Inquiry& q) {
  q.Tell(0.02, "calibrating");
  for (;; q.Observe(q.speed + 1)) {
    const Refined fit = CalibrateNuisances(q.rig, q.search, q.terms, q.all_records, q.records,
                                           q.gains, kSpeeds[q.speed], q.effort.calibrations);
    const bool fastest = q.speed + 1 == kSpeeds.size();
    if (!fit.ok && fastest) {
      throw BadInput(
          "the model cannot be made to follow these records: is it this rig's file, and are the "
          "units and signs of currents and positions right?");
    }
    q.theta = q.calibrated = fit.theta;
    if (fastest || (fit.ok && !Strays(q.rig, q.search.Run(q.records, q.gains, q.theta)))) return;
    q.Tell(0.02, "calibrating with a faster observer");
  }
}

void Describe(const Inquiry& q, const Fit& fit, Answer& answer) {
  for (std::size_t i = 0; i < q.terms.size(); ++i) {
    const Term& t = q.terms[i];
    const double deviation = fit.deviation[static_cast<Eigen::Index>(i)] * t.scale();
    const Estimate estimate{t.effect, t.place, t.parameter, t.unit, q.theta[i], deviation};
    const bool cause = std::any_of(q.causes.begin(), q.causes.end(), [i](const Hypothesis& h) {
      return std::find(h.terms.begin(), h.terms.end(), i) != h.terms.end();
    });
    if (cause) {
      answer.parameters.push_back(estimate);
    } else if (t.nuisance()) {
      answer.calibration.push_back(estimate);
    }
  }
}

/// Causes that no term describes. They explain none of what the other causes do; the stronger one
/// leads.
void AddEvents(Inquiry& q, const Remainder& remainder) {
  for (const Candidate& event : FindEvents(q.rig, q.all_records, remainder)) {
    if (event.effect == "sensor_noise" && remainder.sigma > kUnexplained) continue;
    q.candidates.push_back(event);
    if (event.score < kDecisive) continue;
    Hypothesis cause;
    cause.effect = event.effect;
    cause.place = event.place;
    cause.directions =
        Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(q.terms.size()), Eigen::Index{0});
    const bool leads = q.causes.empty() || event.score > q.candidates.front().score;
    q.causes.insert(leads ? q.causes.begin() : q.causes.end(), cause);
  }
  SortByScore(q.candidates);
}

Answer Conclude(Inquiry& q) {
  q.Tell(0.9, "analysing the residual");
  Answer answer;
  answer.speed = kSpeeds[q.speed];
  answer.runs = q.search.Run(q.records, q.gains, q.theta);
  const double held = HeldGain(q.calibrated_runs, answer.runs, q.view.whitener);
  if (!q.causes.empty() && held < -kHarm) {
    // What does harm where it was not fitted is no cause.
    q.causes.clear();
    q.theta = q.calibrated;
    answer.runs = q.calibrated_runs;
  }
  answer.theta_extended = q.theta;
  answer.theta_calibrated = q.calibrated;
  answer.remainder = Examine(q.rig, answer.runs);
  if (answer.remainder.channels.empty() || !(answer.remainder.channels.front().noise_rms_m > 0.0)) {
    throw BadInput("no stretch of 0.2 s is without gaps: nothing can be said of what remains");
  }
  answer.explained = Explained(Examine(q.rig, q.calibrated_runs), answer.remainder);
  const bool unexplained = IsUnexplained(answer.remainder, !q.causes.empty(), answer.explained);
  if (unexplained) q.causes.clear();
  AddEvents(q, answer.remainder);
  const Fit fit = Evidence(q.view.problem, q.terms, q.causes).Solve();
  const Fit null = Evidence(q.view.problem, q.terms, {}).Solve();
  answer.evidence = fit.log_evidence - null.log_evidence;
  Describe(q, fit, answer);
  answer.also_possible = Ties(q.candidates, q.causes);
  answer.causes = q.causes;
  answer.candidates = q.candidates;
  answer.verdict = !q.causes.empty() ? Verdict::kEffect
                   : unexplained     ? Verdict::kUnknown
                                     : Verdict::kNone;
  q.Tell(1.0, "done");
  return answer;
}

}  // namespace

Answer Diagnose(const RigView& rig, const std::vector<Record>& records, const Settings& settings,
                std::vector<Term>& terms) {
  Inquiry inquiry(rig, records, settings, settings.quick ? kQuick : kThorough, terms);
  Calibrate(inquiry);
  FindCauses(inquiry);
  if (inquiry.effort.first_cause_only) {
    DropUnproven(inquiry);
    RankCandidates(inquiry);
    return Conclude(inquiry);
  }
  MergeCauses(inquiry);
  ExchangeCauses(inquiry);
  do {
    DropUnproven(inquiry);
    RankCandidates(inquiry);
    RefitRivals(inquiry);
  } while (LeaderFails(inquiry));
  return Conclude(inquiry);
}

}  // namespace levitas::diagnosis
