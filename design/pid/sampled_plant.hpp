#pragma once
// A rig at one speed as the sampled law meets it, by its modes: cheap at any z.
//
// Equation  P(z) = z^-k sum_i c_i b_i (p1 + p2 z^-1) / (z - e^{l_i T}), l_i, b_i, c_i the poles,
//           inputs and outputs of the continuous model in the coordinates of its eigenvectors;
//           zero-order hold; delay (k + f) T with p1 = (e^{l (1-f) T} - 1)/l and
//           p2 = e^{l (1-f) T} (e^{l f T} - 1)/l. Exact at and between the grid's frequencies.
// Point     about which it is linear: where a law that integrates holds the rotor.
// Grid      from 0 to half the sampling rate, denser around the plant's lightly damped poles.
// Rigid     with Known::kRigidBody the flexible modes are left out, as on a rig not identified yet.
// Failure   Problem when the model has no independent eigenvectors (a rotor without magnets).
// Shares    nothing with analysis/, which judges what is designed here.
// Units     A in, m out. Thread: any number of readers.

#include <Eigen/Core>
#include <complex>
#include <string>
#include <vector>

#include "common/axes.hpp"
#include "configuration/rig_file.hpp"
#include "design/pid/coordinates.hpp"

namespace levitas::design {

using AxisMatrix =
    Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxAxes, kMaxAxes>;

struct SampledPoint {
  double hz{};
  std::complex<double> z;
  AxisMatrix plant;
};

/// One lightly damped mode of the plant, or both of a round rotor at rest, apart from all others.
struct LightMode {
  std::complex<double> z;  ///< where the others are taken
  std::vector<std::complex<double>> poles;
  Eigen::MatrixXcd input, output;  ///< of the mode alone, P = output (z - poles)^-1 input
  AxisMatrix others;               ///< P without it
};

/// Of the rotor: all that the rig file says, or its mass and inertia alone.
enum class Known { kAll, kRigidBody };

class SampledPlant {
 public:
  /// With coordinates P is M P R, of the channels; what is said of axes stays theirs.
  SampledPlant(const configuration::RigFile& rig, double speed_rad_per_s, Known known = Known::kAll,
               Coordinates coordinates = {});

  [[nodiscard]] AxisMatrix At(std::complex<double> z) const;
  [[nodiscard]] SampledPoint AtHz(double hz) const;
  [[nodiscard]] const std::vector<SampledPoint>& grid() const noexcept { return grid_; }
  [[nodiscard]] const std::vector<LightMode>& light_modes() const noexcept { return light_; }
  /// Poles outside the unit circle.
  [[nodiscard]] int growing() const noexcept { return growing_; }
  /// Least damping ratio of the plant's own lightly damped poles; 1 when there are none.
  [[nodiscard]] double own_damping() const noexcept { return own_damping_; }
  [[nodiscard]] const Coordinates& coordinates() const noexcept { return coordinates_; }
  [[nodiscard]] double period_s() const noexcept { return period_s_; }
  [[nodiscard]] double speed_rad_per_s() const noexcept { return speed_rad_per_s_; }
  [[nodiscard]] Eigen::Index axes() const noexcept { return output_.rows(); }
  /// Why the magnets cannot carry the static load; empty: they can. Then the model is that of the
  /// centred rotor.
  [[nodiscard]] const std::string& failure() const noexcept { return failure_; }
  /// What carries the static load, per axis.
  [[nodiscard]] const AxisArray& static_a() const noexcept { return static_a_; }
  /// Force per current and per displacement of each axis at the point [N/A], [N/m].
  [[nodiscard]] const std::vector<double>& current_n_per_a() const noexcept { return ki_; }
  [[nodiscard]] const std::vector<double>& displacement_n_per_m() const noexcept { return ks_; }

 private:
  void MakeGrid(const Eigen::VectorXcd& poles);
  void TakeLightModes(const Eigen::VectorXcd& poles);
  [[nodiscard]] std::complex<double> Gain(Eigen::Index mode, std::complex<double> z) const;

  Coordinates coordinates_;
  double period_s_{}, speed_rad_per_s_{};
  int whole_delay_{};
  int growing_{};
  double own_damping_{1.0};
  Eigen::VectorXcd z_poles_, now_, before_;  ///< e^{l T}, p1, p2
  Eigen::MatrixXcd input_, output_;
  std::vector<double> residue_;  ///< output x input of each mode: real parts, then imaginary ones
  std::string failure_;
  AxisArray static_a_{};
  std::vector<double> ki_, ks_;
  std::vector<SampledPoint> grid_;
  std::vector<LightMode> light_;
};

}  // namespace levitas::design
