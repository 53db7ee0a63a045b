#include "diagnosis/model/plant_at.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace levitas::diagnosis {
namespace {

constexpr double kLeastFrequency = 1e-3;  // of the file's
constexpr double kMostDamping = 0.999;

/// Ratios by which a mode's frequency and its damping ratio change.
struct ModeRatios {
  double frequency, damping_ratio;
};

/// What an effect of the rig file makes of a mode is an absolute number, which changes as well.
void ChangeEffects(std::size_t flexible_mode, const ModeRatios& by, plant::PlantConfig& config) {
  for (effect::EffectConfig& entry : config.effects) {
    if (entry.mode != flexible_mode) continue;
    if (entry.id == effect::Id::kModalFrequency) entry.values[0] *= by.frequency;
    if (entry.id == effect::Id::kModalDamping) {
      entry.values[0] = std::clamp(entry.values[0] * by.damping_ratio, 0.0, kMostDamping);
    }
  }
}

}  // namespace

std::shared_ptr<const plant::PlantModel> PlantAt(const RigView& rig, const LinearChange& change) {
  plant::PlantParameters parameters = rig.model->parameters();
  bool any = change.gyroscopic != 1.0;
  parameters.modes.gyroscopic *= change.gyroscopic;
  for (std::size_t i = 0; i < rig.modes; ++i) {
    const LinearChange::Mode& changed = change.mode[i];
    if (changed.frequency == 1.0 && changed.damping == 1.0) continue;
    any = true;
    const auto at = static_cast<Eigen::Index>(i);
    // A step of a fit that is no number is refused for what the model then does, not here.
    const double frequency =
        changed.frequency > kLeastFrequency ? changed.frequency : kLeastFrequency;
    const double damping = std::isfinite(changed.damping) ? changed.damping : 0.0;
    const ModeRatios by{frequency, damping / frequency};  // the change is one of 2 z w
    double& damping_ratio = parameters.modes.damping_ratio[at];
    parameters.modes.frequency_rad_per_s[at] *= by.frequency;
    damping_ratio = std::clamp(damping_ratio * by.damping_ratio, 0.0, kMostDamping);
    const auto rigid = static_cast<std::size_t>(parameters.modes.rigid_modes);
    if (i >= rigid) ChangeEffects(i - rigid + 1, by, parameters.config);
  }
  if (!any) return rig.model;
  return std::make_shared<const plant::PlantModel>(std::move(parameters));
}

}  // namespace levitas::diagnosis
