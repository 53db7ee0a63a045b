#include "identification/modal/modal_response.hpp"

#include <cmath>
#include <complex>

#include "common/two_pi.hpp"
#include "identification/modal/modal_line.hpp"

namespace levitas::identification {
namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::VectorXcd;

/// Derivatives of R = left (Phi_s^T X + beyond) F for some inputs with the forces F at the axes:
/// columns of the derivative, entry (i, j) at row first + i + axes j.
class Columns {
 public:
  Columns(const ModalLine& line, const ClosedLine& closed, const Eigen::VectorXd& ks,
          const MatrixXcd& force, Index first, ResponseDerivative& to)
      : axes_(line.axes()),
        modes_(line.modes()),
        inputs_(force.cols()),
        first_(first),
        to_(to),
        left_(line.left),
        ks_(ks),
        reading_(closed.reading),
        force_(force),
        response_(closed.reading * force),
        z_(closed.z * line.left.asDiagonal()),
        x_(closed.x * force) {
    const VectorXcd stiffness = ks.cast<Complex>();
    pushed_ = stiffness.asDiagonal() * (line.actuator.transpose() * x_);
    felt_ = stiffness.asDiagonal() * (line.actuator.transpose() * z_);
    // The force of an input, and of the magnet that its motion excites.
    driven_ = pushed_ + force_;
  }

  /// dR += factor z_k x_l^T.
  void AddModes(Index column, Index k, Index l, Complex factor) {
    AddOuter(column, z_.row(k).data(), x_.row(l).data(), factor);
  }
  void AddStiffness(Index column, Index axis) {
    AddOuter(column, felt_.row(axis).data(), pushed_.row(axis).data(), 1.0 / ks_[axis]);
  }
  /// By ln of the force of one axis (ln of the factor of one reading), of all forces together.
  void AddForce(Index column, Index axis, Complex factor) {
    for (Index j = 0; j < inputs_; ++j) {
      Block(column, j) += factor * force_(axis, j) * reading_.col(axis);
    }
  }
  void AddOutput(Index column, Index output, Complex factor) {
    for (Index j = 0; j < inputs_; ++j) Block(column, j)[output] += factor * response_(output, j);
  }
  void AddAllForces(Index column, Complex factor) {
    for (Index j = 0; j < inputs_; ++j) Block(column, j) += factor * response_.col(j);
  }
  /// By the deflection of `mode` at an actuator (sensor) plane, times `factor`: both planes.
  void AddActuatorShape(Index column, Index mode, Index bearing, double factor) {
    for (Index plane = 0; plane < 2; ++plane) {
      const Index axis = 2 * bearing + plane;
      const Index row = plane * modes_ + mode;
      AddOuter(column, z_.row(row).data(), driven_.row(axis).data(), factor);
      AddOuter(column, felt_.row(axis).data(), x_.row(row).data(), factor);
    }
  }
  void AddSensorShape(Index column, Index mode, Index bearing, double factor) {
    for (Index plane = 0; plane < 2; ++plane) {
      const Index axis = 2 * bearing + plane;
      const Complex* x = x_.row(plane * modes_ + mode).data();
      for (Index j = 0; j < inputs_; ++j) Block(column, j)[axis] += factor * left_[axis] * x[j];
    }
  }

 private:
  [[nodiscard]] Eigen::VectorBlock<ResponseDerivative::ColXpr> Block(Index column, Index input) {
    return to_.col(column).segment(first_ + axes_ * input, axes_);
  }
  /// In real numbers: complex ones test every product for what is no number.
  void AddOuter(Index column, const Complex* z, const Complex* x, Complex factor) {
    Complex* out = to_.col(column).data() + first_;
    for (Index j = 0; j < inputs_; ++j) {
      const double re = factor.real() * x[j].real() - factor.imag() * x[j].imag();
      const double im = factor.real() * x[j].imag() + factor.imag() * x[j].real();
      if (re == 0.0 && im == 0.0) continue;  // standing: the other plane
      for (Index i = 0; i < axes_; ++i) {
        Complex& entry = out[i + axes_ * j];
        entry = {entry.real() + z[i].real() * re - z[i].imag() * im,
                 entry.imag() + z[i].real() * im + z[i].imag() * re};
      }
    }
  }

  Index axes_, modes_, inputs_, first_;
  ResponseDerivative& to_;
  VectorXcd left_;
  Eigen::VectorXd ks_;
  MatrixXcd reading_, force_, response_;
  ComplexRows z_, x_;
  ComplexRows pushed_, felt_;  ///< ks times the deflection at each actuator, by input and by output
  ComplexRows driven_;
};

void DeriveRotor(const ModalLine& line, Columns& columns) {
  const ModalLayout& at = line.frame.layout;
  const Physical& rig = line.rig;
  const double tilt = 1.0 / std::sqrt(rig.inertia_kg_m2);
  for (Index b = 0; b < at.bearings; ++b) {
    columns.AddActuatorShape(at.mass, 0, b, -0.5 * rig.actuator(0, b));
    columns.AddSensorShape(at.mass, 0, b, -0.5 * rig.sensor(0, b));
    columns.AddActuatorShape(at.inertia, 1, b, -0.5 * rig.actuator(1, b));
    columns.AddSensorShape(at.inertia, 1, b, -0.5 * rig.sensor(1, b));
    columns.AddActuatorShape(at.centre, 1, b, -0.1 * tilt);
    columns.AddSensorShape(at.centre, 1, b, -0.1 * tilt);
  }
  const double scale = 1.0 / std::sqrt(line.frame.nominal_mass_kg);
  for (Index i = 0; i < at.bending; ++i) {
    const Index mode = 2 + i;
    const double w = rig.frequency_rad_per_s[mode];
    const double z = rig.damping_ratio[mode];
    for (Index row = mode; row < 2 * line.modes(); row += line.modes()) {
      columns.AddModes(at.frequency + i, row, row, -(2.0 * w * w + 2.0 * z * w * line.s));
      columns.AddModes(at.damping + i, row, row, -(2.0 * z * w * line.s));
    }
    for (Index b = 0; b < at.bearings; ++b) {
      columns.AddActuatorShape(at.shape_at(i, b), mode, b, scale);
      columns.AddSensorShape(at.shape_at(i, at.bearings + b), mode, b, scale);
    }
  }
}

void DeriveGyroscopic(const ModalLine& line, Columns& columns) {
  const ModalLayout& at = line.frame.layout;
  const Index n = line.modes();
  const Complex factor = line.s * line.speed_rad_per_s;
  for (Index i = 0; i <= at.bending; ++i) {
    for (Index j = 0; j <= at.bending; ++j) {
      const Index column = at.gyroscopic_at(i, j);
      // D has +sWG at (x, y) and -sWG at (y, x); dP = -Z^T dD X. Entries i, j and j, i add up.
      columns.AddModes(column, 1 + i, n + 1 + j, -factor);
      columns.AddModes(column, n + 1 + i, 1 + j, factor);
    }
  }
}

void DeriveChain(const ModalLine& line, Columns& columns) {
  const ModalLayout& at = line.frame.layout;
  const double f = line.frequency_hz;
  columns.AddAllForces(at.delay, Complex(0.0, -kTwoPi * f * line.frame.period_s));
  for (Index axis = 0; axis < line.axes(); ++axis) {
    columns.AddForce(at.ki + axis, axis, 1.0);
    columns.AddOutput(at.gain + axis, axis, 1.0);
    columns.AddStiffness(at.ks + axis, axis);
    // d ln(1/(1 + jf/fa)) / d ln fa = (jf/fa) / (1 + jf/fa).
    const auto lag = [f](double corner_hz) {
      const Complex ratio(0.0, f / corner_hz);
      return ratio / (1.0 + ratio);
    };
    columns.AddForce(at.amplifier + axis / 2, axis, lag(line.rig.amplifier_hz[axis / 2]));
    columns.AddOutput(at.sensor + axis / 2, axis, lag(line.rig.sensor_hz[axis / 2]));
  }
}

/// Response to `force`; with `derivative` its columns from row `first` on.
MatrixXcd Respond(const ModalLine& line, const Eigen::VectorXd& ks, const MatrixXcd& force,
                  Index first, ResponseDerivative* derivative) {
  const ClosedLine closed = AddMagnets(line, ks, derivative != nullptr);
  if (derivative != nullptr) {
    Columns columns(line, closed, ks, force, first, *derivative);
    DeriveRotor(line, columns);
    if (line.speed_rad_per_s != 0.0) DeriveGyroscopic(line, columns);
    DeriveChain(line, columns);
  }
  return closed.reading * force;
}

}  // namespace

MatrixXcd ModalResponse(const ModalFrame& frame, const Physical& rig, double frequency_hz,
                        double speed_rad_per_s, ResponseDerivative* derivative) {
  const ModalLine line =
      SolveFree(frame, rig, frequency_hz, speed_rad_per_s, derivative != nullptr);
  if (derivative != nullptr) {
    derivative->setZero(line.axes() * line.axes(), frame.layout.size);
  }
  return Respond(line, rig.ks_n_per_m, line.right.asDiagonal(), 0, derivative);
}

MatrixXcd ExperimentResponse(const ModalFrame& frame, const Physical& rig, double frequency_hz,
                             double speed_rad_per_s, const WorkingGains& gains,
                             const MatrixXcd& sensitivity, ResponseDerivative* derivative) {
  const ModalLine line =
      SolveFree(frame, rig, frequency_hz, speed_rad_per_s, derivative != nullptr);
  const Index axes = line.axes();
  if (derivative != nullptr) derivative->setZero(axes * axes, frame.layout.size);
  MatrixXcd response(axes, axes);
  for (Index j = 0; j < axes; ++j) {
    const Eigen::VectorXd ks = rig.ks_n_per_m.cwiseProduct(gains.ks.col(j));
    const VectorXcd force =
        line.right.cwiseProduct(gains.ki.col(j).cast<Complex>()).cwiseProduct(sensitivity.col(j));
    response.col(j) = Respond(line, ks, force, axes * j, derivative);
  }
  return response;
}

}  // namespace levitas::identification
