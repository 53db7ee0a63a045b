#include "design/synthesis/discretisation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "common/problem.hpp"
#include "numerics/dense/eigenvalues.hpp"
#include "numerics/dense/factorisations.hpp"
#include "plants.hpp"

namespace levitas::synthesis {
namespace {

constexpr double kPeriod = 1e-4;

TEST(Tustin, RespondsAsTheContinuousSystemAtTheWarpedFrequency) {
  Random random(31);
  StateSpace system = DrawStable(random, 6, 2, 3);
  system.A *= 2000.0;
  const SampledSystem sampled = Tustin(system, kPeriod);
  for (const double w : {0.0, 100.0, 3000.0, 20000.0}) {
    const double warped = 2.0 / kPeriod * std::tan(0.5 * w * kPeriod);
    const Eigen::MatrixXcd expected = Response(system, warped);
    EXPECT_LT((Response(sampled, w) - expected).norm(), 1e-10 * (1.0 + expected.norm()));
  }
  EXPECT_LT(sampled.matrices.A.eigenvalues().cwiseAbs().maxCoeff(), 1.0);
}

TEST(Tustin, RefusesAGrowingModeAsFastAsTheSampling) {
  EXPECT_THROW(static_cast<void>(Tustin(FirstOrder(1.0, 5.0, -2.0 / kPeriod), kPeriod)), Problem);
}

TEST(InverseTustin, UndoesTustinAndKeepsADelay) {
  Random random(33);
  StateSpace system = DrawStable(random, 5, 2, 2);
  system.A *= 1000.0;
  const StateSpace again = InverseTustin(Tustin(system, kPeriod));
  EXPECT_LT((Response(again, 700.0) - Response(system, 700.0)).norm(),
            1e-10 * (1.0 + Response(system, 700.0).norm()));
  // One period of delay, a pole at z = 0: e^{-jwT} at the warped frequency.
  SampledSystem delay{Gain(Eigen::MatrixXd::Zero(1, 1)), kPeriod};
  delay.matrices.A = Eigen::MatrixXd::Zero(1, 1);
  delay.matrices.B = delay.matrices.C = Eigen::MatrixXd::Ones(1, 1);
  const double w = 9000.0;
  const double warped = 2.0 / kPeriod * std::tan(0.5 * w * kPeriod);
  EXPECT_NEAR(std::arg(Response(InverseTustin(delay), warped)(0, 0)), -w * kPeriod, 1e-12);
}

TEST(ZeroOrderHold, OfAFirstOrderLagIsItsClosedForm) {
  const SampledSystem sampled = ZeroOrderHold(FirstOrder(3.0, 1e12, 700.0), kPeriod);
  const double decay = std::exp(-700.0 * kPeriod);
  EXPECT_NEAR(sampled.matrices.A(0, 0), decay, 1e-14);
  EXPECT_NEAR(sampled.matrices.B(0, 0) * sampled.matrices.C(0, 0), 3.0 * (1.0 - decay), 1e-8);
}

TEST(SamplingError, FallsWithThePeriod) {
  const StateSpace system = FirstOrder(3.0, 4e3, 700.0);
  const double slow = SamplingError(system, Tustin(system, 1e-3), 2000.0);
  const double fast = SamplingError(system, Tustin(system, 1e-4), 2000.0);
  EXPECT_GT(slow, 10.0 * fast);  // of second order in the period
  EXPECT_LT(fast, 0.01);
}

TEST(PadeDelay, HasTheGainOneAndThePhaseOfTheDelay) {
  constexpr double kDelay = 150e-6;
  for (int order = 1; order <= 4; ++order) {
    const StateSpace delay = PadeDelay(kDelay, order, 2);
    EXPECT_TRUE(IsStable(delay));
    for (const double angle : {0.01, 0.3, 1.0, 2.0}) {
      const Eigen::MatrixXcd response = Response(delay, angle / kDelay);
      EXPECT_NEAR(std::abs(response(1, 1)), 1.0, 1e-10);
      EXPECT_EQ(response(0, 1), 0.0);
      // First neglected term of the phase.
      const double n = order;
      const double allowed = std::pow(angle, 2 * order + 1) * std::pow(std::tgamma(n + 1.0), 2) /
                             (std::tgamma(2.0 * n + 1.0) * std::tgamma(2.0 * n + 2.0));
      EXPECT_NEAR(std::arg(response(1, 1)), -angle, allowed + 1e-9) << order << " " << angle;
    }
  }
}

TEST(ModalForm, AddsUpToTheSameResponse) {
  Random random(32);
  for (int trial = 0; trial < 5; ++trial) {
    const StateSpace system = DrawStable(random, 9, 3, 2);
    const ModalSystem modal = ModalForm(system);
    const double w = 5.0 * random.Uniform();
    const std::complex<double> s(0.0, w);
    Eigen::MatrixXcd sum = modal.D.cast<std::complex<double>>();
    Eigen::Index states = 0;
    for (const auto& part : modal.parts) {
      states += part.B.rows();
      Eigen::MatrixXcd shifted = s * Eigen::MatrixXcd::Identity(part.B.rows(), part.B.rows());
      shifted.diagonal().array() -= part.pole.real();
      if (part.B.rows() == 2) {
        shifted(0, 1) = -part.pole.imag();
        shifted(1, 0) = part.pole.imag();
      }
      sum += part.C * shifted.inverse() * part.B;
    }
    EXPECT_EQ(states, 9);
    EXPECT_LT((sum - Response(system, w)).norm(), 1e-9 * (1.0 + sum.norm()));
  }
}

TEST(ModalForm, RefusesARepeatedPoleThatIsAChain) {
  StateSpace chain = Series(FirstOrder(1.0, 1e9, 3.0), FirstOrder(1.0, 1e9, 3.0));
  EXPECT_THROW(static_cast<void>(ModalForm(chain)), Problem);
}

}  // namespace
}  // namespace levitas::synthesis
