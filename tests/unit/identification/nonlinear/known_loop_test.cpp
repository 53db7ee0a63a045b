// The known loop of a free run: sign, excitation, limit and rest of the law that closes it.
#include "identification/nonlinear/known_loop.hpp"

#include <gtest/gtest.h>

namespace levitas::identification {
namespace {

constexpr double kGain = 2e4;  // [A/m]

law::LawConfig Proportional(double limit_a) {
  law::AxisLawConfig axis;
  axis.kp_a_per_m = kGain;
  axis.derivative_hz = 1000.0;
  law::LawConfig law;
  law.axes = {axis, axis};
  law.current_limit_a = limit_a;
  return law;
}

RigNumbers TwoAxes(double bias_a, double most_a) {
  RigNumbers rig;
  rig.channels = {"x", "y"};
  rig.bias_current_a = bias_a;
  rig.max_coil_current_a = most_a;
  return rig;
}

Eigen::Vector2d Answer(const Feedback& feedback, Eigen::Index row, double x_m, double y_m) {
  Eigen::VectorXd current_a(2);
  feedback(row, Eigen::Vector2d(x_m, y_m), current_a);
  return current_a;
}

TEST(KnownLoop, AnswersAgainstTheReadingWithTheExcitationsOfTheRow) {
  LoopExcitation excitation{Eigen::MatrixXd::Zero(3, 2), Eigen::MatrixXd::Zero(3, 2)};
  excitation.position_m(1, 0) = 2e-6;
  excitation.current_a(2, 1) = 0.03;
  const KnownLoop loop(Proportional(0.0), TwoAxes(1.0, 3.0), excitation);
  const Feedback feedback = loop.AtRest();
  // u = -C (y + e_position) + e_current; coefficients of the sampled law round to 1e-11 A/m.
  EXPECT_LT((Answer(feedback, 0, 1e-6, -3e-6) - Eigen::Vector2d(-0.02, 0.06)).norm(), 1e-9);
  EXPECT_LT((Answer(feedback, 1, 1e-6, -3e-6) - Eigen::Vector2d(-0.06, 0.06)).norm(), 1e-9);
  EXPECT_LT((Answer(feedback, 2, 1e-6, -3e-6) - Eigen::Vector2d(-0.02, 0.09)).norm(), 1e-9);
}

struct Limits {
  double law_a, bias_a, most_a, expected_a;
};

class KnownLoopLimit : public testing::TestWithParam<Limits> {};

TEST_P(KnownLoopLimit, IsTheLeastOfLawAndWhatTheBiasLeavesToBothSides) {
  const auto [law_a, bias_a, most_a, expected_a] = GetParam();
  const KnownLoop loop(Proportional(law_a), TwoAxes(bias_a, most_a), {});
  const Eigen::Vector2d far = Answer(loop.AtRest(), 0, 1.0, -1.0);
  EXPECT_DOUBLE_EQ(far[0], -expected_a);
  EXPECT_DOUBLE_EQ(far[1], expected_a);
}

INSTANTIATE_TEST_SUITE_P(Cases, KnownLoopLimit,
                         testing::Values(Limits{0.0, 1.0, 3.0, 1.0},    // the bias: no coil below 0
                                         Limits{0.0, 2.0, 3.0, 1.0},    // the coils' largest
                                         Limits{0.4, 1.0, 3.0, 0.4},    // the law's own
                                         Limits{5.0, 1.0, 3.0, 1.0}));  // a law beyond the coils

TEST(KnownLoop, EveryRunBeginsWithTheLawAtRest) {
  law::LawConfig law = Proportional(0.0);
  for (law::AxisLawConfig& axis : law.axes) axis.ki_a_per_m_s = 1e6;
  const KnownLoop loop(law, TwoAxes(1.0, 3.0), {});
  const Feedback first = loop.AtRest();
  const Eigen::Vector2d begun = Answer(first, 0, 1e-6, 1e-6);
  const Eigen::Vector2d later = Answer(first, 1, 1e-6, 1e-6);
  EXPECT_LT(later[0], begun[0]);  // the integral has grown
  EXPECT_EQ(Answer(loop.AtRest(), 0, 1e-6, 1e-6), begun);
}

}  // namespace
}  // namespace levitas::identification
