// Rig files of a fit: in the file's keys where the law has one, else as effects.

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnosis/levitator/levitator_result.hpp"
#include "diagnosis/report/effect_entry.hpp"
#include "diagnosis/report/extended_rig.hpp"
#include "numerics/normal_distribution.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::levitator {
namespace {

void ExtendCoil(const Theta& t, plant::VoltageDrive& coil) {
  constexpr double kFlatM = 1000.0;  // the largest decay that a rig file may have
  const double resistance = (1.0 + t[kResistance]) * (1.0 + t[Own(0, kOwnResistance)]);
  const double decay_m = coil.decay_m;
  coil.offset_a /= resistance;
  coil.steady *= (1.0 + t[kSupply]) / resistance;
  coil.time_constant_s *= (1.0 + t[kInductance]) / resistance;
  const double per_gap = 1.0 - t[kProfile];
  coil.decay_m = per_gap > decay_m / kFlatM ? decay_m / per_gap : kFlatM;
  coil.motion_emf = (coil.motion_emf + t[kMotionEmf]) * coil.decay_m / decay_m;
  coil.dead_band_a = t[kDeadBand];
  coil.curvature = std::clamp(t[kDriveCurve], -1.0, 1.0);
  coil.iron_1_per_a2 = t[kIronInductance];
  coil.warming_1_per_s = t[kHeating];
  coil.away_steady_ratio = 1.0 + t[kAwaySupply];
  coil.away_time_constant_ratio = 1.0 + t[kAwayInductance];
}

void ExtendForce(const Theta& t, double gap_m, plant::ExponentialForce& law) {
  if (t[kForce] == 0.0 && t[kForceDecay] == 0.0 && t[kForceAway] == 0.0) return;
  const double up = law.force_n_per_a2 * (1.0 + t[kForce]) * std::exp(-gap_m / law.decay_m);
  const double down = law.force_n_per_a2 * (1.0 + t[kForce]) * (1.0 + t[kForceAway]) *
                      std::exp(-law.far_gap_m / law.decay_m);
  law.decay_m /= std::max(0.1, 1.0 + t[kForceDecay]);
  law.force_n_per_a2 = up * std::exp(gap_m / law.decay_m);
  law.far_gap_m = law.decay_m * std::log(law.force_n_per_a2 / down);
}

/// Entries of the list of effects, for the values that have no key.
std::vector<effect::EffectConfig> Entries(const RigNumbers& rig, const Theta& t,
                                          double bandwidth_hz) {
  using effect::Id;
  std::vector<effect::EffectConfig> out;
  const auto add = [&](bool there, Id id, const diagnosis::EntryValues& values) {
    if (!there) return;
    const auto entry = diagnosis::MakeEntry(id, diagnosis::AtAxis(rig, 0), rig.axes(), values);
    if (entry) out.push_back(*entry);
  };
  add(t[kCommandUpper] != 0.0, Id::kCommandOffset, {{"offset_a", t[kCommandUpper]}});
  add(t[kForceKnee] > 0.0, Id::kMagneticSaturation,
      {{"knee_a", 1.0 / std::sqrt(std::max(1e-9, t[kForceKnee]))}, {"exponent", 2.0}});
  add(t[kForceLag] > 0.0, Id::kEddyCurrent, {{"tau_us", 1e6 * t[kForceLag]}});
  add(t[kSensorGain] != 0.0, Id::kSensorGain, {{"ratio", 1.0 + t[kSensorGain]}});
  add(t[kSensorOffset] != 0.0, Id::kSensorOffset, {{"offset_um", 1e6 * t[kSensorOffset]}});
  add(t[kSensorSquare] != 0.0 || t[kSensorCube] != 0.0, Id::kSensorNonlinearity,
      {{"a2_1_per_m", t[kSensorSquare]}, {"a3_1_per_m2", t[kSensorCube]}});
  const double lag_s = 1.0 / (2.0 * std::numbers::pi * bandwidth_hz) + t[kSensorLag];
  add(t[kSensorLag] > 0.0, Id::kSensorBandwidth,
      {{"bandwidth_hz", 1.0 / (2.0 * std::numbers::pi * lag_s)}});
  add(t[kMass] != 0.0, Id::kRotorMass, {{"ratio", 1.0 + t[kMass]}});
  add(t[kLoad] != 0.0, Id::kStaticLoad, {{"z_mm", 0.0}, {"force_x_n", t[kLoad]}});
  add(t[kSpring] != 0.0, Id::kCouplingStiffness, {{"z_mm", 0.0}, {"direct_n_per_m", t[kSpring]}});
  return out;
}

bool InTheModel(std::size_t i) {
  constexpr std::array kMissing{kCommandLower, kEddyShare,     kMutual,  kProbeGain,  kProbeOffset,
                                kProbeLag,     kForceExponent, kDamping, kDryFriction};
  return std::find(kMissing.begin(), kMissing.end(), i) == kMissing.end();
}

std::string Comments(const Found& found) {
  std::string text;
  for (const diagnosis::Hypothesis& cause : found.causes) {
    for (const std::size_t i : cause.terms) {
      const Row& row = Table()[i];
      const double spread = numerics::kInterval90 * found.extended.deviation[i];
      text += fmt::format("# {} {} = {:.5g} {} ({:.5g} to {:.5g}){}\n", effect::At(row.effect).name,
                          row.name, found.extended.theta[i], row.unit,
                          found.extended.theta[i] - spread, found.extended.theta[i] + spread,
                          InTheModel(i) ? "" : ": the simulated rig has no key for it");
    }
  }
  return text;
}

/// The rig file with all values of the table, which hold the effects of the file as well.
std::string WithValues(const configuration::RigFile& file, const Theta& t,
                       const std::string& comments) {
  configuration::RigFile extended = file;
  extended.plant.effects.clear();  // the values hold them
  plant::BearingConfig& bearing = extended.plant.bearings.at(0);
  extended.plant.delay_samples += t[kDelay];
  if (bearing.amplifier.voltage) ExtendCoil(t, *bearing.amplifier.voltage);
  if (bearing.magnet.exponential) {
    const double far_m = bearing.magnet.exponential->far_gap_m;
    ExtendForce(t, bearing.magnet.gap_m, *bearing.magnet.exponential);
    // The far gap stands for the force alone: that coil's inductance stays what it was.
    if (auto& coil = bearing.amplifier.voltage) {
      coil->away_time_constant_ratio *=
          std::exp((bearing.magnet.exponential->far_gap_m - far_m) / coil->decay_m);
    }
  }
  const std::vector<effect::EffectConfig> entries =
      Entries(file.numbers, t, bearing.sensor.bandwidth_hz);
  return comments + diagnosis::WithEffects(extended, entries);
}

}  // namespace

std::string ExtendedRig(const configuration::RigFile& file, const Theta& origin,
                        const Found& found) {
  Theta t = ComposedWith(OriginOf(file), Zeros(1));
  for (const diagnosis::Hypothesis& cause : found.causes) {
    for (const std::size_t i : cause.terms) {
      t[i] = ComposedWith(i, origin[i], found.extended.theta[i]);
    }
  }
  return WithValues(file, t, Comments(found));
}

std::string CalibratedRig(const configuration::RigFile& file, const Theta& origin,
                          const Found& found) {
  // A record that was not seen has what the others have on average.
  Theta t = ComposedWith(origin, SharedPart(found.extended.theta, 1));
  t[kSensorOffset] += t[Own(0, kOwnOffset)];
  return WithValues(file, t,
                    "# The rig as amb diagnose judged it: its causes, and what was calibrated.\n" +
                        Comments(found));
}

}  // namespace levitas::levitator
