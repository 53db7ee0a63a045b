// Effects of the rotor, of what pushes it from outside, and of the supports.
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <variant>

#include "plant_sim/effect/catalogue.hpp"
#include "plant_sim/effect/crack.hpp"
#include "plant_sim/effect/placed_id.hpp"
#include "plant_sim/plant/applied_effects/apply_effects.hpp"

namespace levitas::plant {
namespace {

using effect::EffectConfig;
using effect::ExternalId;
using effect::RotorId;
using effect::SupportId;

// Rigid modes of a rotor `mass_ratio` times as heavy, mass-normalised.
void Store(const std::vector<double>& shape, const RigNow& now, std::vector<double>& to) noexcept {
  const double rigid = now.mass_ratio == 1.0 ? 1.0 : 1.0 / std::sqrt(now.mass_ratio);
  for (std::size_t i = 0; i < shape.size(); ++i) {
    to[i] = i < now.rigid_modes ? rigid * shape[i] : shape[i];
  }
}

/// Outer diameter and bending stiffness E I [N m^2] of the shaft at a plane.
struct Shaft {
  double diameter_m{};
  double stiffness_n_m2{};
};

Shaft ShaftAt(const rotor::RotorConfig& rotor, double z_m) noexcept {
  const rotor::Section* here = rotor.sections.data();
  double end_m = 0.0;
  for (const rotor::Section& section : rotor.sections) {
    here = &section;
    end_m += section.length_m;
    if (z_m <= end_m) break;
  }
  const double area_m4 =
      std::numbers::pi / 64.0 *
      (std::pow(here->outer_diameter_m, 4) - std::pow(here->inner_diameter_m, 4));
  return {here->outer_diameter_m, rotor.material.young_pa * area_m4};
}

void ApplyUnbalance(const Values& values, const std::vector<double>& shape, RigNow& now) noexcept {
  const std::size_t modes = shape.size();
  const std::complex<double> moment = std::polar(values[1], values[2]);
  for (std::size_t i = 0; i < modes; ++i) {
    now.unbalance[i] += shape[i] * moment.real();
    now.unbalance[modes + i] += shape[i] * moment.imag();
  }
}

void ApplyCrack(const PlantParameters& parameters, const Values& values,
                const std::vector<double>& curvature, Crack& crack) noexcept {
  const rotor::RotorConfig& rotor = parameters.config.rotor;
  const Shaft shaft = ShaftAt(rotor, values[0]);
  // c (E I)^2 with c = C d/(E I).
  crack.softening_n_m2 = effect::CrackCompliance(values[1], rotor.material.poisson) *
                         shaft.diameter_m * shaft.stiffness_n_m2;
  crack.cosine = std::cos(values[2]);
  crack.sine = std::sin(values[2]);
  std::copy(curvature.begin(), curvature.end(), crack.curvature.begin());
}

void ApplyRub(const Values& values, support::Touchdown& rub) noexcept {
  rub.clearance_m = values[0];  // the radius of the journal was set when the entry was prepared
  rub.stiffness_n_per_m = values[1];
  rub.damping_n_s_per_m = values[2];
  rub.friction = values[3];
}

void ApplyMisalignment(const Values& values, const std::vector<double>& shape, const RigNow& now,
                       OrderForce& force) noexcept {
  Store(shape, now, force.shape);
  force.order = static_cast<int>(values[1]);
  force.force_n = std::polar(values[2], values[3]);
}

void ApplyStaticLoad(const Values& values, const std::vector<double>& shape, RigNow& now) noexcept {
  const std::size_t modes = shape.size();
  for (std::size_t i = 0; i < modes; ++i) {
    now.static_load[i] += shape[i] * values[1];
    now.static_load[modes + i] += shape[i] * values[2];
  }
}

void ApplySupportMode(const Values& values, BearingEffects& bearing) noexcept {
  bearing.housing_mass_kg = values[0];
  bearing.housing_rad_per_s = 2.0 * std::numbers::pi * values[1];
  bearing.housing_damping_ratio = values[2];
}

void ApplyToSupport(SupportId id, const EffectConfig& entry, const Values& values,
                    EffectModel& model, Slots& slots) noexcept {
  BearingEffects& bearing = model.bearings[entry.bearing];
  switch (id) {
    case SupportId::kSupportMode:
      ApplySupportMode(values, bearing);
      break;
    case SupportId::kTouchdownRub:
      ApplyRub(values, bearing.rubs[slots.rub[entry.bearing]++]);
      break;
  }
}

}  // namespace

void ApplyToRotor(const PlantParameters& parameters, const EffectConfig& entry,
                  const Values& values, const std::vector<double>& shape, RigNow& now,
                  EffectModel& model, Slots& slots) noexcept {
  const std::size_t mode = FlexibleMode(parameters, entry);
  switch (std::get<RotorId>(effect::Placed(entry.id))) {
    case RotorId::kUnbalance:
      ApplyUnbalance(values, shape, now);
      break;
    case RotorId::kShaftBow: {
      // Deflection per unit modal coordinate is largest at shape[0].
      const std::complex<double> bow = std::polar(values[0] / shape[0], values[1]);
      model.bow[mode] += bow.real();
      model.bow[model.bow.size() / 2 + mode] += bow.imag();
      break;
    }
    case RotorId::kShaftAnisotropy:
      model.anisotropy += std::polar(values[0], 2.0 * values[1]);
      break;
    case RotorId::kModalFrequency:
      // At its own value the bits stay: Hz and back would round.
      if (values[0] == OwnValues(parameters, entry, 0)[0]) break;
      now.frequency_rad_per_s[mode] = 2.0 * std::numbers::pi * values[0];
      break;
    case RotorId::kModalDamping:
      now.damping_ratio[mode] = values[0];
      break;
    case RotorId::kGyroscopicInertia:
      now.gyroscopic_ratio *= values[0];
      break;
    case RotorId::kInternalDamping: {
      RotatingDamper& damper = model.dampers[slots.damper++];
      damper.damping_n_s_per_m = values[1];
      std::copy(shape.begin(), shape.end(), damper.shape.begin());
      break;
    }
    case RotorId::kBreathingCrack:
      ApplyCrack(parameters, values, shape, model.cracks[slots.crack++]);
      break;
    case RotorId::kRotorMass:
      break;  // before all others: ApplyRotorMass()
  }
}

void ApplyFromOutside(const EffectConfig& entry, const Values& values,
                      const std::vector<double>& shape, RigNow& now, EffectModel& model,
                      Slots& slots) noexcept {
  const effect::PlacedId placed = effect::Placed(entry.id);
  if (const auto* of_support = std::get_if<SupportId>(&placed)) {
    return ApplyToSupport(*of_support, entry, values, model, slots);
  }
  const auto spring = [&](double xx, double xy, double yx) {
    PlaneSpring& to = model.springs[slots.spring++];
    Store(shape, now, to.shape);
    to.xx = to.yy = xx;
    to.xy = xy;
    to.yx = yx;
  };
  switch (std::get<ExternalId>(placed)) {
    case ExternalId::kMisalignment:
      if (shape.empty()) break;  // of geared shafts, coupling_effects.hpp
      ApplyMisalignment(values, shape, now, model.order_forces[slots.order_force++]);
      break;
    case ExternalId::kCouplingStiffness:
      spring(values[1], values[2] + values[3], values[2] - values[3]);
      break;
    case ExternalId::kCrossCoupledStiffness:
      spring(0.0, values[1], -values[1]);
      break;
    case ExternalId::kStaticLoad:
      ApplyStaticLoad(values, shape, now);
      break;
  }
}

}  // namespace levitas::plant
