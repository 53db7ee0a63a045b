#include "diagnosis/inference/refine.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "diagnosis/inference/judging.hpp"
#include "numerics/factors/factors.hpp"

namespace levitas::diagnosis {

namespace {

/// Levenberg's damping in units of the priors' information: zero while the steps succeed.
class LevenbergDamping {
 public:
  void Refuse() noexcept { value_ = value_ > 0.0 ? kUp * value_ : kFirst; }
  void Accept() noexcept { value_ = value_ > kFirst ? value_ / kDown : 0.0; }
  [[nodiscard]] double value() const noexcept { return value_; }

 private:
  static constexpr double kFirst = 3.0;  // times the information of the priors
  static constexpr double kUp = 10.0;
  static constexpr double kDown = 10.0;
  double value_{0.0};
};

/// What a pass of Refiner::Approach leaves to the next one.
struct Descent {
  Refined best;
  Point at;
  LevenbergDamping damping;
  Whitener whitener;
  std::shared_ptr<const Slopes> slopes;
  bool current = false;  ///< the Jacobian was taken at best.point
  int refused = 0;
  double misfit{};  ///< [nat] at best.point, whitened by its own innovations
  double misfit_at_jacobian{std::numeric_limits<double>::infinity()};  ///< where it was taken
};

/// A shorter step in place of the one that was refused; false: enough were.
bool Shorten(const Search& search, const std::vector<Hypothesis>& causes, Descent& d) {
  // The damping counts in the priors' information, and a lightly damped mode may be known ten
  // thousand times better than its prior says: with the Jacobian of this point it grows until that
  // is held, too.
  constexpr int kMostRefused = 4;
  constexpr int kMostRefusedHere = 8;
  if (++d.refused > (d.current ? kMostRefusedHere : kMostRefused)) return false;
  d.damping.Refuse();
  d.at.theta = search.Step(d.best.problem, causes, d.best.point.theta, d.damping.value());
  return true;
}

/// No step with the Jacobian of an earlier point succeeded; take it at the best point.
void ReturnToBest(Descent& d) {
  d.refused = 0;
  d.damping = {};
  d.at = d.best.point;
  d.slopes.reset();
}

/// From where the model ran, with a new Jacobian if it is to be current.
void StepOn(const Search& search, const std::vector<Term>& terms,
            const std::vector<Hypothesis>& causes, const std::vector<Trajectory>& runs,
            Descent& d) {
  if (d.current) {
    d.slopes = search.SlopesOf(runs, d.at, search.NuisancesAnd(causes));
    d.misfit_at_jacobian = d.misfit;
  }
  d.best.problem = search.About(d.slopes->Sum(runs, d.whitener), d.at.theta);
  d.best.evidence = Refiner::EvidenceOfSet(d.best.problem, terms, causes);
  d.damping.Accept();
  d.at.theta = search.Step(d.best.problem, causes, d.best.point.theta, d.damping.value());
}

/// What runs leave behind a filter.
struct Left {
  double squared_sum{};
  double log_power{};  ///< of the noise that the filter claims, over all values
};

Left LeftOf(const std::vector<Trajectory>& runs, std::size_t axes, const Whitener& whitener) {
  Left left;
  std::size_t values = 0;
  left.squared_sum = SquaredSum(runs, axes, whitener, &values);
  for (const auto& filter : whitener.filter) left.log_power -= 2.0 * std::log(filter.front());
  left.log_power *= static_cast<double>(values) / static_cast<double>(axes);
  return left;
}

}  // namespace

double Refiner::Penalty(const std::vector<double>& theta,
                        const std::vector<Hypothesis>& causes) const {
  // Parameters are nuisances plus directions of causes: their prior has the covariance of both.
  constexpr double kJitter = 1e-6;
  const auto size = static_cast<Eigen::Index>(terms_.size());
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(size, size);
  for (const Hypothesis& h : causes) covariance += h.directions * h.directions.transpose();
  Eigen::VectorXd deviation(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const Term& term = terms_[static_cast<std::size_t>(i)];
    covariance(i, i) += kJitter + std::pow(term.tolerance / term.scale(), 2);
    deviation[i] = (theta[static_cast<std::size_t>(i)] - term.healthy_mean) / term.scale();
  }
  return deviation.dot(covariance.llt().solve(deviation));
}

double Refiner::PredictedCost(const LinearProblem& problem,
                              const std::vector<Hypothesis>& causes) const {
  const auto solution = Evidence(problem, terms_, causes).Solve();
  return 0.5 * (solution.squared_sum + solution.penalty);
}

double Refiner::LinearCost(const LinearProblem& problem, const std::vector<Hypothesis>& causes,
                           const std::vector<double>& theta) const {
  const Eigen::VectorXd scaled = search_.Scaled(theta);
  const double square =
      problem.ete + 2.0 * scaled.dot(problem.jte) + scaled.dot(problem.jtj * scaled);
  return 0.5 * (square + Penalty(theta, causes));
}

double Refiner::EvidenceOfSet(const LinearProblem& problem, const std::vector<Term>& terms,
                              const std::vector<Hypothesis>& causes) {
  const auto fit = Evidence(problem, terms, causes).Solve();
  double evidence = fit.log_evidence - 0.5 * problem.ete;
  for (const Hypothesis& h : causes) {
    evidence += h.log_prior + (h.positive ? std::log(2.0) : 0.0);
  }
  return evidence;
}

Runs Refiner::RunAt(const Point& point, const View& view) const {
  if (view.runs && view.point == point) return view.runs;
  return std::make_shared<const std::vector<Trajectory>>(search_.Run(records_, gains_, point));
}

void Refiner::MinimiseByChords(const View& view, const std::vector<Hypothesis>& causes, Point at,
                               int passes, double worth, Refined& best) const {
  constexpr double kConverged = 0.3;  // [nat]
  // With a Jacobian of this very point a step that fails twice fails for the model's own bends.
  const int most_refused = view.close ? 1 : 4;
  NormalEquations sum = view.sum;
  LevenbergDamping damping;
  int refused = 0;
  for (int pass = 0; pass < passes;) {
    Runs runs = RunAt(at, view);
    view.slopes->Renew(*runs, view.whitener, sum);
    const double cost = 0.5 * (sum.ete + Penalty(at.theta, causes));
    const double gained = best.cost - cost;
    if (!std::isfinite(cost) || gained < -kConverged) {
      if (++refused > most_refused) return;
      damping.Refuse();
      if (best.ok && best.problem.jtj.size() > 0) {
        if (EvidenceOfSet(best.problem, terms_, causes) < worth) return;
        at.theta = search_.Step(best.problem, causes, best.point.theta, damping.value());
        // A step that cannot gain is not run; the third one must gain what would decide.
        const double least = refused > 1 ? kDecisive : kConverged;
        if (best.cost - LinearCost(best.problem, causes, at.theta) < least) return;
      } else {
        // The start itself diverges: approach the healthy rig by halves.
        for (std::size_t i = 0; i < terms_.size(); ++i) {
          at.theta[i] = 0.5 * (at.theta[i] + terms_[i].healthy_mean);
        }
      }
      continue;
    }
    best.cost = cost;
    best.point = at;
    best.runs = std::move(runs);
    best.problem = search_.About(sum, at.theta);
    best.ok = true;
    if (gained < kConverged || search_.StopAsked()) return;
    damping.Accept();
    at.theta = search_.Step(best.problem, causes, at.theta, damping.value());
    ++pass;
  }
}

bool Refiner::BendsFrom(const View& view, const std::vector<Hypothesis>& causes,
                        const Point& point) const {
  return std::any_of(causes.begin(), causes.end(), [&](const Hypothesis& h) {
    return std::any_of(h.terms.begin(), h.terms.end(), [&](std::size_t i) {
      return !terms_[i].linear || point.shapes[i] != view.point.shapes[i];
    });
  });
}

Refined Refiner::Fit(const std::vector<Hypothesis>& causes, Point start, const View& view,
                     int passes, double worth) const {
  const bool nonlinear = !view.close && BendsFrom(view, causes, start);
  Refined best;
  MinimiseByChords(view, causes, std::move(start), passes, worth, best);
  // With a Jacobian of an earlier point the steps end before the minimum of a nonlinear model. It
  // is renewed while the linear prediction is better than the model's run by more than this.
  constexpr double kPredictionError = 1.0;  // [nat]
  constexpr int kMostRenewals = 2;
  for (int renewal = 0; !view.close && best.ok && renewal < kMostRenewals; ++renewal) {
    const bool first = renewal == 0 && nonlinear;
    if (!first && best.cost - PredictedCost(best.problem, causes) < kPredictionError) break;
    if (EvidenceOfSet(best.problem, terms_, causes) < worth || search_.StopAsked()) break;
    const bool known = view.point == best.point;
    if (known && passes > 1) break;  // its step was tried
    Runs runs = std::exchange(best.runs, nullptr);
    View here;
    if (!known) {
      here = search_.Linearise(std::move(runs), best.point, view.whitener,
                               search_.NuisancesAnd(causes));
      here.runs = nullptr;
      best.problem = here.problem;
    }
    MinimiseByChords(known ? view : here, causes,
                     {search_.Solve(best.problem, causes), best.point.shapes}, passes, worth, best);
    if (!best.runs) break;  // no step helped
  }
  best.runs = nullptr;
  if (!best.ok) return best;
  // The nonlinear model decides, not its linear prediction, which may lead outside any real rig.
  best.evidence =
      EvidenceOfSet(best.problem, terms_, causes) + PredictedCost(best.problem, causes) - best.cost;
  if (!std::isfinite(best.evidence)) best.ok = false;
  return best;
}

View Refiner::LinearisedAt(const std::vector<Hypothesis>& causes, const Point& at,
                           const View& view) const {
  View about = search_.Linearise(RunAt(at, view), at, view.whitener, search_.NuisancesAnd(causes));
  about.runs = nullptr;
  about.close = true;
  return about;
}

Search::ShapeStep Refiner::StepAlong(const std::vector<Hypothesis>& causes, const Point& at,
                                     const View& about, double width,
                                     const std::function<Point(double)>& beside) const {
  constexpr double kApart = 0.05;  // of the width
  constexpr double kMost = 1.5;
  const auto sum = [&](double by) {
    NormalEquations shifted = about.sum;
    about.slopes->Renew(search_.Run(records_, gains_, beside(by)), about.whitener, shifted);
    return shifted;
  };
  const NormalEquations below = sum(-kApart * width);
  const NormalEquations above = sum(kApart * width);
  return search_.StepAlong(causes, at.theta, about.sum, below, above, kApart * width,
                           kMost * width);
}

double Refiner::Misfit(const Point& point, std::size_t whitening_order,
                       const std::vector<Hypothesis>& causes) const {
  const auto runs = search_.Run(records_, gains_, point);
  // Not just their number: of innovations that swing, or belong to some rows alone, the filter
  // leaves more than it claims.
  const Left left = LeftOf(runs, axes_, MakeWhitener(runs, axes_, whitening_order));
  return 0.5 * (left.log_power + left.squared_sum + Penalty(point.theta, causes));
}

Refined Refiner::Approach(Point start, std::size_t whitening_order, int passes,
                          const std::vector<Hypothesis>& causes) const {
  constexpr double kConverged = 1.0;  // [nat]
  constexpr double kFar = 100.0;      // [nat] a step that gains more has left its linearisation
  Descent d;
  d.at = std::move(start);
  for (int pass = 0; pass < passes;) {
    auto runs = search_.Run(records_, gains_, d.at);
    const double gained = pass == 0 ? std::numeric_limits<double>::infinity()
                                    : d.best.cost - 0.5 * (SquaredSum(runs, axes_, d.whitener) +
                                                           Penalty(d.at.theta, causes));
    if (pass > 0 && !(std::isfinite(gained) && gained > -kConverged)) {
      if (Shorten(search_, causes, d)) continue;
      if (d.current) break;
      ReturnToBest(d);
      runs = search_.Run(records_, gains_, d.at);
    }
    d.whitener = search_.WhitenerOf(runs, whitening_order);
    const Left left = LeftOf(runs, axes_, d.whitener);
    const double penalty = Penalty(d.at.theta, causes);
    d.best.cost = 0.5 * (left.squared_sum + penalty);
    d.misfit = 0.5 * (left.log_power + left.squared_sum + penalty);
    if (!std::isfinite(d.best.cost)) break;
    d.best.point = d.at;
    d.best.ok = true;
    d.refused = 0;
    // The filter follows the fit, so that a step may gain by one filter what the next one takes
    // back: a Jacobian that has not lowered the misfit is not followed by another one.
    const bool settled = d.current || !(d.misfit < d.misfit_at_jacobian - kConverged);
    if (gained < kConverged && settled) break;
    d.current = !d.slopes || gained > kFar || gained < kConverged;
    StepOn(search_, terms_, causes, runs, d);
    if (search_.StopAsked()) break;
    ++pass;
  }
  return std::move(d.best);
}

}  // namespace levitas::diagnosis
