#pragma once
// Joint fit of nuisance parameters and a given set of causes on the nonlinear model.
//
// Method     Gauss-Newton from a start. A step that increases the cost, or is not finite, is
//            repeated with damping (Levenberg 1944), which shortens the directions that the data
//            do not determine. The Jacobian is that of an existing linearisation (chord method);
//            for a nonlinear cause (Term::linear) it is renewed at the new point. The
//            whitening stays the same, so that sets can be compared.
// Own loop   numerics::LevenbergMarquardt runs the model once for the cost of a step and once more
//            for the normal equations. Here one run gives both (Slopes::Renew), and a run is almost
//            all the time of a diagnosis. The damping adds the priors' information, with their
//            correlations, instead of a share of the diagonal; Approach changes the cost itself at
//            every pass, since it estimates the whitening anew.
// Evidence   of the whole set, -1/2 (squared sum + penalty + log det), priors of places included.
//            Only differences between sets of causes on the same records and whitening are
//            meaningful.
// Thread     blocks the caller, every processor inside. Failure: `ok` false when no finite run was
//            found.

#include <functional>
#include <limits>
#include <vector>

#include "diagnosis/inference/search.hpp"

namespace levitas::diagnosis {

/// As what a fit must be worth: it is finished whatever it reaches.
inline constexpr double kAnyEvidence = -std::numeric_limits<double>::infinity();

struct Refined {
  Point point;
  double evidence{};
  bool ok{};
  LinearProblem problem;                                 ///< about the point
  double cost{std::numeric_limits<double>::infinity()};  ///< [nat] of data and priors there
  Runs runs;                                             ///< there, while it is being fitted
};

class Refiner {
 public:
  Refiner(const Search& search, const std::vector<Term>& terms, const std::vector<Record>& records,
          const Gains& gains, std::size_t axes)
      : search_(search), terms_(terms), records_(records), gains_(gains), axes_(axes) {}

  /// `start` has the shapes, which a fit does not move.
  /// `view` has everything linearised on the records of this refiner, or is close. Stops
  /// early, without a new Jacobian or a shorter step, where even the linearised optimum stays below
  /// the evidence `worth`. A close Jacobian is never renewed.
  [[nodiscard]] Refined Fit(const std::vector<Hypothesis>& causes, Point start, const View& view,
                            int passes, double worth = kAnyEvidence) const;
  /// Nuisances and causes linearised at a point, without its runs; `view` gives the whitening.
  [[nodiscard]] View LinearisedAt(const std::vector<Hypothesis>& causes, const Point& at,
                                  const View& view) const;
  /// Newton's step of all parameters and of a shape parameter without analytic slope. `beside` is
  /// the point with another value of that one, relative to that of `at` in its logarithm; `about`
  /// is what LinearisedAt gives of it.
  [[nodiscard]] Search::ShapeStep StepAlong(const std::vector<Hypothesis>& causes, const Point& at,
                                            const View& about, double width,
                                            const std::function<Point(double)>& beside) const;
  /// Nuisances and causes, from far away. The whitening filter is re-estimated at every pass, since
  /// a residual that is not calibrated yet is not noise and must not be weighted down as such.
  [[nodiscard]] Refined Approach(Point start, std::size_t whitening_order, int passes,
                                 const std::vector<Hypothesis>& causes = {}) const;
  /// [nat] cost of nuisances and causes at the point, whitened by their own innovations; compares
  /// starts, and answers whose noise differs.
  [[nodiscard]] double Misfit(const Point& point, std::size_t whitening_order,
                              const std::vector<Hypothesis>& causes = {}) const;
  /// Evidence of a set on a linearisation of everything.
  [[nodiscard]] static double EvidenceOfSet(const LinearProblem& problem,
                                            const std::vector<Term>& terms,
                                            const std::vector<Hypothesis>& causes);

 private:
  /// Improves `best` from `at` on with the Jacobian of `view`, until a step gains too little.
  void MinimiseByChords(const View& view, const std::vector<Hypothesis>& causes, Point at,
                        int passes, double worth, Refined& best) const;
  [[nodiscard]] Runs RunAt(const Point& point, const View& view) const;
  /// The linearisation is that of other shapes of the causes, or a cause is no straight line.
  [[nodiscard]] bool BendsFrom(const View& view, const std::vector<Hypothesis>& causes,
                               const Point& point) const;
  /// [nat] cost at the minimum of the linearised model.
  [[nodiscard]] double PredictedCost(const LinearProblem& problem,
                                     const std::vector<Hypothesis>& causes) const;
  /// [nat] cost of data and priors at theta, as the linearised model has it.
  [[nodiscard]] double LinearCost(const LinearProblem& problem,
                                  const std::vector<Hypothesis>& causes,
                                  const std::vector<double>& theta) const;
  [[nodiscard]] double Penalty(const std::vector<double>& theta,
                               const std::vector<Hypothesis>& causes) const;

  const Search& search_;
  const std::vector<Term>& terms_;
  const std::vector<Record>& records_;
  const Gains& gains_;
  std::size_t axes_;
};

}  // namespace levitas::diagnosis
