#pragma once
// The teeth of a gear pair as a diagnosis looks at them: numbers of the nominal mesh, and how the
// teeth are displaced along a run of the model.
//
// Equation   delta = r1 - r2 + run-out 1 - run-out 2 - e(engagement); force on the driven wheel
//            k delta + c delta'. docs/derivations.md (G1), (G2). Written without
//            plant_sim/gear's step, so that neither can hide an error of the other.
// Angle      total, from a start at which all wheels stand as in the rig file: of the first shaft
//            alone it leaves open in which of its turns the others are (turns.hpp).
// Units      SI. Thread: any; pure.

#include <complex>
#include <cstddef>
#include <string>
#include <vector>

#include "plant_sim/plant/plant_model.hpp"

namespace levitas::diagnosis {

inline constexpr std::size_t kMostMeshes = 2;

/// Displacement of the teeth against each other, x and y.
struct TeethMoment {
  float delta_x_m{}, delta_y_m{};
  float rate_x_m_per_s{}, rate_y_m_per_s{};
};

struct WheelView {
  std::size_t shaft{};
  double ratio{};  ///< speed over the first shaft's
  int teeth{};
  double z_m{};
  double base_radius_m{};
  double eccentric_mass_kg{};
  std::complex<double> runout_m;
  std::vector<double> shape;  ///< per mode
};

struct MeshView {
  std::string name;
  WheelView driving, driven;
  std::vector<double> shape;  ///< displacement of the driving wheel minus that of the driven one
  std::complex<double> normal;
  bool isotropic{};
  double stiffness_n_per_m{}, damping_n_s_per_m{};
  double preload_n{};
  double half_backlash_m{};
  std::vector<gear::Harmonic> error;

  /// Angle of tooth engagement per angle of the first shaft.
  [[nodiscard]] double engagement() const noexcept {
    return driving.teeth * std::abs(driving.ratio);
  }
  /// Run-outs and transmission error alone.
  void Impose(double angle_rad, double speed_rad_per_s, std::complex<double>& delta_m,
              std::complex<double>& rate_m_per_s) const noexcept;
  /// Displacement and rate; `q` and `v` over the modes of both planes.
  [[nodiscard]] TeethMoment At(double angle_rad, double speed_rad_per_s, const float* q,
                               const float* v) const noexcept;
  /// Part of a displacement that the force follows.
  [[nodiscard]] std::complex<double> Seen(std::complex<double> delta) const noexcept {
    return isotropic ? delta : normal * std::real(delta * std::conj(normal));
  }
};

/// Empty for a rig with one rotor.
[[nodiscard]] std::vector<MeshView> MeshesOf(const plant::PlantModel& model);

}  // namespace levitas::diagnosis
