#include "plants.hpp"

#include <Eigen/Dense>
#include <array>
#include <numbers>

#include "common/problem.hpp"
#include "design/synthesis/hinf_synthesis.hpp"
#include "numerics/dense/eigenvalues.hpp"

namespace levitas::synthesis {

Eigen::MatrixXd DrawMatrix(Random& random, Eigen::Index rows, Eigen::Index columns) {
  Eigen::MatrixXd out(rows, columns);
  for (double& value : out.reshaped()) value = random.Normal();
  return out;
}

StateSpace DrawStable(Random& random, Eigen::Index states, Eigen::Index inputs,
                      Eigen::Index outputs) {
  StateSpace out{DrawMatrix(random, states, states), DrawMatrix(random, states, inputs),
                 DrawMatrix(random, outputs, states), DrawMatrix(random, outputs, inputs)};
  const double worst = out.A.eigenvalues().real().maxCoeff();
  out.A.diagonal().array() -= worst + 0.1;
  return out;
}

GeneralisedPlant DrawPlant(Random& random, Eigen::Index states) {
  // Two disturbances more than measurements, two errors more than controls.
  return {{DrawMatrix(random, states, states), DrawMatrix(random, states, 6),
           DrawMatrix(random, 6, states), DrawMatrix(random, 6, 6)},
          2,
          2};
}

StateSpace FirstOrder(double gain, double zero, double pole) {
  // gain (s/zero + 1)/(s/pole + 1) = direct + rest pole/(s + pole)
  const double direct = gain * pole / zero;
  StateSpace out = Gain(Eigen::MatrixXd::Constant(1, 1, direct));
  out.A = Eigen::MatrixXd::Constant(1, 1, -pole);
  out.B = Eigen::MatrixXd::Constant(1, 1, pole);
  out.C = Eigen::MatrixXd::Constant(1, 1, gain - direct);
  return out;
}

std::string RefusalOf(const GeneralisedPlant& plant) {
  try {
    static_cast<void>(Synthesise(plant));
  } catch (const Problem& problem) {
    return problem.what();
  }
  return "";
}

GeneralisedPlant ScalarPlant(double a) {
  GeneralisedPlant out;
  StateSpace& system = out.system;
  system.A = Eigen::MatrixXd::Constant(1, 1, a);
  system.B = Eigen::RowVector3d(1.0, 0.0, 1.0);
  system.C = Eigen::Vector3d(1.0, 0.0, 1.0);
  system.D = Eigen::Matrix3d::Zero();
  system.D(1, 2) = 1.0;
  system.D(2, 1) = 1.0;
  out.controls = 1;
  out.measurements = 1;
  return out;
}

GeneralisedPlant SensitivityPlant(const StateSpace& plant, const StateSpace& weight) {
  const Eigen::RowVector2d add(1.0, 1.0);
  const StateSpace y = Series(Append(Gain(Eigen::MatrixXd::Ones(1, 1)), plant), Gain(add));
  const StateSpace twice = Series(y, Gain(Eigen::Vector2d(1.0, 1.0)));
  return {Series(twice, Append(weight, Gain(Eigen::MatrixXd::Ones(1, 1)))), 1, 1};
}

namespace {

StateSpace Mode(double w2, double damping, double gain) {
  StateSpace out = Gain(Eigen::MatrixXd::Zero(1, 1));
  out.A = Eigen::Matrix2d{{0.0, 1.0}, {-w2, -damping}};
  out.B = Eigen::Vector2d(0.0, gain);
  out.C = Eigen::RowVector2d(1.0, 0.0);
  return out;
}

}  // namespace

GeneralisedPlant FlexibleAxis() {
  // Published modes of the flexible rotor; participations alternate in sign, the sensor not being
  // at the actuator. 40 N/A on 0.78 kg, 36 um as the unit of position.
  constexpr std::array kModesHz{90.0, 252.0, 510.0, 730.0};
  constexpr std::array kShare{0.8, 0.5, -0.4, 0.3};
  constexpr double kGain = 40.0 / 0.78 / 36e-6;
  constexpr double kTurn = 2.0 * std::numbers::pi;
  StateSpace modes = Mode(-kTurn * kTurn * 33.0 * 33.0, 0.0, kGain);
  for (std::size_t i = 0; i < kModesHz.size(); ++i) {
    const double w = kTurn * kModesHz[i];
    modes = Append(modes, Mode(w * w, 2.0 * 0.003 * w, kShare[i] * kGain));
  }
  modes.B = modes.B.rowwise().sum().eval();
  modes.C = modes.C.colwise().sum().eval();
  modes.D = Eigen::MatrixXd::Zero(1, 1);
  const double amplifier = kTurn * 720.0;
  StateSpace current = Mode(0.0, 0.0, 0.0);
  current.A = Eigen::MatrixXd::Constant(1, 1, -amplifier);
  current.B = Eigen::MatrixXd::Constant(1, 1, amplifier);
  current.C = Eigen::MatrixXd::Ones(1, 1);
  // Pade (2, 2): (s^2 - 6/T s + 12/T^2)/(s^2 + 6/T s + 12/T^2) = 1 - (12/T s)/(...)
  constexpr double kDelay = 150e-6;
  StateSpace delay = Mode(12.0 / (kDelay * kDelay), 6.0 / kDelay, 1.0);
  delay.C = Eigen::RowVector2d(0.0, -12.0 / kDelay);
  delay.D = Eigen::MatrixXd::Ones(1, 1);
  const StateSpace axis = Series(Series(delay, current), modes);
  // Inputs d, noise, u; outputs u, position, y = position + noise.
  Eigen::MatrixXd in(3, 3);
  in << 0.0, 0.0, 1.0, 0.3, 0.0, 1.0, 0.0, 1.0 / 36.0, 0.0;  // u; axis input; noise
  StateSpace middle =
      Append(Append(Gain(Eigen::MatrixXd::Ones(1, 1)), axis), Gain(Eigen::MatrixXd::Ones(1, 1)));
  Eigen::MatrixXd out(3, 3);
  out << 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0;
  return {Series(Series(Gain(in), middle), Gain(out)), 1, 1};
}

}  // namespace levitas::synthesis
