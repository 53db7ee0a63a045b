#include <algorithm>
#include <cmath>
#include <map>

#include "diagnosis/events.hpp"
#include "diagnosis/search.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kWhiteningOrder = 4;
constexpr std::size_t kFastRows = 6'000;   ///< per record
constexpr std::size_t kSlowRows = 16'000;  ///< per record; 0.3 s of them settle
constexpr double kUnexplained = 7.0;       ///< [sigma] of the remainder
constexpr double kConverged = 1.0;         ///< [nat]

class Diagnoser {
 public:
  Diagnoser(const RigView& rig, const std::vector<Record>& records, const std::vector<Term>& terms,
            const Settings& settings)
      : rig_(rig),
        records_(records),
        terms_(terms),
        settings_(settings),
        search_(rig, terms, settings),
        theta_(terms.size(), 0.0) {}

  Answer Run() {
    Calibrate(Tails(records_, kFastRows), kFast, 2, 0.02);
    Calibrate(Tails(records_, kSlowRows), kSlow, 3, 0.1);
    if (settings_.quick) {
      Fine(Tails(records_, kSlowRows), 1, 0.3, 0.3);
    } else {
      Fine(records_, 3, 0.3, 0.3);
    }
    Rank();
    if (!settings_.quick) RefitRivals();
    return Conclude();
  }

 private:
  void Tell(double share, const std::string& what) const {
    if (settings_.progress) settings_.progress(share, what);
  }

  /// Nuisances only. A cause is looked for after that: far from the calibrated model the
  /// linearisation sees one in everything.
  void Calibrate(const std::vector<Record>& records, const ObserverSpeed& speed, int passes,
                 double from) {
    const Gains gains = search_.DesignGains(records, speed);
    for (int pass = 0; pass < passes; ++pass) {
      Tell(from + 0.05 * pass, "calibrating");
      const View view = search_.Linearise(records, gains, theta_, 0, search_.Nuisances());
      theta_ = search_.Solve(view.problem, {});
    }
  }

  /// Everything, causes included as they show themselves.
  void Fine(const std::vector<Record>& records, int most, double from, double span) {
    const Gains gains = search_.DesignGains(records, kSlow);
    for (int pass = 0; pass < most; ++pass) {
      Tell(from + span * pass / most, "screening all causes");
      view_ = search_.Linearise(records, gains, theta_, kWhiteningOrder, search_.Everything());
      causes_ = search_.Select(view_.problem);
      const std::vector<double> next = search_.Solve(view_.problem, causes_);
      const Fit fit = Evidence(view_.problem, terms_, causes_).Solve();
      const double now = Cost(theta_);
      const bool converged = pass > 0 && now - 0.5 * (fit.squared_sum + fit.penalty) < kConverged;
      theta_ = next;
      if (converged) break;
    }
    gains_ = gains;
  }

  /// 1/2 (squared sum + penalty) at theta, by the latest linearisation, which is exact where it was
  /// made.
  [[nodiscard]] double Cost(const std::vector<double>& theta) const {
    Eigen::VectorXd scaled(static_cast<Eigen::Index>(theta.size()));
    double penalty = 0.0;
    for (std::size_t i = 0; i < theta.size(); ++i) {
      const Term& term = terms_[i];
      scaled[static_cast<Eigen::Index>(i)] = theta[i] / term.scale();
      const bool cause = std::any_of(causes_.begin(), causes_.end(), [i](const Hypothesis& h) {
        return std::find(h.terms.begin(), h.terms.end(), i) != h.terms.end();
      });
      if (!term.nuisance() && !cause) continue;
      const double spread = cause ? term.scale() : term.tolerance;
      penalty += theta[i] * theta[i] / (spread * spread);
    }
    const LinearProblem& p = view_.problem;
    return 0.5 * (p.ete + 2.0 * scaled.dot(p.jte) + scaled.dot(p.jtj * scaled) + penalty);
  }

  /// Every effect at its best place, in place of the first cause.
  void Rank() {
    Tell(0.62, "ranking");
    std::vector<Hypothesis> others = causes_;
    if (!others.empty()) others.erase(others.begin());
    const Evidence base(view_.problem, terms_, others);
    std::map<std::string, Candidate> best;
    for (std::size_t i = 0; i < search_.hypotheses().size(); ++i) {
      const Hypothesis& h = search_.hypotheses()[i];
      const double gain = base.Gain(h);
      auto [at, added] = best.try_emplace(h.effect, Candidate{h.effect, h.place, gain, i, false});
      if (!added && gain > at->second.score) at->second = {h.effect, h.place, gain, i, false};
    }
    candidates_.clear();
    for (const auto& [effect, candidate] : best) candidates_.push_back(candidate);
    Sort();
  }

  void Sort() {
    std::sort(candidates_.begin(), candidates_.end(),
              [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  }

  /// Absolute log evidence of a set of causes, by Gauss-Newton of its own.
  double OwnEvidence(const std::vector<Hypothesis>& causes, std::vector<double>& theta) const {
    theta = search_.Solve(view_.problem, causes);
    double evidence = 0.0;
    for (int pass = 0; pass < 2; ++pass) {
      View own;
      own.runs = search_.Run(*own_records_, gains_, theta);
      own.whitener = view_.whitener;
      own.problem =
          search_.Linearise(own.runs, theta, view_.whitener, search_.NuisancesAnd(causes));
      theta = search_.Solve(own.problem, causes);
      evidence = Evidence(own.problem, terms_, causes).Solve().log_evidence;
    }
    return evidence;
  }

  /// The best few again on the nonlinear model: the screen extrapolates for everybody but the
  /// winner.
  void RefitRivals() {
    if (causes_.empty() || candidates_.empty()) return;
    own_records_ = &records_;
    const double lead = candidates_.front().score;
    std::vector<Hypothesis> others = causes_;
    others.erase(others.begin());
    constexpr double kNear = 15.0;
    constexpr std::size_t kMost = 3;
    std::vector<double> best_theta;
    double best_evidence = -1e300;
    double first_evidence = 0.0;
    for (std::size_t i = 0; i < candidates_.size() && i < kMost; ++i) {
      Candidate& candidate = candidates_[i];
      if (candidate.score < lead - kNear || (i > 0 && candidate.score < kDecisive)) break;
      if (i == 0 && (candidates_.size() < 2 || candidates_[1].score < lead - kNear)) break;
      Tell(0.65 + 0.1 * static_cast<double>(i), "refitting " + candidate.effect);
      const Hypothesis& h = search_.hypotheses()[candidate.hypothesis];
      std::vector<Hypothesis> causes{h};
      causes.insert(causes.end(), others.begin(), others.end());
      std::vector<double> theta;
      const double evidence = OwnEvidence(causes, theta) + h.log_prior;
      if (i == 0) first_evidence = evidence;
      candidate.score = lead + evidence - first_evidence;
      candidate.refitted = true;
      if (evidence > best_evidence) {
        best_evidence = evidence;
        best_theta = theta;
        causes_.front() = h;
      }
    }
    if (!best_theta.empty()) theta_ = best_theta;
    Sort();
  }

  Answer Conclude() {
    Tell(0.9, "examining what is left");
    Answer answer;
    answer.theta_extended = theta_;
    const auto& records = settings_.quick ? Tails(records_, kSlowRows) : records_;
    answer.runs = search_.Run(records, gains_, theta_);
    answer.remainder = Examine(rig_, answer.runs);
    AddEvents(records, answer.remainder);
    answer.theta_calibrated = search_.Solve(view_.problem, {});
    const Fit fit = Evidence(view_.problem, terms_, causes_).Solve();
    const Fit null = Evidence(view_.problem, terms_, {}).Solve();
    answer.evidence = fit.log_evidence - null.log_evidence;
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
    for (std::size_t i = 1; i < candidates_.size() && !causes_.empty(); ++i) {
      if (candidates_[i].score > candidates_.front().score - kDecisive &&
          candidates_[i].effect != causes_.front().effect) {
        answer.also_possible.push_back(candidates_[i].effect);
      }
    }
    answer.causes = causes_;
    answer.candidates = candidates_;
    answer.verdict = !causes_.empty()                        ? Verdict::kEffect
                     : answer.remainder.sigma > kUnexplained ? Verdict::kUnknown
                                                             : Verdict::kNone;
    Tell(1.0, "done");
    return answer;
  }

  /// Causes that no term describes.
  void AddEvents(const std::vector<Record>& records, const Remainder& remainder) {
    for (const Candidate& event : FindEvents(rig_, records, remainder)) {
      candidates_.push_back(event);
      if (event.score < kDecisive) continue;
      Hypothesis cause;
      cause.effect = event.effect;
      cause.place = event.place;
      cause.directions =
          Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(terms_.size()), Eigen::Index{0});
      // Lost frames and noise explain none of what the other causes do; the stronger one leads.
      const bool leads = causes_.empty() || event.score > candidates_.front().score;
      causes_.insert(leads ? causes_.begin() : causes_.end(), cause);
    }
    Sort();
  }

  const RigView& rig_;
  const std::vector<Record>& records_;
  const std::vector<Term>& terms_;
  const Settings& settings_;
  Search search_;
  std::vector<double> theta_;
  Gains gains_;
  View view_;
  std::vector<Hypothesis> causes_;
  std::vector<Candidate> candidates_;
  const std::vector<Record>* own_records_{nullptr};
};

}  // namespace

Answer Diagnose(const RigView& rig, const std::vector<Record>& records,
                const std::vector<Term>& terms, const Settings& settings) {
  return Diagnoser(rig, records, terms, settings).Run();
}

}  // namespace levitas::diagnosis
