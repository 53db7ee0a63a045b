// Poles of the sampled loop, linear plant and textbook law, against an independent program.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "numerics/spectra/spectra.hpp"
#include "plant_sim/plant/linear_model.hpp"
#include "plant_sim/plant/plant.hpp"
#include "tests/loop/reference/textbook_law.hpp"
#include "tests/support/reference_csv.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::test {
namespace {

constexpr double kPeriod_s = 1e-4;
constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr Eigen::Index kSections = 4;

struct Pole {
  double frequency_hz;
  double damping_ratio;
};

// One step of plant and law, both linear; the state is the plant's, then two numbers per biquad
// (transposed direct form II), axis by axis.
Eigen::VectorXd Step(const plant::LinearModel& model, const Eigen::VectorXd& state) {
  const Eigen::Index n = model.a.rows();
  const Eigen::VectorXd y = model.c * state.head(n);
  Eigen::VectorXd next(state.size());
  Eigen::VectorXd u(4);
  for (Eigen::Index axis = 0; axis < 4; ++axis) {
    const TextbookAxis law(axis < 2 ? 1.0 : 2.1294, kPeriod_s);
    double value = y[axis];
    Eigen::Index at = n + axis * 2 * kSections;
    for (const Biquad& section : law.sections()) {
      const double output = section.numerator[0] * value + state[at];
      next[at] = section.numerator[1] * value - section.denominator[1] * output + state[at + 1];
      next[at + 1] = section.numerator[2] * value - section.denominator[2] * output;
      value = output;
      at += 2;
    }
    u[axis] = -value;
  }
  next.head(n) = model.a * state.head(n) + model.b * u;
  return next;
}

// The rig is the same in x and y, so r = x + j y halves the problem and shows the whirl direction:
// the columns of the result pick x - j y of every pair of states.
Eigen::MatrixXcd ComplexCoordinate(const plant::StateLayout& at, Eigen::Index size) {
  std::vector<std::pair<Eigen::Index, Eigen::Index>> pairs;
  const auto index = [](std::size_t i) { return static_cast<Eigen::Index>(i); };
  for (std::size_t i = 0; i < at.modes; ++i) {
    pairs.emplace_back(index(at.q_x + i), index(at.q_y + i));
    pairs.emplace_back(index(at.v_x + i), index(at.v_y + i));
  }
  const Eigen::Index law = index(at.size) + 4;  // after one delayed command per axis
  for (Eigen::Index i = index(at.coil_current); i < law; i += 2) pairs.emplace_back(i, i + 1);
  for (Eigen::Index bearing = 0; bearing < 2; ++bearing) {
    for (Eigen::Index i = 0; i < 2 * kSections; ++i) {
      const Eigen::Index x = law + bearing * 4 * kSections + i;
      pairs.emplace_back(x, x + 2 * kSections);
    }
  }
  Eigen::MatrixXcd pick = Eigen::MatrixXcd::Zero(size, static_cast<Eigen::Index>(pairs.size()));
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pick(pairs[i].first, index(i)) = std::sqrt(0.5);
    pick(pairs[i].second, index(i)) = std::complex<double>(0.0, -std::sqrt(0.5));
  }
  return pick;
}

std::vector<Pole> Poles(double speed_rpm) {
  const auto config = QuietFlexibleRotor();
  const auto model = plant::Discretise(plant::Linearise(config, speed_rpm * kTwoPi / 60.0),
                                       kPeriod_s, config.delay_samples);
  const Eigen::Index size = model.a.rows() + 4 * 2 * kSections;
  Eigen::MatrixXd loop(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    loop.col(i) = Step(model, Eigen::VectorXd::Unit(size, i));
  }
  const Eigen::MatrixXcd pick = ComplexCoordinate(plant::Plant(config, 1).layout(), size);
  const Eigen::MatrixXcd half = pick.adjoint() * loop * pick;
  std::vector<Pole> poles;
  const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(half);
  for (Eigen::Index i = 0; i < half.rows(); ++i) {
    const std::complex<double> s = std::log(solver.eigenvalues()[i]) / kPeriod_s;
    poles.push_back({s.imag() / kTwoPi, -s.real() / std::abs(s)});
  }
  return poles;
}

TEST(ClosedLoopPoles, AgreeWithTheIndependentProgramBelowOneKilohertz) {
  double speed_rpm = -1.0;
  std::vector<Pole> poles;
  for (const auto& row : ReadReference("flexible_rotor_closed_loop.csv")) {
    if (row[0] != speed_rpm) poles = Poles(speed_rpm = row[0]);
    if (std::abs(row[1]) > 1000.0) continue;
    // 0.5 % of the frequency, but never finer than the three decimals the slow poles are given with
    // and the cancellation in their angle (they lie within 1e-3 of z = 1): 0.02 Hz.
    const double tolerance_hz = std::max(0.005 * std::abs(row[1]), 0.02);
    double best = std::numeric_limits<double>::infinity();
    for (const Pole& pole : poles) {
      best = std::min(best, std::max(std::abs(pole.frequency_hz - row[1]) / tolerance_hz,
                                     std::abs(pole.damping_ratio - row[2]) / 0.002));
    }
    EXPECT_LE(best, 1.0) << row[0] << " rpm, " << row[1] << " Hz, damping " << row[2];
  }
}

}  // namespace
}  // namespace levitas::test
