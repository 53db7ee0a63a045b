#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "common/problem.hpp"
#include "diagnosis/calibrate.hpp"
#include "diagnosis/events.hpp"
#include "diagnosis/refine.hpp"

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
};
constexpr Effort kQuick{6, 3, 4, 1};
constexpr Effort kThorough{10, 6, 3, 5};

class Diagnoser {
 public:
  Diagnoser(const RigView& rig, const std::vector<Record>& records, const std::vector<Term>& terms,
            const Settings& settings)
      : rig_(rig),
        all_records_(records),
        terms_(terms),
        settings_(settings),
        effort_(settings.quick ? kQuick : kThorough),
        search_(rig, terms),
        theta_(search_.Usual()),
        records_(settings.quick ? Spans(records, kQuickRows) : records),
        gains_(search_.DesignGains(records_, kSlow)),
        refiner_(search_, terms, records_, gains_, rig.axes) {}

  Answer Run() {
    Calibrate();
    FindCauses();
    Rank();
    RefitRivals();
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
      view_ = search_.Linearise(records_, gains_, theta_, kWhiteningOrder, search_.Everything());
      if (stage == 0) calibrated_runs_ = view_.runs;
      if (causes_.size() >= settings_.most_causes || !AddCause(share)) return;
    }
  }

  /// The best few of the screen on the nonlinear model; the best of those becomes a cause.
  bool AddCause(double share) {
    const Evidence base(view_.problem, terms_, causes_);
    const double null = Refiner::SetEvidence(view_.problem, terms_, causes_);
    const double origin = Refiner::SetEvidence(view_.problem, terms_, {});
    const double enough = kDecisive + kForm * std::max(0.0, null - origin);
    std::vector<Candidate> screened = Screen(base);
    if (screened.empty() || !(screened.front().score > enough)) return false;
    const double from = std::min(screened.front().score - kNear, 0.3 * screened.front().score);
    Refined best;
    std::vector<Hypothesis> best_causes;
    for (std::size_t i = 0; i < std::min(screened.size(), effort_.shortlist); ++i) {
      if (i > 0 && screened[i].score < std::max(from, enough)) break;
      Tell(share + 0.02 * static_cast<double>(i), "refitting " + screened[i].effect);
      std::vector<Hypothesis> causes = causes_;
      causes.push_back(search_.hypotheses()[screened[i].hypothesis]);
      Refined fit = refiner_.Fit(causes, search_.Solve(view_.problem, causes), view_.whitener,
                                 effort_.passes);
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
      return true;
    }
    theta_ = best.theta;
    causes_ = std::move(best_causes);
    DropSuperfluous(best.problem);
    return true;
  }

  void DropSuperfluous(const LinearProblem& problem) {
    for (std::size_t i = 0; i + 1 < causes_.size();) {
      std::vector<Hypothesis> rest = causes_;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
      if (Evidence(problem, terms_, rest).Gain(causes_[i]) < kDecisive) {
        causes_ = rest;
        theta_ = search_.Solve(problem, causes_);
      } else {
        ++i;
      }
    }
  }

  /// Every effect at its best place, best first.
  [[nodiscard]] std::vector<Candidate> Screen(const Evidence& base) const {
    std::map<std::string, Candidate> best;
    for (std::size_t i = 0; i < search_.hypotheses().size(); ++i) {
      const Hypothesis& h = search_.hypotheses()[i];
      const double gain = base.Gain(h);
      if (!std::isfinite(gain)) continue;
      auto [at, added] = best.try_emplace(h.effect, Candidate{h.effect, h.place, gain, i, false});
      if (!added && gain > at->second.score) at->second = {h.effect, h.place, gain, i, false};
    }
    std::vector<Candidate> sorted;
    sorted.reserve(best.size());
    for (const auto& [effect, candidate] : best) sorted.push_back(candidate);
    SortByScore(sorted);
    return sorted;
  }

  static void SortByScore(std::vector<Candidate>& candidates) {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  }

  /// The strongest cause leads; every effect is then tried in its place.
  void Rank() {
    Tell(0.75, "ranking");
    double strongest = -1.0;
    for (std::size_t i = 0; i < causes_.size(); ++i) {
      const double gain = Evidence(view_.problem, terms_, Others(i)).Gain(causes_[i]);
      if (gain <= strongest) continue;
      strongest = gain;
      std::swap(causes_[0], causes_[i]);
    }
    candidates_ = Screen(Evidence(view_.problem, terms_, Others(0)));
    if (causes_.empty()) return;
    // The leader is the hypothesis that was chosen, at the place that was chosen.
    for (Candidate& c : candidates_) {
      if (c.effect != causes_[0].effect) continue;
      for (std::size_t i = 0; i < search_.hypotheses().size(); ++i) {
        const Hypothesis& h = search_.hypotheses()[i];
        if (h.effect == c.effect && h.place == causes_[0].place) c.hypothesis = i;
      }
      c.place = causes_[0].place;
      c.score = Evidence(view_.problem, terms_, Others(0)).Gain(causes_[0]);
    }
    SortByScore(candidates_);
  }

  [[nodiscard]] std::vector<Hypothesis> Others(std::size_t without) const {
    std::vector<Hypothesis> others = causes_;
    if (without < others.size()) {
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(without));
    }
    return others;
  }

  /// Who comes near the first cause by extrapolation, on the nonlinear model.
  void RefitRivals() {
    if (causes_.empty()) return;
    const std::vector<Hypothesis> others = Others(0);
    const Refined leader = refiner_.Fit(causes_, theta_, view_.whitener, 1);
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
      const Refined fit = refiner_.Fit(causes, search_.Solve(view_.problem, causes), view_.whitener,
                                       effort_.passes);
      if (!fit.ok) continue;
      candidate.score = lead + fit.evidence - leader.evidence;
      candidate.refitted = true;
      if (fit.evidence <= best_evidence) continue;
      best_evidence = fit.evidence;
      causes_[0] = causes[0];
      theta_ = fit.theta;
    }
    SortByScore(candidates_);
  }

  Answer Conclude() {
    Tell(0.9, "examining what is left");
    Answer answer;
    answer.theta_extended = theta_;
    answer.theta_calibrated = calibrated_;
    answer.runs = search_.Run(records_, gains_, theta_);
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
    answer.also_possible = Ties();
    answer.causes = causes_;
    answer.candidates = candidates_;
    answer.verdict = !causes_.empty() ? Verdict::kEffect
                     : unexplained    ? Verdict::kUnknown
                                      : Verdict::kNone;
    Tell(1.0, "done");
    return answer;
  }

  /// What comes within kDecisive of the first cause, or before it.
  [[nodiscard]] std::vector<std::string> Ties() const {
    std::vector<std::string> ties;
    if (causes_.empty()) return ties;
    const auto own = std::find_if(candidates_.begin(), candidates_.end(), [this](const auto& c) {
      return c.effect == causes_.front().effect;
    });
    if (own == candidates_.end()) return ties;
    for (const Candidate& c : candidates_) {
      const bool also = std::any_of(causes_.begin(), causes_.end(),
                                    [&c](const Hypothesis& h) { return h.effect == c.effect; });
      if (!also && c.score > own->score - kDecisive) ties.push_back(c.effect);
    }
    return ties;
  }

  /// Share of the excess over the noise, all lines and channels, that the causes take away.
  static double Explained(const Remainder& before, const Remainder& after) {
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
  const std::vector<Term>& terms_;
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
  std::vector<Candidate> candidates_;
};

}  // namespace

Answer Diagnose(const RigView& rig, const std::vector<Record>& records,
                const std::vector<Term>& terms, const Settings& settings) {
  return Diagnoser(rig, records, terms, settings).Run();
}

}  // namespace levitas::diagnosis
