#include "analysis/damped_modes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/whirl_direction.hpp"
#include "numerics/dense/eigenvalues.hpp"
#include "numerics/dense/spectrum.hpp"
#include "plant_sim/plant/linear_model.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::analysis {
namespace {

// Slower than this is a shaft turning as a whole, not a vibration.
constexpr double kSlowestRadPerS = 1e-3;

}  // namespace

DampedModesAtSpeed DampedModes(const plant::PlantConfig& plant, double speed_rad_per_s) {
  plant::PlantConfig without = plant;
  for (auto& bearing : without.bearings) bearing.magnet.bias_current_a = 0.0;
  const plant::PlantModel model(without);
  const auto count = static_cast<Eigen::Index>(model.coordinates());
  const auto modes = static_cast<Eigen::Index>(model.layout().modes);
  const Eigen::MatrixXd a =
      plant::Linearise(model, speed_rad_per_s).a.topLeftCorner(2 * count, 2 * count);
  const numerics::Spectrum spectrum = numerics::SpectrumOf(a);
  DampedModesAtSpeed result{speed_rad_per_s, {}};
  for (Eigen::Index i = 0; i < spectrum.values.size(); ++i) {
    const std::complex<double> s = spectrum.values[i];
    if (s.imag() <= kSlowestRadPerS) continue;
    // Coordinates are mass-normalised: squares of velocities are kinetic energies.
    const Eigen::VectorXcd velocity = spectrum.vectors.col(i).tail(count);
    result.modes.push_back({s.imag() / (2.0 * std::numbers::pi), -s.real() / std::abs(s),
                            velocity.tail(count - 2 * modes).squaredNorm() / velocity.squaredNorm(),
                            ForwardShare(velocity, modes)});
  }
  std::sort(result.modes.begin(), result.modes.end(), [](const auto& first, const auto& second) {
    return first.frequency_hz < second.frequency_hz;
  });
  return result;
}

}  // namespace levitas::analysis
