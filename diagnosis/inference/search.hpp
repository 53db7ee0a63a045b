#pragma once
// Linearised problems of a search for causes: runs of the model, linearisation, solution.
//
// Thread  blocks the caller, every processor inside.

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "diagnosis/inference/diagnose.hpp"
#include "diagnosis/model/observer_speed.hpp"
#include "diagnosis/model/point.hpp"
#include "diagnosis/model/slopes.hpp"

namespace levitas::diagnosis {

/// Observers of all records for one tuning.
using Gains = std::vector<ObserverGains>;

/// Runs of one model over all records: shared, since those of 13 s take 150 MB.
using Runs = std::shared_ptr<const std::vector<Trajectory>>;

/// One linearisation, on the records it was made with.
struct View {
  Point point;   ///< where it was taken
  bool close{};  ///< to what is fitted with it, shapes included
  Runs runs;
  Whitener whitener;
  std::shared_ptr<const Slopes> slopes;
  NormalEquations sum;
  LinearProblem problem;
};

class Search {
 public:
  /// `only`: the one effect that is looked for; none: all. `model_error_share`: of judging.hpp.
  Search(const RigView& rig, const std::vector<Term>& terms,
         std::optional<effect::Id> only = std::nullopt,
         double model_error_share = Judging{}.model_error_share);

  [[nodiscard]] Whitener WhitenerOf(const std::vector<Trajectory>& runs, std::size_t order) const {
    return MakeWhitener(runs, rig_.axes, order, model_error_share_);
  }
  [[nodiscard]] double model_error_share() const { return model_error_share_; }
  [[nodiscard]] Gains DesignGains(const std::vector<Record>& records,
                                  const ObserverSpeed& speed) const;
  [[nodiscard]] std::vector<Trajectory> Run(const std::vector<Record>& records, const Gains& gains,
                                            const Point& point) const;
  /// The same in the caller's thread alone, for callers that have several.
  [[nodiscard]] std::vector<Trajectory> RunAlone(const std::vector<Record>& records,
                                                 const Gains& gains, const Point& point) const;
  /// Derivatives along runs at the point. Terms outside `chosen` get sensitivities of zero.
  [[nodiscard]] std::shared_ptr<const Slopes> SlopesOf(
      const std::vector<Trajectory>& runs, const Point& point,
      const std::vector<std::size_t>& chosen) const;
  /// Runs and linearises.
  [[nodiscard]] View Linearise(const std::vector<Record>& records, const Gains& gains,
                               const Point& point, std::size_t whitening_order,
                               const std::vector<std::size_t>& chosen) const;
  /// The same for existing runs, with a previous whitening filter.
  [[nodiscard]] View Linearise(Runs runs, const Point& point, const Whitener& whitener,
                               const std::vector<std::size_t>& chosen) const;
  /// Sums of runs at theta as a problem about the nominal rig.
  [[nodiscard]] LinearProblem About(const NormalEquations& sum,
                                    const std::vector<double>& theta) const;

  /// Solution of nuisances and causes, in the terms' own units.
  [[nodiscard]] std::vector<double> Solve(const LinearProblem& problem,
                                          const std::vector<Hypothesis>& causes) const;

  /// A damped step from theta towards the solution (Evidence::Step).
  [[nodiscard]] std::vector<double> Step(const LinearProblem& problem,
                                         const std::vector<Hypothesis>& causes,
                                         const std::vector<double>& theta, double damping) const;

  /// The same with a shape parameter; `above` and `below` are sums with it `apart` to either side.
  struct ShapeStep {
    double step;  ///< of the logarithm
    std::vector<double> theta;
  };
  [[nodiscard]] ShapeStep StepAlong(const std::vector<Hypothesis>& causes,
                                    const std::vector<double>& theta, const NormalEquations& sum,
                                    const NormalEquations& below, const NormalEquations& above,
                                    double apart, double most) const;

  /// Settings::stop, for who works with this search.
  void StopWhen(std::function<bool()> stop) { stop_ = std::move(stop); }
  [[nodiscard]] const std::function<bool()>& stop() const { return stop_; }
  [[nodiscard]] bool StopAsked() const { return stop_ && stop_(); }

  [[nodiscard]] const RigView& rig() const { return rig_; }
  [[nodiscard]] const std::vector<Hypothesis>& hypotheses() const { return hypotheses_; }
  /// Where the healthy rig is: the start of every search.
  [[nodiscard]] Point HealthyPoint() const;
  /// In units of Term::scale() from the healthy rig.
  [[nodiscard]] Eigen::VectorXd Scaled(const std::vector<double>& theta) const;
  [[nodiscard]] std::vector<std::size_t> Nuisances() const;
  [[nodiscard]] std::vector<std::size_t> Everything() const;
  [[nodiscard]] std::vector<std::size_t> NuisancesAnd(const std::vector<Hypothesis>& causes) const;

 private:
  /// Back from units of Term::scale().
  [[nodiscard]] std::vector<double> Unscaled(const Eigen::VectorXd& scaled) const;

  const RigView& rig_;
  const std::vector<Term>& terms_;
  std::vector<Hypothesis> hypotheses_;
  double model_error_share_;
  std::function<bool()> stop_;
};

/// Below this no rig is, whatever a straight line or a normal distribution says.
[[nodiscard]] double LeastPossible(const Term& term);

inline constexpr std::size_t kQuickRows = 30'000;    ///< of all records, for a first answer
inline constexpr std::size_t kHealthyRows = 60'000;  ///< to learn what is usual
inline constexpr std::size_t kMostRows = 200'000;    ///< more would take a minute and gigabytes

/// At most about `rows` of all records together, each in proportion, as spans spread evenly over
/// it: every excitation and every speed stays represented.
/// A span is at least three times as long as the model settles, so that at any rate most of it
/// counts.
[[nodiscard]] std::vector<Record> Spans(const std::vector<Record>& records, std::size_t rows,
                                        double period_s);

/// kQuickRows of them, and at a high rate as many more as the model settles longer: even spans, and
/// where those few would miss a test signal, the spans that hold the test signals
/// (excited_windows.hpp).
[[nodiscard]] std::vector<Record> QuickSpans(const std::vector<Record>& records, double period_s);

}  // namespace levitas::diagnosis
