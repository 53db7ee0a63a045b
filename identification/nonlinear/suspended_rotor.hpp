#pragma once
// A rotor in its magnets, standing, as a block model that runs free in the loop of known
// controllers: curve of current and position, linear rotor, curve of the sensor.
//
// Equation  i' = (u - i)/tau, u the command of `delay` samples ago, tau = 1/(2 pi bandwidth);
//           h = (i0/4) [ (1+r) f+^2/(1-x/s)^2 - (1-r) f-^2/(1+x/s)^2 ] + offset   [A]
//           f+- = f((i0 +- i)/i0),  f(c) = c + (c-1) [a_1 + a_2 (c-1) + ..]
//           per axis: the force of two opposed coils over its ki, each coil's flux a curve f of its
//           current (iron that saturates) over its gap s -+ x, r what one coil is stronger. The
//           force depends on current and position together, which a curve of the current alone
//           cannot say.
//           eta_r'' + 2 z_r w_r eta_r' + w_r^2 eta_r = sum_b in_rb h_b,  x_b = sum_r out_rb eta_r
//           per plane, w = 0 for a rigid mode; y = sensor(x), known.
// Steps     the rotor's transition over a sample is exact for a constant force; the force is that
//           of the sample's mean current and of the position half a sample on.
// Not done  rotation (planes are coupled then), sensors away from the magnets, fractions of a
//           sample of delay.
// Thread    that of its owner. Failure: a run beyond kDivergedM is cut there.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "identification/nonlinear/hammerstein_wiener.hpp"

namespace levitas::identification {

struct RotorMode {
  double frequency_hz{}, damping_ratio{};  ///< 0: rigid
  Eigen::VectorXd out;                     ///< displacement per eta, per bearing
  Eigen::VectorXd in;                      ///< eta'' per ampere of h, per bearing
};

struct AxisForce {
  double amplifier_hz{};
  double bias_a{};       ///< i0, known: the unit of the curve's current
  double gap_m{};        ///< s
  double offset_a{};     ///< a constant force
  double imbalance{};    ///< r
  Eigen::VectorXd iron;  ///< a_1, a_2, ..

  /// h of a coil current and a displacement [A].
  [[nodiscard]] double At(double current_a, double x_m) const noexcept;
};

struct SuspendedRotor {
  double period_s{};
  Eigen::Index delay{1};  ///< [samples] from a reading to the command it leads to
  std::array<std::vector<RotorMode>, 2> plane;  ///< x, y
  std::vector<AxisForce> axis;                  ///< x, y of the first bearing, of the second, ..
  std::vector<SensorCharacteristic> sensor;     ///< per axis

  [[nodiscard]] Eigen::Index axes() const noexcept {
    return static_cast<Eigen::Index>(axis.size());
  }
};

/// Free run of `rows` samples from rest in the centre; `feedback` gives the commands.
[[nodiscard]] Prediction RunFree(const SuspendedRotor& model, Eigen::Index rows,
                                 const Feedback& feedback);

}  // namespace levitas::identification
