#include "identification/modal/modal_response.hpp"

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <numbers>

namespace levitas::identification {
namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::VectorXcd;

constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// Everything at one frequency that value and derivatives share. Columns of X, Z run over the axes.
struct Line {
  const ModalFrame& frame;
  const Physical& rig;
  Complex s;
  double speed_rad_per_s;
  VectorXcd left, right;  ///< per axis: g hs and ki ha
  MatrixXcd X, Z;         ///< 2 modes x axes
  MatrixXcd ax, za;       ///< (a, i) = a_a^T X_i and (i, a) = Z_i^T a_a: deflection at actuators

  [[nodiscard]] Index modes() const { return frame.layout.modes(); }
  [[nodiscard]] Index axes() const { return frame.layout.axes(); }
};

Complex Hold(double f, double period_s) {
  const double x = std::numbers::pi * f * period_s;
  const double sinc = x == 0.0 ? 1.0 : std::sin(x) / x;
  return std::polar(sinc, -x);
}

void FillChain(Line& line, double f) {
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

MatrixXcd PlaneMatrix(const Line& line, Index plane) {
  const Physical& rig = line.rig;
  const auto w = rig.frequency_rad_per_s.array();
  MatrixXcd d = MatrixXcd::Zero(line.modes(), line.modes());
  d.diagonal() = (line.s * line.s + 2.0 * line.s * (rig.damping_ratio.array() * w).cast<Complex>() +
                  w.square().cast<Complex>())
                     .matrix();
  for (Index b = 0; b < line.frame.layout.bearings; ++b) {
    d -= (rig.ks_n_per_m[2 * b + plane] * rig.actuator.col(b) * rig.actuator.col(b).transpose())
             .cast<Complex>();
  }
  return d;
}

/// Shapes of all axes in both planes: 2 modes x axes.
MatrixXcd BothPlanes(const Eigen::MatrixXd& shapes) {
  const Index n = shapes.rows();
  MatrixXcd both = MatrixXcd::Zero(2 * n, 2 * shapes.cols());
  for (Index axis = 0; axis < both.cols(); ++axis) {
    both.col(axis).segment(axis % 2 * n, n) = shapes.col(axis / 2).cast<Complex>();
  }
  return both;
}

void Solve(Line& line) {
  const Index n = line.modes();
  const MatrixXcd actuator = BothPlanes(line.rig.actuator);
  const MatrixXcd sensor = BothPlanes(line.rig.sensor);
  if (line.speed_rad_per_s == 0.0) {
    line.X.resize(2 * n, line.axes());
    line.Z.resize(2 * n, line.axes());
    for (Index plane = 0; plane < 2; ++plane) {
      const Eigen::PartialPivLU<MatrixXcd> lu(PlaneMatrix(line, plane));  // symmetric
      line.X.middleRows(plane * n, n) = lu.solve(actuator.middleRows(plane * n, n));
      line.Z.middleRows(plane * n, n) = lu.solve(sensor.middleRows(plane * n, n));
    }
  } else {
    MatrixXcd d(2 * n, 2 * n);
    const MatrixXcd coupling = (line.s * line.speed_rad_per_s) * line.rig.gyroscopic;
    d << PlaneMatrix(line, 0), coupling, -coupling, PlaneMatrix(line, 1);
    const Eigen::PartialPivLU<MatrixXcd> lu(d);
    line.X = lu.solve(actuator);
    // Turning the other way transposes D.
    d.topRightCorner(n, n) = -coupling;
    d.bottomLeftCorner(n, n) = coupling;
    line.Z = d.partialPivLu().solve(sensor);
  }
  line.ax = actuator.transpose() * line.X;
  line.za = line.Z.transpose() * actuator;
}

/// Writes columns of the derivative: entry (i, j) of each 4 x 4 matrix at row i + axes j.
class Columns {
 public:
  Columns(const Line& line, ResponseDerivative& to) : line_(line), to_(to) {}

  /// dP_ij += left_i right_j z_i x_j, an outer product.
  template <class Z, class X>
  void AddOuter(Index column, const Z& z, const X& x, Complex factor) {
    for (Index j = 0; j < line_.axes(); ++j) {
      const Complex xj = factor * line_.right[j] * x[j];
      for (Index i = 0; i < line_.axes(); ++i) {
        to_(i + line_.axes() * j, column) += line_.left[i] * z[i] * xj;
      }
    }
  }
  /// d/d ln of the factor of one input (or output): that column (row) of P itself.
  void AddInput(Index column, const MatrixXcd& plant, Index input, Complex factor) {
    for (Index i = 0; i < line_.axes(); ++i) {
      to_(i + line_.axes() * input, column) += factor * plant(i, input);
    }
  }
  void AddOutput(Index column, const MatrixXcd& plant, Index output, Complex factor) {
    for (Index j = 0; j < line_.axes(); ++j) {
      to_(output + line_.axes() * j, column) += factor * plant(output, j);
    }
  }

  /// By the deflection of `mode` at an actuator (sensor) plane, times `factor`: both planes.
  void AddActuatorShape(Index column, Index mode, Index bearing, double factor) {
    for (Index plane = 0; plane < 2; ++plane) {
      const Index axis = 2 * bearing + plane;
      const Index row = plane * line_.modes() + mode;
      const auto z = line_.Z.row(row);
      const Complex ks = factor * line_.rig.ks_n_per_m[axis];
      AddOuter(column, z, line_.ax.row(axis), ks);
      AddOuter(column, line_.za.col(axis), line_.X.row(row), ks);
      for (Index i = 0; i < line_.axes(); ++i) {
        to_(i + line_.axes() * axis, column) += factor * line_.left[i] * z[i] * line_.right[axis];
      }
    }
  }
  void AddSensorShape(Index column, Index mode, Index bearing, double factor) {
    for (Index plane = 0; plane < 2; ++plane) {
      const Index axis = 2 * bearing + plane;
      const auto x = line_.X.row(plane * line_.modes() + mode);
      for (Index j = 0; j < line_.axes(); ++j) {
        to_(axis + line_.axes() * j, column) += factor * line_.left[axis] * x[j] * line_.right[j];
      }
    }
  }

 private:
  const Line& line_;
  ResponseDerivative& to_;
};

void DeriveRotor(const Line& line, Columns& columns) {
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
    for (Index plane = 0; plane < 2; ++plane) {
      const auto left = line.Z.row(plane * line.modes() + mode);
      const auto right = line.X.row(plane * line.modes() + mode);
      columns.AddOuter(at.frequency + i, left, right, -(2.0 * w * w + 2.0 * z * w * line.s));
      columns.AddOuter(at.damping + i, left, right, -(2.0 * z * w * line.s));
    }
    for (Index b = 0; b < at.bearings; ++b) {
      columns.AddActuatorShape(at.shape_at(i, b), mode, b, scale);
      columns.AddSensorShape(at.shape_at(i, at.bearings + b), mode, b, scale);
    }
  }
}

void DeriveGyroscopic(const Line& line, Columns& columns) {
  const ModalLayout& at = line.frame.layout;
  const Index n = line.modes();
  const Complex factor = line.s * line.speed_rad_per_s;
  for (Index i = 0; i <= at.bending; ++i) {
    for (Index j = 0; j <= at.bending; ++j) {
      const Index column = at.gyroscopic_at(i, j);
      // D has +sWG at (x, y) and -sWG at (y, x); dP = -Z^T dD X. Entries i, j and j, i add up.
      columns.AddOuter(column, line.Z.row(1 + i), line.X.row(n + 1 + j), -factor);
      columns.AddOuter(column, line.Z.row(n + 1 + i), line.X.row(1 + j), factor);
    }
  }
}

void DeriveChain(const Line& line, const MatrixXcd& plant, double f, Columns& columns) {
  const ModalLayout& at = line.frame.layout;
  for (Index axis = 0; axis < line.axes(); ++axis) {
    columns.AddInput(at.ki + axis, plant, axis, 1.0);
    columns.AddOutput(at.gain + axis, plant, axis, 1.0);
    columns.AddOuter(at.ks + axis, line.za.col(axis), line.ax.row(axis), line.rig.ks_n_per_m[axis]);
    columns.AddInput(at.delay, plant, axis, Complex(0.0, -kTwoPi * f * line.frame.period_s));
    // d ln(1/(1 + jf/fa)) / d ln fa = (jf/fa) / (1 + jf/fa).
    const auto lag = [f](double corner_hz) {
      const Complex ratio(0.0, f / corner_hz);
      return ratio / (1.0 + ratio);
    };
    columns.AddInput(at.amplifier + axis / 2, plant, axis, lag(line.rig.amplifier_hz[axis / 2]));
    columns.AddOutput(at.sensor + axis / 2, plant, axis, lag(line.rig.sensor_hz[axis / 2]));
  }
}

/// Reading per force of the modes beyond the fitted ones, undamped: no resonance of theirs is near.
MatrixXcd BeyondTheBand(const Line& line) {
  const ModesBeyond& beyond = line.frame.beyond;
  const Eigen::VectorXcd compliance =
      (beyond.frequency_rad_per_s.array().square().cast<Complex>() + line.s * line.s).inverse();
  return BothPlanes(beyond.sensor).transpose() * compliance.replicate(2, 1).asDiagonal() *
         BothPlanes(beyond.actuator);
}

}  // namespace

MatrixXcd ModalResponse(const ModalFrame& frame, const Physical& rig, double frequency_hz,
                        double speed_rad_per_s, ResponseDerivative* derivative) {
  Line line{frame, rig, Complex(0.0, kTwoPi * frequency_hz), speed_rad_per_s, {}, {}, {}, {},
            {},    {}};
  FillChain(line, frequency_hz);
  Solve(line);
  const MatrixXcd sensor = BothPlanes(rig.sensor);
  MatrixXcd force_to_reading = sensor.transpose() * line.X;
  if (frame.beyond.frequency_rad_per_s.size() > 0) force_to_reading += BeyondTheBand(line);
  MatrixXcd plant = line.left.asDiagonal() * force_to_reading * line.right.asDiagonal();
  if (derivative != nullptr) {
    derivative->setZero(line.axes() * line.axes(), frame.layout.size);
    Columns columns(line, *derivative);
    DeriveRotor(line, columns);
    if (speed_rad_per_s != 0.0) DeriveGyroscopic(line, columns);
    DeriveChain(line, plant, frequency_hz, columns);
  }
  return plant;
}

}  // namespace levitas::identification
