#include "identification/modal/modal_line.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "common/two_pi.hpp"
#include "numerics/dense/factorisations.hpp"

namespace levitas::identification {
namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::VectorXcd;

Complex Hold(double f, double period_s) {
  const double x = std::numbers::pi * f * period_s;
  const double sinc = x == 0.0 ? 1.0 : std::sin(x) / x;
  return std::polar(sinc, -x);
}

void FillChain(ModalLine& line) {
  const double f = line.frequency_hz;
  const Index axes = line.axes();
  line.left.resize(axes);
  line.right.resize(axes);
  const double period_s = line.frame.period_s;
  const Complex late =
      Hold(f, period_s) * std::polar(1.0, -kTwoPi * f * line.rig.delay_samples * period_s);
  for (Index axis = 0; axis < axes; ++axis) {
    const Complex amplifier(1.0, f / line.rig.amplifier_hz[axis / 2]);
    const Complex sensor(1.0, f / line.rig.sensor_hz[axis / 2]);
    line.right[axis] = line.rig.ki_n_per_a[axis] * late / amplifier;
    line.left[axis] = line.rig.gain[axis] / sensor;
  }
}

/// What each mode by itself answers with.
VectorXcd Receptances(const ModalLine& line) {
  const auto w = line.rig.frequency_rad_per_s.array();
  return (line.s * line.s + 2.0 * line.s * (line.rig.damping_ratio.array() * w).cast<Complex>() +
          w.square().cast<Complex>())
      .inverse()
      .matrix();
}

/// Shapes of all axes in both planes.
MatrixXcd BothPlanes(const Eigen::MatrixXd& shapes) {
  const Index n = shapes.rows();
  MatrixXcd both = MatrixXcd::Zero(2 * n, 2 * shapes.cols());
  for (Index axis = 0; axis < both.cols(); ++axis) {
    both.col(axis).segment(axis % 2 * n, n) = shapes.col(axis / 2).cast<Complex>();
  }
  return both;
}

void SolveStanding(ModalLine& line) {
  const VectorXcd receptance = Receptances(line).replicate(2, 1);
  line.free_x = receptance.asDiagonal() * line.actuator;
  line.free_y = line.free_x;
  line.free_z = receptance.asDiagonal() * line.sensor;
}

void SolveSpinning(ModalLine& line, bool derive) {
  const Index n = line.modes();
  MatrixXcd d = MatrixXcd::Zero(2 * n, 2 * n);
  d.diagonal() = Receptances(line).cwiseInverse().replicate(2, 1);
  const Complex factor = line.s * line.speed_rad_per_s;
  d.topRightCorner(n, n) = factor * line.rig.gyroscopic;
  d.bottomLeftCorner(n, n) = -factor * line.rig.gyroscopic;
  const Eigen::PartialPivLU<MatrixXcd> lu(d);
  line.free_x = lu.solve(line.actuator);
  if (!derive) return;
  line.free_y = lu.transpose().solve(line.actuator);
  line.free_z = lu.transpose().solve(line.sensor);
}

/// Undamped: no resonance of theirs is near.
MatrixXcd BeyondTheBand(const ModalLine& line) {
  const ModesBeyond& beyond = line.frame.beyond;
  if (beyond.frequency_rad_per_s.size() == 0) return MatrixXcd::Zero(line.axes(), line.axes());
  const VectorXcd compliance =
      (beyond.frequency_rad_per_s.array().square().cast<Complex>() + line.s * line.s).inverse();
  return BothPlanes(beyond.sensor).transpose() * compliance.replicate(2, 1).asDiagonal() *
         BothPlanes(beyond.actuator);
}

}  // namespace

ModalLine SolveFree(const ModalFrame& frame, const Physical& rig, double frequency_hz,
                    double speed_rad_per_s, bool derive) {
  ModalLine line{frame,
                 rig,
                 frequency_hz,
                 speed_rad_per_s,
                 Complex(0.0, kTwoPi * frequency_hz),
                 {},
                 {},
                 {},
                 {},
                 {},
                 {},
                 {},
                 {},
                 {}};
  FillChain(line);
  line.actuator = BothPlanes(rig.actuator);
  line.sensor = BothPlanes(rig.sensor);
  if (speed_rad_per_s == 0.0) {
    SolveStanding(line);
  } else {
    SolveSpinning(line, derive);
  }
  line.at_magnets = line.actuator.transpose() * line.free_x;
  line.beyond = BeyondTheBand(line);
  return line;
}

ClosedLine AddMagnets(const ModalLine& line, const Eigen::VectorXd& ks, bool derive) {
  const Index axes = line.axes();
  const VectorXcd stiffness = ks.cast<Complex>();
  const MatrixXcd one = MatrixXcd::Identity(axes, axes);
  const MatrixXcd loop = one - stiffness.asDiagonal() * line.at_magnets;
  ClosedLine closed;
  closed.x = line.free_x * loop.inverse();
  closed.reading = line.left.asDiagonal() * (line.sensor.transpose() * closed.x + line.beyond);
  if (!derive) return closed;
  const MatrixXcd turned = one - stiffness.asDiagonal() * line.at_magnets.transpose();
  closed.z = line.free_z +
             line.free_y * turned.partialPivLu().solve(stiffness.asDiagonal() *
                                                       (line.actuator.transpose() * line.free_z));
  return closed;
}

}  // namespace levitas::identification
