// The small cost function that Ceres gets has cost, gradient and matrix of all lines; an experiment
// in which magnets are stiffer responds as a rig with such magnets.
#include "identification/modal/normal_cost.hpp"
#include "common/rotational_speed.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <tuple>

#include "common/random.hpp"
#include "configuration/rig_file.hpp"
#include "identification/modal/working_gains.hpp"
#include "tests/support/paths.hpp"

namespace levitas::identification {
namespace {

const ModalStart& Start() {
  static const ModalStart start = StartFromRig(
      configuration::LoadRig(test::SourceFolder() + "/config/rigs/flexible_rotor.yaml").plant, 5);
  return start;
}

/// Responses of the rig file itself with some scatter, on a few lines.
FrequencyResponse Data(double rpm) {
  Random random(7);
  FrequencyResponse data;
  data.speed_rad_per_s = RpmToRadPerS(rpm);
  data.period_s = 1e-4;
  data.channels = {"de_x", "de_y", "nde_x", "nde_y"};
  const Physical rig = ToPhysical(Start().frame, Start().vector);
  for (double f = 11.0; f < 900.0; f *= 1.07) {
    Eigen::MatrixXcd plant = ModalResponse(Start().frame, rig, f, data.speed_rad_per_s);
    Eigen::MatrixXcd currents = Eigen::MatrixXcd::Identity(4, 4);
    for (Eigen::Index i = 0; i < 16; ++i) {
      plant.data()[i] *= 1.0 + 0.05 * std::complex<double>(random.Normal(), random.Normal());
      currents.data()[i] += 0.2 * std::complex<double>(random.Normal(), random.Normal());
    }
    data.frequency_hz.push_back(f);
    data.plant.push_back(plant);
    data.currents.push_back(currents);
    data.variance.push_back(1e-4 * plant.cwiseAbs2());
    data.noise.push_back(Eigen::MatrixXd::Constant(4, 4, 1e-14));
  }
  return data;
}

WorkingGains Stiffer() {
  WorkingGains gains{Eigen::MatrixXd::Ones(4, 4), Eigen::MatrixXd::Ones(4, 4)};
  gains.ks.diagonal().array() += 0.08;
  gains.ki.diagonal().array() += 0.03;
  return gains;
}

std::vector<LineResiduals> Lines(const FrequencyResponse& data, const WorkingGains& gains,
                                 LineKind kind) {
  std::vector<LineResiduals> lines;
  for (std::size_t k = 0; k < data.frequency_hz.size(); ++k) {
    lines.emplace_back(Start().frame, data, gains, k, kind, 0.005);
  }
  return lines;
}

/// 1/2 sum of the squares, prior included, at `vector`, straight from the residuals.
double Cost(const std::vector<LineResiduals>& lines, const Eigen::VectorXd& vector, bool robust) {
  const Physical rig = ToPhysical(Start().frame, vector);
  double sum = (vector - Start().vector).cwiseQuotient(Start().prior).squaredNorm();
  for (const LineResiduals& line : lines) {
    Eigen::VectorXd r(line.rows());
    line.Evaluate(rig, {r.data(), static_cast<std::size_t>(r.size())});
    const auto bend = static_cast<double>(line.rows());
    sum += robust ? 2.0 * bend * (std::sqrt(1.0 + r.squaredNorm() / bend) - 1.0) : r.squaredNorm();
  }
  return 0.5 * sum;
}

class Normal : public testing::TestWithParam<std::tuple<double, LineKind, bool>> {};

TEST_P(Normal, CostAndGradientAreThoseOfAllLines) {
  const auto [rpm, kind, robust] = GetParam();
  const FrequencyResponse data = Data(rpm);
  const WorkingGains gains = Stiffer();
  const auto lines = Lines(data, gains, kind);
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < Start().vector.size(); k += 3) free.push_back(k);
  const NormalCost cost(Start(), Start().vector, free, lines, robust, 2);
  Eigen::VectorXd at = Start().vector(free);
  for (Eigen::Index k = 0; k < at.size(); ++k) at[k] += 1e-3 * static_cast<double>(k % 5);
  const auto count = static_cast<Eigen::Index>(free.size());
  Eigen::VectorXd residuals(count + 1);
  RowMajor jacobian(count + 1, count);
  const double* parameters = at.data();
  double* jacobians = jacobian.data();
  ASSERT_TRUE(cost.Evaluate(&parameters, residuals.data(), &jacobians));
  const double expected = Cost(lines, cost.Whole(at.data()), robust);
  // Sums of squares in another order.
  EXPECT_NEAR(0.5 * residuals.squaredNorm(), expected, 1e-9 * expected);
  const Eigen::VectorXd gradient = jacobian.transpose() * residuals;
  for (Eigen::Index k = 0; k < count; ++k) {
    constexpr double kStep = 1e-6;
    Eigen::VectorXd above = at;
    Eigen::VectorXd below = at;
    above[k] += kStep;
    below[k] -= kStep;
    const double slope = (Cost(lines, cost.Whole(above.data()), robust) -
                          Cost(lines, cost.Whole(below.data()), robust)) /
                         (2.0 * kStep);
    // Rounding of the difference, 1e-16/1e-6 of the cost, and a curvature of up to 1e8.
    EXPECT_NEAR(gradient[k], slope, 1e-5 * std::abs(slope) + 1e-9 * expected + 1e-2)
        << Start().names[static_cast<std::size_t>(free[static_cast<std::size_t>(k)])];
  }
  // Without derivatives the cost is the same.
  ASSERT_TRUE(cost.Evaluate(&parameters, residuals.data(), nullptr));
  EXPECT_NEAR(0.5 * residuals.squaredNorm(), expected, 1e-9 * expected);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Normal,
                         testing::Combine(testing::Values(0.0, 3000.0),
                                          testing::Values(LineKind::kLogMagnitude,
                                                          LineKind::kComplex),
                                          testing::Bool()));

TEST(NormalCost, NumbersThatOverflowAreRefused) {
  const FrequencyResponse data = Data(0.0);
  const WorkingGains gains = Stiffer();
  const NormalCost cost(Start(), Start().vector, {0}, Lines(data, gains, LineKind::kComplex), false,
                        1);
  const double huge = -2e3;  // a rotor of no mass
  const double* parameters = &huge;
  std::array<double, 2> residuals{};
  EXPECT_FALSE(cost.Evaluate(&parameters, residuals.data(), nullptr));
}

TEST(ExperimentResponse, IsThatOfARigWithTheMagnetsOfTheExperiment) {
  const FrequencyResponse data = Data(3000.0);
  const WorkingGains gains = Stiffer();
  const ModalLayout& at = Start().frame.layout;
  const Physical rig = ToPhysical(Start().frame, Start().vector);
  for (std::size_t k = 0; k < data.frequency_hz.size(); k += 7) {
    const double f = data.frequency_hz[k];
    const Eigen::MatrixXcd response =
        ExperimentResponse(Start().frame, rig, f, data.speed_rad_per_s, gains, data.currents[k]);
    for (Eigen::Index j = 0; j < 4; ++j) {
      Eigen::VectorXd vector = Start().vector;
      vector.segment(at.ki, 4) += gains.ki.col(j).array().log().matrix();
      vector.segment(at.ks, 4) += gains.ks.col(j).array().log().matrix();
      const Eigen::MatrixXcd plant =
          ModalResponse(Start().frame, ToPhysical(Start().frame, vector), f, data.speed_rad_per_s);
      const Eigen::VectorXcd expected = plant * data.currents[k].col(j);
      // Two ways of solving one equation; its condition stays below 1e6 beside a resonance.
      EXPECT_LT((response.col(j) - expected).norm(), 1e-9 * expected.norm()) << f;
    }
  }
}

TEST(WorkingGains, AreTheMeansOfTheMagnetsSlopes) {
  // Current and position of an axis excited at 0.2 A about 0.05 A and 10 um, and at rest.
  FrequencyResponse data;
  data.channels = {"de_x", "de_y", "nde_x", "nde_y"};
  const double i0 = Start().frame.bias_current_a[0];
  const double s0 = Start().frame.gap_m[0];
  Random random(3);
  double ki = 0.0;
  double ks = 0.0;
  double ii = 0.0;
  double xx = 0.0;
  double ix = 0.0;
  constexpr int kSamples = 20'000;
  for (int n = 0; n < kSamples; ++n) {
    const double x = 1e-5 + 1.5e-5 * random.Normal();
    const double i = 0.05 + 0.2 * random.Normal() - 3e3 * (x - 1e-5);
    const double up = (i0 + i) / (s0 - x);
    const double down = (i0 - i) / (s0 + x);
    ki += 0.5 * s0 * s0 / i0 * (up / (s0 - x) + down / (s0 + x)) / kSamples;
    ks += 0.5 * std::pow(s0, 3) / (i0 * i0) * (up * up / (s0 - x) + down * down / (s0 + x)) /
          kSamples;
    ii += i * i / kSamples;
    xx += x * x / kSamples;
    ix += i * x / kSamples;
  }
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(4, 4);
  data.moments = {zero, zero, zero};
  data.moments.current_square_a2(0, 2) = ii;
  data.moments.position_square_m2(0, 2) = xx;
  data.moments.product_a_m(0, 2) = ix;
  const WorkingGains gains = WorkingGainsOf(Start().frame, data);
  // Terms of the fourth order: the square of a few per cent.
  EXPECT_NEAR(gains.ki(0, 2), ki, 2e-3);
  EXPECT_NEAR(gains.ks(0, 2), ks, 4e-3);
  EXPECT_GT(ks, 1.03);  // what is corrected is larger than what is left
  EXPECT_EQ(gains.ks(1, 2), 1.0);
}

}  // namespace
}  // namespace levitas::identification
