#include "identification/identified_rig.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "common/problem.hpp"
#include "identification/identified_rotor.hpp"

namespace levitas::identification {
namespace {

using effect::EffectConfig;
using effect::Id;

/// Axes of a bearing that differ by less are alike.
constexpr double kAlike = 1e-3;

/// ki = 4 k i0/s0^2 and ks = 4 k i0^2/s0^3, hence s0 = ki i0/ks: at the bias of the file.
void SetMagnet(plant::BearingConfig& bearing, double ki_n_per_a, double ks_n_per_m) {
  if (!(ki_n_per_a > 0.0 && ks_n_per_m > 0.0)) {
    throw BadInput(fmt::format("ki {:.2f} N/A and ks {:.0f} N/m of bearing {} are no magnet's",
                               ki_n_per_a, ks_n_per_m, bearing.name));
  }
  plant::MagnetConfig& magnet = bearing.magnet;
  magnet.gap_m = ki_n_per_a * magnet.bias_current_a / ks_n_per_m;
  magnet.force_constant_n_m2_per_a2 =
      ki_n_per_a * magnet.gap_m * magnet.gap_m / (4.0 * magnet.bias_current_a);
}

void Add(configuration::RigFile& rig, Id id, double value, std::uint32_t axes, std::size_t mode) {
  EffectConfig entry;
  entry.id = id;
  entry.axes = axes;
  entry.mode = mode;
  entry.values[0] = value;
  rig.plant.effects.push_back(entry);
}

/// What the found numbers of magnets, chain and rotor hold already: an entry of the file beside
/// them would count twice.
bool IsMeasured(const EffectConfig& entry) {
  if (entry.timed()) return false;
  switch (entry.id) {
    case Id::kCurrentGain:
    case Id::kDisplacementStiffness:
    case Id::kSensorGain:
    case Id::kExtraDelay:
    case Id::kModalFrequency:
    case Id::kModalDamping:
    case Id::kGyroscopicInertia:
    case Id::kRotorMass:
      return true;
    default:
      return false;
  }
}

void SetModes(configuration::RigFile& out, const ModalResult& found) {
  for (std::size_t i = 0; i < found.support.size(); ++i) {
    if (found.support[i].support != Support::kShown) continue;
    const auto at = static_cast<Eigen::Index>(2 + i);
    Add(out, Id::kModalFrequency, found.rig.frequency_rad_per_s[at] / (2.0 * std::numbers::pi),
        effect::kAllAxes, i + 1);
    Add(out, Id::kModalDamping, found.rig.damping_ratio[at], effect::kAllAxes, i + 1);
  }
}

}  // namespace

configuration::RigFile IdentifiedRig(const configuration::RigFile& rig, const ModalResult& found,
                                     RotorForm form) {
  configuration::RigFile out = rig;
  std::erase_if(out.plant.effects, IsMeasured);
  out.numbers.name += "_identified";
  out.plant.delay_samples = found.rig.delay_samples;
  const Physical& p = found.rig;
  for (std::size_t b = 0; b < out.plant.bearings.size(); ++b) {
    const auto x = static_cast<Eigen::Index>(2 * b);
    const double gain = 0.5 * (p.gain[x] + p.gain[x + 1]);
    const double ki = 0.5 * (p.ki_n_per_a[x] + p.ki_n_per_a[x + 1]);
    const double ks = 0.5 * (p.ks_n_per_m[x] + p.ks_n_per_m[x + 1]);
    SetMagnet(out.plant.bearings[b], ki, ks);
    out.plant.bearings[b].sensor.gain = gain;
    for (Eigen::Index axis = x; axis < x + 2; ++axis) {
      const std::uint32_t one = 1U << static_cast<unsigned>(axis);
      const auto add = [&](Id id, double ratio) {
        if (std::abs(ratio - 1.0) > kAlike) Add(out, id, ratio, one, 1);
      };
      add(Id::kCurrentGain, p.ki_n_per_a[axis] / ki);
      add(Id::kDisplacementStiffness, p.ks_n_per_m[axis] / ks);
      add(Id::kSensorGain, p.gain[axis] / gain);
    }
  }
  if (form == RotorForm::kModes) {
    out.plant.rotor = {};
    out.plant.rotor.given = IdentifiedRotor(rig, found);
  } else {
    SetModes(out, found);
  }
  return out;
}

configuration::RigFile IdentifiedRig(const configuration::RigFile& rig,
                                     const GearedParameters& found) {
  configuration::RigFile out = rig;
  out.numbers.name += "_identified";
  gear::GearPair& pair = out.plant.gears.front();
  for (plant::BearingConfig& bearing : out.plant.bearings) {
    const ShaftFound& s = bearing.shaft == pair.driving.shaft ? found.pinion : found.gear;
    SetMagnet(bearing, s.ki_n_per_a, s.ks_n_per_m);
  }
  const auto set = [](gear::Wheel& wheel, const ShaftFound& s) {
    wheel.runout_m = std::abs(s.run_out_m);
    wheel.runout_phase_rad = std::arg(s.run_out_m);
  };
  set(pair.driving, found.pinion);
  set(pair.driven, found.gear);
  pair.stiffness_n_per_m = found.mesh_stiffness_n_per_m;
  pair.damping_n_s_per_m = found.mesh_damping_n_s_per_m;
  pair.transmission_error.clear();
  for (const TransmissionError& e : found.error) {
    pair.transmission_error.push_back(
        {e.harmonic, std::abs(e.amplitude_m), std::arg(e.amplitude_m)});
  }
  return out;
}

}  // namespace levitas::identification
