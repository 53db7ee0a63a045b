// The equations of balancing against the exact response of the sampled loop (discretised plant,
// analysis/sampled_loop.hpp), which shares no line with them.
#include "identification/balance/predictor.hpp"

#include <gtest/gtest.h>

#include <complex>

#include "analysis/loop_response.hpp"
#include "common/rotational_speed.hpp"
#include "common/two_pi.hpp"
#include "identification/balance/forecast.hpp"
#include "identification/balance/unbalance_fit.hpp"

namespace levitas::balancing {
namespace {

using Complex = std::complex<double>;
using Eigen::VectorXcd;
using Eigen::VectorXd;

const configuration::RigFile& FlexibleRotor() {
  static const configuration::RigFile rig =
      configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  return rig;
}

const configuration::ControllerFile& Controller() {
  static const configuration::ControllerFile file = configuration::LoadController(
      configuration::FindConfig("flexible_rotor_commissioned", "controllers"),
      FlexibleRotor().numbers);
  return file;
}

BalanceRig CentredRig() {
  return {FlexibleRotor(), {VectorXd::Zero(4), VectorXd::Zero(4), 1.0}, {0.1299, 0.2992, 0.3996}};
}

VectorXd Nominal(const BalanceRig& rig) {
  return VectorXd::Zero(static_cast<Eigen::Index>(rig.unknowns().size()));
}

VectorXcd Unbalance() {
  VectorXcd made(3);
  made << std::polar(6e-6, 0.4), std::polar(9e-6, 2.1), std::polar(4e-6, -1.7);
  return made;
}

/// A run of the linear loop in steady state at each speed, without noise.
std::vector<analysis::TrackedWindow> SteadyRun(const BalanceRig& rig, const VectorXcd& unbalance,
                                               const VectorXcd& runout_m) {
  std::vector<double> speeds;
  for (double rpm = 600.0; rpm <= 6000.0; rpm += 60.0) speeds.push_back(RpmToRadPerS(rpm));
  const auto law = FromController(Controller().law, rig.period_s());
  std::vector<analysis::TrackedWindow> made;
  for (const SpeedResponse& at : ResponsesOverSpeed(rig, Nominal(rig), law, speeds)) {
    analysis::TrackedWindow window;
    window.time_s = 10.0 * static_cast<double>(made.size());  // no neighbours: held speeds
    window.speed_rad_per_s = at.speed_rad_per_s;
    window.samples = 1000.0;
    window.position_m = at.per_unbalance * unbalance + at.per_runout * runout_m;
    window.current_a = -law(at.speed_rad_per_s) * window.position_m;
    made.push_back(std::move(window));
  }
  return made;
}

TEST(Forecast, SensitivityIsThatOfTheSampledLoop) {
  // Without gravity the loop's operating point is the centre, as the rig's here.
  configuration::RigFile quiet = FlexibleRotor();
  quiet.plant.gravity_m_per_s2 = 0.0;
  const BalanceRig rig = CentredRig();
  for (const double rpm : {900.0, 3000.0, 5400.0}) {
    const double speed = RpmToRadPerS(rpm);
    const auto ours = ResponsesOverSpeed(rig, Nominal(rig),
                                         FromController(Controller().law, rig.period_s()), {speed});
    const analysis::LoopResponse exact(analysis::CloseLoop(quiet.plant, Controller().law, speed));
    const Eigen::MatrixXcd theirs = exact.Sensitivity(speed / kTwoPi);
    // Images at the sampling rate: 1e-6 of the response at 100 Hz of 10 kHz.
    EXPECT_LT((ours[0].per_runout - theirs).norm(), 1e-4 * theirs.norm()) << rpm;
  }
}

TEST(Predictor, LeavesNothingOfARunThatItsModelMade) {
  const BalanceRig rig = CentredRig();
  VectorXcd runout(4);
  runout << 1e-6, Complex(0.0, -1e-6), Complex(5e-7, 5e-7), 0.0;
  const Predictor predictor(rig, {{SteadyRun(rig, Unbalance(), runout), VectorXcd::Zero(3)}});
  VectorXcd all(8);
  all << 1.0, Unbalance(), runout;
  for (const WindowEquations& one : predictor.At(Nominal(rig))) {
    // In standard deviations of the noise. Smoothing costs digits, so this is not zero to rounding.
    EXPECT_LT((one.linear * all).norm(), 1e-6);
  }
}

TEST(Predictor, SlopesAreThoseOfTheResidual) {
  const BalanceRig rig = CentredRig();
  const Predictor predictor(
      rig, {{SteadyRun(rig, Unbalance(), VectorXcd::Zero(4)), VectorXcd::Zero(3)}});
  VectorXcd amplitudes(7);
  amplitudes << Unbalance(), VectorXcd::Zero(4);
  VectorXcd all(8);
  all << 1.0, amplitudes;
  const auto at = predictor.At(Nominal(rig), amplitudes);
  for (std::size_t i = 0; i < rig.unknowns().size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const double step = 0.02 * rig.unknowns()[i].deviation;
    VectorXd more = Nominal(rig);
    VectorXd less = more;
    more[column] += step;
    less[column] -= step;
    const auto high = predictor.At(more);
    const auto low = predictor.At(less);
    double off = 0.0;
    double size = 0.0;
    for (std::size_t k = 0; k < at.size(); ++k) {
      const VectorXcd slope = (high[k].linear * all - low[k].linear * all) / (2.0 * step);
      off += (slope - at[k].slopes.col(column)).squaredNorm();
      size += slope.squaredNorm();
    }
    // Both are differences: of the matrices there, of the residual here.
    EXPECT_LT(off, 1e-4 * size + 1e-12) << NameOf(rig.unknowns()[i], FlexibleRotor().numbers);
  }
}

TEST(UnbalanceFit, FindsUnbalanceAndRunoutTogether) {
  const BalanceRig rig = CentredRig();
  VectorXcd runout(4);
  runout << 1e-6, Complex(0.0, -1e-6), Complex(5e-7, 5e-7), 0.0;
  Predictor predictor(rig, {{SteadyRun(rig, Unbalance(), runout), VectorXcd::Zero(3)}});
  const UnbalanceFit fit = FitUnbalance(predictor);
  // Each run-out is held by its tolerance, 1 um of an orbit of some 20 um, and the size of U by its
  // own: a tenth of a deviation of either is what the equations leave them.
  EXPECT_LT((fit.unbalance_kg_m - Unbalance()).norm(), 5e-3 * Unbalance().norm());
  EXPECT_LT((fit.runout_m - runout).norm(), 0.05e-6);
  EXPECT_TRUE(fit.converged);
}

TEST(UnbalanceFit, TakesWhatWasAddedBetweenTwoRunsIntoAccount) {
  const BalanceRig rig = CentredRig();
  VectorXcd added(3);
  added << 0.0, std::polar(5e-6, 1.0), 0.0;
  Predictor predictor(rig, {{SteadyRun(rig, Unbalance(), VectorXcd::Zero(4)), VectorXcd::Zero(3)},
                            {SteadyRun(rig, Unbalance() + added, VectorXcd::Zero(4)), added}});
  const UnbalanceFit fit = FitUnbalance(predictor);
  EXPECT_LT((fit.unbalance_kg_m - Unbalance()).norm(), 2e-3 * Unbalance().norm());
}

}  // namespace
}  // namespace levitas::balancing
