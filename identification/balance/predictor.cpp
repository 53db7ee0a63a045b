#include "identification/balance/predictor.hpp"

#include <cmath>
#include <complex>
#include <numbers>

#include "analysis/reading_noise.hpp"
#include "analysis/records/observer.hpp"
#include "common/problem.hpp"
#include "numerics/dense/spectrum.hpp"
#include "numerics/factors/factors.hpp"

namespace levitas::balancing {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;

/// Share of a magnet's force that the model misses. Chosen: of 0.03, 0.1 and 0.3 % this one left
/// the smallest errors of weights on twenty drawn rigs.
constexpr double kMissedForce = 0.003;
/// And of what its curvature adds, 1.5 (y/s0)^2 of ks y: gains that differ, harmonics, the window.
constexpr double kMissedCurvature = 0.3;
/// Of the noise of a reading that every equation has at least: what the observer takes out of it
/// next to a weakly damped pole would else be trusted to all digits.
constexpr double kLeastNoise = 0.1;
/// Steps of the unknowns for slopes of the matrices, in standard deviations.
constexpr double kStep = 0.01;
/// Windows further apart are not neighbours: the record has a gap.
constexpr double kNeighbours = 3.0;
/// Windows overlap by half: from the second on they share no sample.
constexpr std::size_t kIndependent = 2;
/// On either side.
constexpr std::size_t kNeighbourhood = 3;
/// About the length of a window (order_track.hpp): whichever is longer.
constexpr double kWindowS = 0.1;
constexpr double kWindowTurns = 6.0;

}  // namespace

Complex DelayAndHold(double speed_rad_per_s, double delay_s, double period_s) {
  const double half = 0.5 * speed_rad_per_s * period_s;
  const double hold = half == 0.0 ? 1.0 : std::sin(half) / half;
  return std::polar(hold, -speed_rad_per_s * (delay_s + 0.5 * period_s));
}

/// Of one window: states per column, and C Z^-1.
struct Predictor::Response {
  Eigen::MatrixXcd states;   ///< states x (1 + planes + axes)
  Eigen::MatrixXcd seen;     ///< axes x states
  Eigen::VectorXcd current;  ///< behind delay and hold
};

Predictor::Predictor(const BalanceRig& rig, const std::vector<TrackedRun>& runs) : rig_(rig) {
  for (std::size_t i = 0; i < runs.size(); ++i) {
    for (const analysis::TrackedWindow& window : runs[i].windows) {
      windows_.push_back(window);
      added_kg_m_.push_back(runs[i].added_kg_m);
      run_.push_back(i);
    }
  }
  for (std::size_t k = 0; k < windows_.size(); ++k) {
    measured_.push_back({windows_[k].position_m, windows_[k].current_a});
    smooth_.push_back(FromNeighbours(k));
    curved_n_.emplace_back(Eigen::VectorXcd::Zero(rig_.axes()));
  }
  ChooseGain();
  ChooseWeights();
  Refer(Eigen::VectorXd::Zero(static_cast<Index>(rig_.unknowns().size())),
        Eigen::VectorXcd::Zero(amplitudes()));
}

std::vector<std::size_t> Predictor::Near(std::size_t k) const {
  std::vector<std::size_t> near;
  for (std::size_t off = kIndependent; off < kIndependent + kNeighbourhood; ++off) {
    if (k >= off && run_[k - off] == run_[k]) near.push_back(k - off);
    if (k + off < windows_.size() && run_[k + off] == run_[k]) near.push_back(k + off);
  }
  return near;
}

Predictor::Amplitudes Predictor::FromNeighbours(std::size_t k) const {
  const std::vector<std::size_t> near = Near(k);
  const auto count = static_cast<Index>(near.size());
  const Index order = std::min<Index>(3, count);
  Eigen::MatrixXd basis(count, order);
  Eigen::MatrixXcd values(count, 2 * rig_.axes());
  for (Index i = 0; i < count; ++i) {
    const auto& other = windows_[near[static_cast<std::size_t>(i)]];
    const double away = other.time_s - windows_[k].time_s;
    for (Index power = 0; power < order; ++power)
      basis(i, power) = std::pow(away, static_cast<double>(power));
    values.row(i) << other.position_m.transpose(), other.current_a.transpose();
  }
  const Eigen::MatrixXd normal = basis.transpose() * basis;
  const Eigen::RowVectorXd first = normal.ldlt().solve(Eigen::MatrixXd(basis.transpose())).row(0);
  const Eigen::RowVectorXcd here = first.cast<Complex>() * values;
  return {here.head(rig_.axes()).transpose(), here.tail(rig_.axes()).transpose()};
}

void Predictor::ChooseGain() {
  const auto nominal = Eigen::VectorXd::Zero(static_cast<Index>(rig_.unknowns().size()));
  const RigMatrices matrices = rig_.At(nominal);
  double speed = 0.0;
  for (const auto& window : windows_) speed = std::max(speed, std::abs(window.speed_rad_per_s));
  const auto gain = analysis::DesignObserver(rig_.rig().plant, {0.5 * speed, 0.01, 1e-4});
  // The gain per sample, spread over the period: slower than the sampled observer, stable with it.
  gain_ = gain.state / rig_.period_s();
  const Eigen::MatrixXd a = matrices.a0 - gain_ * matrices.c;
  if (numerics::EigenvaluesOf(a).real().maxCoeff() >= 0.0) {
    throw Problem(ExitStatus::kOther, "no observer of this rig settles without its sampling");
  }
}

void Predictor::ChooseWeights() {
  const auto nominal = Eigen::VectorXd::Zero(static_cast<Index>(rig_.unknowns().size()));
  const RigMatrices matrices = rig_.At(nominal);
  const std::vector<Response> responses = Respond(matrices, measured_);
  for (std::size_t k = 0; k < windows_.size(); ++k) {
    const analysis::TrackedWindow& window = windows_[k];
    // What the sensors' noise becomes behind the observer, (1 - C Z^-1 L) e.
    const Eigen::MatrixXcd passed =
        Eigen::MatrixXcd::Identity(rig_.axes(), rig_.axes()) - responses[k].seen * gain_;
    Eigen::MatrixXcd covariance = Eigen::MatrixXcd::Zero(rig_.axes(), rig_.axes());
    for (Index axis = 0; axis < rig_.axes(); ++axis) {
      const auto& sensor = rig_.rig().plant.bearings[static_cast<std::size_t>(axis / 2)].sensor;
      const double noise_m = std::max(analysis::ReadingNoise(sensor), 1e-9);
      const double square = 4.0 * noise_m * noise_m / window.samples;
      covariance += square * passed.col(axis) * passed.col(axis).adjoint();
      covariance(axis, axis) += kLeastNoise * kLeastNoise * square;
      const double force_n = rig_.ki_n_per_a()[axis] * std::abs(window.current_a[axis]) +
                             rig_.ks_n_per_m()[axis] * std::abs(window.position_m[axis]);
      const Eigen::VectorXcd moved = responses[k].seen * matrices.push.col(axis);
      const double curved = 1.5 * std::norm(window.position_m[axis] / rig_.gap_m(axis));
      const double missed_n = (kMissedForce + kMissedCurvature * curved) * force_n;
      covariance += missed_n * missed_n * moved * moved.adjoint();
    }
    const Eigen::MatrixXcd root = covariance.llt().matrixL();
    weight_.push_back(std::numbers::sqrt2 *
                      root.triangularView<Eigen::Lower>().solve(
                          Eigen::MatrixXcd::Identity(rig_.axes(), rig_.axes())));
  }
}

std::vector<Predictor::Response> Predictor::Respond(const RigMatrices& rig,
                                                    const std::vector<Amplitudes>& data) const {
  const Complex j(0.0, 1.0);
  std::vector<Response> responses;
  responses.reserve(windows_.size());
  const Eigen::MatrixXd fixed = rig.a0 - gain_ * rig.c;
  const Index planes = rig_.planes();
  for (std::size_t k = 0; k < windows_.size(); ++k) {
    const analysis::TrackedWindow& window = windows_[k];
    const double w = window.speed_rad_per_s;
    Eigen::MatrixXcd z = (-fixed - w * rig.a1).cast<Complex>();
    z.diagonal().array() += j * w;
    const Eigen::PartialPivLU<Eigen::MatrixXcd> solver(z);
    Response one;
    one.current = DelayAndHold(w, rig.delay_s, rig_.period_s()) * data[k].current_a;
    Eigen::MatrixXcd driven(rig.a0.rows(), 1 + amplitudes());
    driven.col(0) = rig.b * one.current + gain_ * data[k].position_m + rig.push * curved_n_[k];
    driven.middleCols(1, planes) = (w * w - j * window.acceleration_rad_per_s2) * rig.unbalance;
    driven.rightCols(rig_.axes()) = -gain_.cast<Complex>();
    one.states = solver.solve(driven);
    const Eigen::MatrixXcd read = rig.c.transpose().cast<Complex>();
    const Eigen::MatrixXcd seen = solver.transpose().solve(read);
    one.seen = seen.transpose();
    responses.push_back(std::move(one));
  }
  return responses;
}

bool Predictor::AreNeighbours(std::size_t before, std::size_t after) const {
  const double apart_s = windows_[after].time_s - windows_[before].time_s;
  const double turn_s = 2.0 * std::numbers::pi / std::abs(windows_[after].speed_rad_per_s);
  return apart_s > 0.0 && apart_s < kNeighbours * std::max(kWindowS, kWindowTurns * turn_s);
}

std::vector<WindowEquations> Predictor::At(const Eigen::VectorXd& place) const {
  const RigMatrices rig = rig_.At(place);
  return Equations(rig, Respond(rig, smooth_));
}

std::vector<WindowEquations> Predictor::Equations(const RigMatrices& rig,
                                                  const std::vector<Response>& responses) const {
  std::vector<Eigen::MatrixXcd> rows = Rows(rig, responses, smooth_);
  std::vector<WindowEquations> made(windows_.size());
  for (std::size_t k = 0; k < windows_.size(); ++k) {
    rows[k].col(0) +=
        measured_less_smooth_[k] + rows[k].middleCols(1, rig_.planes()) * added_kg_m_[k];
    made[k].linear = weight_[k] * rows[k];
  }
  return made;
}

Predictor::Amplitudes Predictor::FromModel(const RigMatrices& rig, const Response& response,
                                           std::size_t k,
                                           const Eigen::VectorXcd& amplitudes) const {
  // (W + G B d c) y = W R + G (H (w^2 - j w') U + curved force), i = -c y.
  const Index axes = rig_.axes();
  const double w = windows_[k].speed_rad_per_s;
  const Eigen::VectorXcd unbalance = amplitudes.head(rig_.planes()) + added_kg_m_[k];
  const Eigen::VectorXcd law = LawNear(k);
  Eigen::MatrixXcd passed = Eigen::MatrixXcd::Identity(axes, axes) - response.seen * gain_;
  const Eigen::VectorXcd driven =
      passed * amplitudes.tail(axes) +
      response.seen *
          (Complex(w * w, -windows_[k].acceleration_rad_per_s2) * (rig.unbalance * unbalance) +
           rig.push * curved_n_[k]);
  passed +=
      DelayAndHold(w, rig.delay_s, rig_.period_s()) * (response.seen * rig.b) * law.asDiagonal();
  Amplitudes made;
  made.position_m = passed.partialPivLu().solve(driven);
  made.current_a = -law.cwiseProduct(made.position_m);
  return made;
}

Eigen::VectorXcd Predictor::LawNear(std::size_t k) const {
  Eigen::VectorXcd across = Eigen::VectorXcd::Zero(rig_.axes());
  Eigen::VectorXd square = Eigen::VectorXd::Constant(rig_.axes(), 1e-30);
  for (const std::size_t other : Near(k)) {
    across += measured_[other].position_m.conjugate().cwiseProduct(measured_[other].current_a);
    square += measured_[other].position_m.cwiseAbs2();
  }
  return -across.cwiseQuotient(square.cast<Complex>());
}

Eigen::VectorXcd Predictor::StatesOf(const Response& response, std::size_t k,
                                     const Eigen::VectorXcd& amplitudes) const {
  Eigen::VectorXcd all(1 + this->amplitudes());
  all << Complex(1.0), amplitudes;
  all.segment(1, rig_.planes()) += added_kg_m_[k];
  return response.states * all;
}

void Predictor::Refer(const Eigen::VectorXd& place, const Eigen::VectorXcd& amplitudes) {
  const RigMatrices rig = rig_.At(place);
  // Before the first fit nothing is known to move, and no force is curved.
  if (!amplitudes.isZero(0.0)) {
    const std::vector<Response> responses = Respond(rig, smooth_);
    for (std::size_t k = 0; k < windows_.size(); ++k) {
      const Eigen::VectorXcd states = StatesOf(responses[k], k, amplitudes);
      const Eigen::VectorXcd seen = rig.seen * states;
      for (Index axis = 0; axis < rig_.axes(); ++axis) {
        curved_n_[k][axis] =
            rig_.ForceBeyondSlopes(axis, states[rig.coil_current + axis], seen[axis]);
      }
      smooth_[k] = FromModel(rig, responses[k], k, amplitudes);
    }
  }
  const auto measured = Rows(rig, Respond(rig, measured_), measured_);
  const auto smooth = Rows(rig, Respond(rig, smooth_), smooth_);
  measured_less_smooth_.clear();
  for (std::size_t k = 0; k < windows_.size(); ++k) {
    measured_less_smooth_.emplace_back(measured[k].col(0) - smooth[k].col(0));
  }
}

std::vector<Eigen::MatrixXcd> Predictor::Rows(const RigMatrices& rig,
                                              const std::vector<Response>& responses,
                                              const std::vector<Amplitudes>& data) const {
  std::vector<Eigen::MatrixXcd> made(windows_.size());
  for (std::size_t k = 0; k < windows_.size(); ++k) {
    Eigen::MatrixXcd r = -(rig.c * responses[k].states);
    r.col(0) += data[k].position_m;
    r.rightCols(rig_.axes()) -= Eigen::MatrixXcd::Identity(rig_.axes(), rig_.axes());
    const std::size_t before = k > 0 && run_[k - 1] == run_[k] ? k - 1 : k;
    const std::size_t after = k + 1 < windows_.size() && run_[k + 1] == run_[k] ? k + 1 : k;
    if (AreNeighbours(before, after)) {
      const double apart_s = windows_[after].time_s - windows_[before].time_s;
      r += responses[k].seen * ((responses[after].states - responses[before].states) / apart_s);
    }
    made[k] = std::move(r);
  }
  return made;
}

std::vector<WindowEquations> Predictor::At(const Eigen::VectorXd& place,
                                           const Eigen::VectorXcd& amplitudes) const {
  const auto unknowns = static_cast<Index>(rig_.unknowns().size());
  const RigMatrices rig = rig_.At(place);
  const std::vector<Response> responses = Respond(rig, smooth_);
  std::vector<WindowEquations> made = Equations(rig, responses);
  std::vector<Eigen::VectorXcd> states;
  for (std::size_t k = 0; k < windows_.size(); ++k) {
    states.push_back(StatesOf(responses[k], k, amplitudes));
    made[k].slopes.resize(rig_.axes(), unknowns);
  }
  for (Index i = 0; i < unknowns; ++i) {
    const double step = kStep * rig_.unknowns()[static_cast<std::size_t>(i)].deviation;
    Eigen::VectorXd more = place;
    Eigen::VectorXd less = place;
    more[i] += step;
    less[i] -= step;
    const RigMatrices high = rig_.At(more);
    const RigMatrices low = rig_.At(less);
    const double per = 0.5 / step;
    const Eigen::MatrixXd c = per * (high.c - low.c);
    const Eigen::MatrixXd a0 = per * (high.a0 - low.a0) - gain_ * c;
    const Eigen::MatrixXd a1 = per * (high.a1 - low.a1);
    const Eigen::MatrixXd b = per * (high.b - low.b);
    const Eigen::MatrixXcd h = per * (high.unbalance - low.unbalance);
    const double delay_s = per * (high.delay_s - low.delay_s);
    for (std::size_t k = 0; k < windows_.size(); ++k) {
      const double w = windows_[k].speed_rad_per_s;
      const Complex force(w * w, -windows_[k].acceleration_rad_per_s2);
      const Eigen::VectorXcd driven =
          a0 * states[k] + w * (a1 * states[k]) + b * responses[k].current +
          force * (h * (amplitudes.head(rig_.planes()) + added_kg_m_[k])) -
          Complex(0.0, w * delay_s) * (rig.b * responses[k].current);
      made[k].slopes.col(i) = -(weight_[k] * (c * states[k] + responses[k].seen * driven));
    }
  }
  return made;
}

}  // namespace levitas::balancing
