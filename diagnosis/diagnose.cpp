#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/problem.hpp"
#include "diagnosis/calibrate.hpp"
#include "diagnosis/events.hpp"
#include "diagnosis/ranking.hpp"
#include "diagnosis/refine.hpp"
#include "diagnosis/sharpen.hpp"

namespace levitas::diagnosis {
namespace {

/// [sigma] of the remainder. Shapes of modes that no single number describes leave 10 on healthy
/// rigs.
constexpr double kUnexplained = 15.0;
constexpr double kExplained = 0.7;  ///< of the excess: less, and the cause is not the cause
constexpr double kNear = 15.0;      ///< [nat] rivals that are refitted

constexpr double kFarBeyond = 3.0;

/// How thorough a search is.
struct Effort {
  int calibrations;       ///< passes with the slow observer
  std::size_t shortlist;  ///< candidates refitted for every cause
  int passes;             ///< of each
  std::size_t rivals;     ///< refitted in the end
  std::size_t rows;       ///< of all records
  bool first_cause_only;
};
constexpr Effort kQuick{5, 3, 3, 0, kQuickRows, true};
constexpr Effort kThorough{10, 6, 8, 5, kMostRows, false};

class Diagnoser {
 public:
  Diagnoser(const RigView& rig, const std::vector<Record>& records, const Settings& settings,
            std::vector<Term>& terms)
      : rig_(rig),
        all_records_(records),
        terms_(terms),
        settings_(settings),
        effort_(settings.quick ? kQuick : kThorough),
        search_(rig, terms, settings.only),
        theta_(search_.Usual()),
        records_(Spans(records, effort_.rows)),
        gains_(search_.DesignGains(records_, kSlow)),
        refiner_(search_, terms, records_, gains_, rig.axes) {}

  Answer Run() {
    Calibrate();
    FindCauses();
    if (effort_.first_cause_only) {
      DropUnproven();
      Rank();
      return Conclude();
    }
    Merge();
    do {
      DropUnproven();
      Rank();
      RefitRivals();
    } while (LeaderFails());
    return Conclude();
  }

 private:
  void Tell(double share, const std::string& what) const {
    if (settings_.progress) settings_.progress(share, what);
  }

  /// Nuisances only. A cause is looked for after that: far from the calibrated model the
  /// linearisation sees one in everything.
  void Calibrate() {
    Tell(0.02, "calibrating");
    const Refined fit = CalibrateNuisances(rig_, search_, terms_, all_records_, records_, gains_,
                                           effort_.calibrations);
    if (!fit.ok) {
      throw BadInput(
          "the model cannot be made to follow these records: is it this rig's file, and are the "
          "units and signs of currents and positions right?");
    }
    theta_ = fit.theta;
    calibrated_ = theta_;
  }

  void FindCauses() {
    for (std::size_t stage = 0;; ++stage) {
      const double share = 0.2 + 0.2 * static_cast<double>(stage);
      Tell(share, "screening all causes");
      LineariseAll();
      if (stage == 0) calibrated_runs_ = view_.runs;
      if (causes_.size() >= settings_.most_causes || !AddCause(share)) return;
      if (effort_.first_cause_only) return;
    }
  }

  /// The best few of the screen on the nonlinear model; the best of those becomes a cause.
  bool AddCause(double share) {
    const Evidence base(view_.problem, terms_, causes_);
    const std::vector<Candidate> screened = Screen(base, search_.hypotheses());
    if (screened.empty() || !(screened.front().score > kDecisive)) return false;
    const Refined before = refiner_.Fit(causes_, theta_, view_, 2);
    const double null =
        before.ok ? before.evidence : Refiner::SetEvidence(view_.problem, terms_, causes_);
    const double origin = Refiner::SetEvidence(view_.problem, terms_, {});
    const double enough = kDecisive + kForm * std::max(0.0, null - origin);
    if (!(screened.front().score > enough)) return false;
    const double from = std::min(screened.front().score - kNear, 0.3 * screened.front().score);
    Refined best;
    std::vector<Hypothesis> best_causes;
    refitted_.clear();
    for (std::size_t i = 0; i < std::min(screened.size(), effort_.shortlist); ++i) {
      if (i > 0 && screened[i].score < std::max(from, enough)) break;
      Tell(share + 0.02 * static_cast<double>(i), "refitting " + screened[i].effect);
      std::vector<Hypothesis> causes = causes_;
      causes.push_back(search_.hypotheses()[screened[i].hypothesis]);
      Refined fit = refiner_.Fit(causes, search_.Solve(view_.problem, causes), view_,
                                 effort_.passes, best.ok ? best.evidence : null + enough);
      refitted_.push_back(screened[i]);
      refitted_.back().refitted = true;
      refitted_.back().score =
          std::min(screened[i].score, fit.ok ? fit.evidence - null : screened[i].score);
      if (!fit.ok || (best.ok && fit.evidence <= best.evidence)) continue;
      best = std::move(fit);
      best_causes = std::move(causes);
    }
    // What the linear screen promised, the nonlinear model must keep. A large step may need more
    // passes than were spent on it: what is far beyond doubt is taken and linearised anew.
    if (!best.ok || !(best.evidence - null > enough)) {
      if (!(screened.front().score > kFarBeyond * enough)) return false;
      causes_.push_back(search_.hypotheses()[screened.front().hypothesis]);
      theta_ = search_.Solve(view_.problem, causes_);
      if (effort_.first_cause_only || !HasFamily(causes_.back(), terms_)) return true;
      Refined fit = refiner_.Fit(causes_, theta_, view_, effort_.passes);
      if (fit.ok) SharpenLast(fit);
      return true;
    }
    theta_ = best.theta;
    causes_ = std::move(best_causes);
    if (!effort_.first_cause_only) SharpenLast(best);
    DropSuperfluous(best.problem);
    return true;
  }

  /// `fit` of all causes becomes that with the best member of the last one's family.
  void SharpenLast(Refined& fit) {
    Hypothesis& last = causes_.back();
    if (!HasFamily(last, terms_)) return;
    Tell(0.5, "sharpening " + last.effect);
    fit = Sharpen(refiner_, last, causes_, view_, effort_.passes, std::move(fit), terms_);
    theta_ = fit.theta;
    last.place = terms_[last.terms.front()].place;
    search_.Rename(last.terms, last.place);
  }

  void LineariseAll() {
    for (Term& term : terms_) term.family.linearised_as = term.family.shape;
    view_ = search_.Linearise(records_, gains_, theta_, kWhiteningOrder, search_.Everything());
  }

  void DropSuperfluous(const LinearProblem& problem) {
    for (std::size_t i = 0; i + 1 < causes_.size();) {
      const std::vector<Hypothesis> rest = Without(causes_, i);
      if (Evidence(problem, terms_, rest).Gain(causes_[i]) < kDecisive) {
        causes_ = rest;
        theta_ = search_.Solve(problem, causes_);
      } else {
        ++i;
      }
    }
  }

  /// Of two causes that only together imitate one which the first choice passed by, that one is
  /// kept: any effect in place of two, as long as one does what two did.
  void Merge() {
    for (std::size_t tried = 0; causes_.size() > 1 && tried < settings_.most_causes; ++tried) {
      if (!MergeTwo(0.7)) return;
    }
  }

  bool MergeTwo(double share) {
    const Refined whole = refiner_.Fit(causes_, theta_, view_, 2);
    if (!whole.ok) return false;
    const double explained = whole.evidence - Refiner::SetEvidence(view_.problem, terms_, {});
    const double allowance = kDecisive + kForm * std::max(0.0, explained);
    Refined best;
    std::vector<Hypothesis> best_causes;
    for (std::size_t i = 0; i < causes_.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        const std::vector<Hypothesis> others = Without(Without(causes_, i), k);
        const auto screened = Screen(Evidence(view_.problem, terms_, others), search_.hypotheses());
        for (std::size_t n = 0; n < std::min(screened.size(), effort_.shortlist); ++n) {
          Tell(share, "refitting " + screened[n].effect);
          std::vector<Hypothesis> causes{search_.hypotheses()[screened[n].hypothesis]};
          causes.insert(causes.end(), others.begin(), others.end());
          Refined fit = refiner_.Fit(causes, search_.Solve(view_.problem, causes), view_,
                                     effort_.passes, whole.evidence - allowance);
          if (!fit.ok || (best.ok && fit.evidence <= best.evidence)) continue;
          best = std::move(fit);
          best_causes = std::move(causes);
        }
      }
    }
    if (!best.ok || best.evidence < whole.evidence - allowance) return false;
    theta_ = best.theta;
    causes_ = std::move(best_causes);
    LineariseAll();
    return true;
  }

  /// Nothing is named that is not decisive beside the others; the weakest goes first.
  void DropUnproven() {
    while (!causes_.empty()) {
      std::size_t weakest = 0;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < causes_.size(); ++i) {
        const double gain = Evidence(view_.problem, terms_, Without(causes_, i)).Gain(causes_[i]);
        if (gain >= least) continue;
        least = gain;
        weakest = i;
      }
      if (least >= kDecisive) return;
      Drop(weakest);
    }
  }

  void Drop(std::size_t cause) {
    causes_ = Without(causes_, cause);
    theta_ = causes_.empty() ? calibrated_ : search_.Solve(view_.problem, causes_);
  }

  /// What leads after all refits must still be decisive against the rest of the causes, refitted
  /// without it; else it goes, and the rest is ranked anew.
  bool LeaderFails() {
    if (causes_.empty()) return false;
    const std::vector<Hypothesis> rest = Without(causes_, 0);
    const Refined fit =
        refiner_.Fit(rest, rest.empty() ? calibrated_ : search_.Solve(view_.problem, rest), view_,
                     effort_.passes, leader_evidence_ - kDecisive);
    if (!fit.ok || leader_evidence_ - fit.evidence >= kDecisive) return false;
    causes_ = rest;
    theta_ = fit.theta;
    LineariseAll();
    return true;
  }

  /// The strongest cause leads; every effect is then tried in its place.
  void Rank() {
    Tell(0.75, "ranking");
    double strongest = -1.0;
    for (std::size_t i = 0; i < causes_.size(); ++i) {
      const double gain = Evidence(view_.problem, terms_, Without(causes_, i)).Gain(causes_[i]);
      if (gain <= strongest) continue;
      strongest = gain;
      std::swap(causes_[0], causes_[i]);
    }
    candidates_ =
        Screen(Evidence(view_.problem, terms_, Without(causes_, 0)), search_.hypotheses());
    if (causes_.empty() || effort_.first_cause_only) {
      // What the nonlinear model did not keep of the screen's promises.
      for (Candidate& c : candidates_) {
        for (const Candidate& known : refitted_) {
          if (known.effect == c.effect) c = known;
        }
      }
      SortByScore(candidates_);
      return;
    }
    // The leader is the hypothesis that was chosen, at the place that was chosen.
    for (Candidate& c : candidates_) {
      if (c.effect != causes_[0].effect) continue;
      for (std::size_t i = 0; i < search_.hypotheses().size(); ++i) {
        const Hypothesis& h = search_.hypotheses()[i];
        if (h.effect == c.effect && h.place == causes_[0].place) c.hypothesis = i;
      }
      c.place = causes_[0].place;
      c.score = Evidence(view_.problem, terms_, Without(causes_, 0)).Gain(causes_[0]);
    }
    SortByScore(candidates_);
  }

  /// Who comes near the first cause by extrapolation, on the nonlinear model.
  void RefitRivals() {
    if (causes_.empty()) return;
    const std::vector<Hypothesis> others = Without(causes_, 0);
    const Refined leader = refiner_.Fit(causes_, theta_, view_, 1);
    leader_evidence_ = leader.ok ? leader.evidence : std::numeric_limits<double>::infinity();
    if (!leader.ok) return;
    theta_ = leader.theta;
    const auto own = std::find_if(candidates_.begin(), candidates_.end(),
                                  [this](const auto& c) { return c.effect == causes_[0].effect; });
    if (own == candidates_.end()) return;
    const double lead = own->score;
    own->refitted = true;
    double best_evidence = leader.evidence;
    std::size_t tried = 0;
    for (Candidate& candidate : candidates_) {
      if (tried == effort_.rivals || candidate.score < std::max(kDecisive, lead - 2.0 * kNear))
        break;
      if (candidate.refitted) continue;
      ++tried;
      Tell(0.78 + 0.03 * static_cast<double>(tried), "refitting " + candidate.effect);
      std::vector<Hypothesis> causes{search_.hypotheses()[candidate.hypothesis]};
      causes.insert(causes.end(), others.begin(), others.end());
      const Refined fit = refiner_.Fit(causes, search_.Solve(view_.problem, causes), view_,
                                       effort_.passes, best_evidence - kDecisive);
      if (!fit.ok) continue;
      candidate.score = lead + fit.evidence - leader.evidence;
      candidate.refitted = true;
      if (fit.evidence <= best_evidence) continue;
      best_evidence = leader_evidence_ = fit.evidence;
      causes_[0] = causes[0];
      theta_ = fit.theta;
    }
    SortByScore(candidates_);
  }

  Answer Conclude() {
    Tell(0.9, "examining what is left");
    Answer answer;
    answer.runs = search_.Run(records_, gains_, theta_);
    if (!causes_.empty() && HeldGain(calibrated_runs_, answer.runs, view_.whitener) < -kDecisive) {
      // What does harm where it was not fitted is no cause.
      causes_.clear();
      theta_ = calibrated_;
      answer.runs = calibrated_runs_;
    }
    answer.theta_extended = theta_;
    answer.theta_calibrated = calibrated_;
    answer.remainder = Examine(rig_, answer.runs);
    if (answer.remainder.channels.empty() ||
        !(answer.remainder.channels.front().noise_rms_m > 0.0)) {
      throw BadInput("no stretch of 0.2 s is without gaps: nothing can be said of what remains");
    }
    answer.explained = Explained(Examine(rig_, calibrated_runs_), answer.remainder);
    const bool unexplained =
        answer.remainder.sigma > kUnexplained && (causes_.empty() || answer.explained < kExplained);
    if (unexplained) causes_.clear();
    AddEvents(answer.remainder);
    const Fit fit = Evidence(view_.problem, terms_, causes_).Solve();
    const Fit null = Evidence(view_.problem, terms_, {}).Solve();
    answer.evidence = fit.log_evidence - null.log_evidence;
    Describe(fit, answer);
    answer.also_possible = Ties(candidates_, causes_);
    answer.causes = causes_;
    answer.candidates = candidates_;
    answer.verdict = !causes_.empty() ? Verdict::kEffect
                     : unexplained    ? Verdict::kUnknown
                                      : Verdict::kNone;
    Tell(1.0, "done");
    return answer;
  }

  void Describe(const Fit& fit, Answer& answer) const {
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      const Term& t = terms_[i];
      const Estimate estimate{t.effect,    t.place,
                              t.parameter, t.unit,
                              theta_[i],   fit.deviation[static_cast<Eigen::Index>(i)] * t.scale()};
      const bool cause = std::any_of(causes_.begin(), causes_.end(), [i](const Hypothesis& h) {
        return std::find(h.terms.begin(), h.terms.end(), i) != h.terms.end();
      });
      if (cause) {
        answer.parameters.push_back(estimate);
      } else if (t.nuisance()) {
        answer.calibration.push_back(estimate);
      }
    }
  }

  /// Causes that no term describes. They explain none of what the other causes do; the stronger
  /// one leads.
  void AddEvents(const Remainder& remainder) {
    for (const Candidate& event : FindEvents(rig_, all_records_, remainder)) {
      if (event.effect == "sensor_noise" && remainder.sigma > kUnexplained) continue;
      candidates_.push_back(event);
      if (event.score < kDecisive) continue;
      Hypothesis cause;
      cause.effect = event.effect;
      cause.place = event.place;
      cause.directions =
          Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(terms_.size()), Eigen::Index{0});
      const bool leads = causes_.empty() || event.score > candidates_.front().score;
      causes_.insert(leads ? causes_.begin() : causes_.end(), cause);
    }
    SortByScore(candidates_);
  }

  const RigView& rig_;
  const std::vector<Record>& all_records_;
  std::vector<Term>& terms_;
  const Settings& settings_;
  Effort effort_;
  Search search_;
  std::vector<double> theta_, calibrated_;
  std::vector<Record> records_;
  Gains gains_;
  Refiner refiner_;
  View view_;
  std::vector<Trajectory> calibrated_runs_;
  std::vector<Hypothesis> causes_;
  std::vector<Candidate> candidates_, refitted_;  ///< all; those last refitted to be added
  double leader_evidence_{};                      ///< of all causes with the first one
};

}  // namespace

Answer Diagnose(const RigView& rig, const std::vector<Record>& records, const Settings& settings,
                std::vector<Term>& terms) {
  return Diagnoser(rig, records, settings, terms).Run();
}

}  // namespace levitas::diagnosis
