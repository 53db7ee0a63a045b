// What Apply needs: mode shapes at the planes of the entries, storage, and places in the state.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "plant_sim/effect/catalogue.hpp"
#include "plant_sim/effect/eddy_current.hpp"
#include "plant_sim/plant/applied_effects/apply_effects.hpp"
#include "plant_sim/rotor/plane_shape.hpp"

namespace levitas::plant {
namespace {

using effect::EffectConfig;
using effect::Id;

// Between geared shafts it belongs to the train, coupling_effects.hpp.
bool OfTheTrain(const PlantParameters& parameters, const EffectConfig& entry) {
  return entry.id == Id::kMisalignment && !parameters.config.shafts.empty();
}

/// Whether an entry acts by a shape of the shaft, at a place or of a mode. No default: the compiler
/// names a new effect here, whose shape and state are made below.
bool ActsOnShaft(Id id) {
  switch (id) {
    case Id::kShaftBow:
    case Id::kSensorPosition:
    case Id::kBreathingCrack:
    case Id::kInternalDamping:
    case Id::kUnbalance:
    case Id::kMisalignment:
    case Id::kCouplingStiffness:
    case Id::kCrossCoupledStiffness:
    case Id::kStaticLoad:
      return true;
    case Id::kExtraDelay:
    case Id::kDroppedSamples:
    case Id::kSampleJitter:
    case Id::kAmplifierBandwidth:
    case Id::kAmplifierSlew:
    case Id::kCurrentGain:
    case Id::kDisplacementStiffness:
    case Id::kCoilAsymmetry:
    case Id::kMagneticSaturation:
    case Id::kHysteresis:
    case Id::kEddyCurrent:
    case Id::kAxisRotation:
    case Id::kSensorGain:
    case Id::kSensorOffset:
    case Id::kSensorNonlinearity:
    case Id::kSensorBandwidth:
    case Id::kSensorRunout:
    case Id::kMainsPickup:
    case Id::kSensorNoise:
    case Id::kShaftAnisotropy:
    case Id::kModalFrequency:
    case Id::kModalDamping:
    case Id::kGyroscopicInertia:
    case Id::kRotorMass:
    case Id::kSupportMode:
    case Id::kTouchdownRub:
    case Id::kMeshStiffness:
    case Id::kMeshStiffnessVariation:
    case Id::kBacklash:
    case Id::kMeshFriction:
    case Id::kTransmissionError:
    case Id::kGearRunout:
    case Id::kToothCrack:
    case Id::kForceConstant:
    case Id::kCommandOffset:
    case Id::kMagneticCoupling:
      return false;
  }
  return false;
}

std::vector<double> EntryShape(const PlantParameters& parameters, const EffectConfig& entry) {
  if (OfTheTrain(parameters, entry) || !ActsOnShaft(entry.id)) return {};
  const rotor::ModalRotor& modes = parameters.modes;
  switch (entry.id) {
    case Id::kShaftBow:
      // The largest deflection that a unit of this mode makes anywhere on the shaft.
      return {modes.shapes.col(static_cast<Eigen::Index>(FlexibleMode(parameters, entry)))
                  .cwiseAbs()
                  .maxCoeff()};
    case Id::kSensorPosition:
      return rotor::DeflectionAt(
          modes, parameters.config.bearings[entry.bearing].sensor_z_m + entry.values[0]);
    case Id::kBreathingCrack:
      return rotor::CurvatureAt(modes, entry.values[0]);
    case Id::kInternalDamping: {
      auto bending = rotor::DeflectionAt(modes, entry.values[0]);
      std::fill_n(bending.begin(), modes.rigid_modes, 0.0);
      return bending;
    }
    case Id::kUnbalance:
    case Id::kMisalignment:
    case Id::kCouplingStiffness:
    case Id::kCrossCoupledStiffness:
    case Id::kStaticLoad:
      return rotor::DeflectionAt(modes, entry.values[0]);
    default:  // at no place of a shaft: ActsOnShaft()
      return {};
  }
}

void ReserveAxis(const EffectConfig& entry, std::size_t axis, BearingEffects& bearing,
                 EffectModel& model, StateLayout& layout) {
  MagnetEffects& magnet = bearing.axis[axis % 2];
  const auto states = [&](std::size_t count, std::size_t& first) {
    if (first != kNoState) return;
    first = layout.size;
    layout.size += count;
    model.memory = true;
  };
  if (entry.id == Id::kHysteresis) states(1, magnet.hysteresis_state);
  if (entry.id == Id::kEddyCurrent) states(effect::kEddyLags, magnet.eddy_state);
  if (entry.id == Id::kSensorRunout) model.runouts.emplace_back();
  if (entry.id == Id::kMainsPickup) model.pickups.emplace_back();
}

void ReserveOnShaft(const PlantParameters& parameters, const EffectConfig& entry,
                    EffectModel& model, StateLayout& layout) {
  const std::vector<double> empty(layout.modes, 0.0);
  switch (entry.id) {
    case Id::kShaftBow:
      model.bow.assign(2 * layout.modes, 0.0);
      break;
    case Id::kInternalDamping:
      model.dampers.push_back({empty, 0.0});
      break;
    case Id::kBreathingCrack:
      model.cracks.push_back({empty, 0.0, 1.0, 0.0});
      break;
    case Id::kMisalignment:
      model.order_forces.push_back({empty, 0, 0.0});
      break;
    case Id::kCouplingStiffness:
    case Id::kCrossCoupledStiffness:
      model.springs.push_back({empty, 0.0, 0.0, 0.0, 0.0});
      break;
    case Id::kTouchdownRub: {
      support::Touchdown rub;
      rub.journal_radius_m = parameters.config.bearings[entry.bearing].touchdown.journal_radius_m;
      model.bearings[entry.bearing].rubs.push_back(rub);
      break;
    }
    case Id::kSupportMode:
      model.bearings[entry.bearing].housing_state = layout.size;
      layout.size += 4;
      model.housings = true;
      break;
    default:
      break;
  }
}

/// Which parts of the time step an entry switches on.
void Mark(const EffectConfig& entry, EffectModel& model) {
  switch (effect::At(entry.id).place) {
    case effect::Place::kMagnet:
      (entry.on_sensor ? model.views : model.magnets) = true;
      break;
    case effect::Place::kSupport:
      model.magnets = true;
      model.views = model.views || entry.id == Id::kSupportMode;
      break;
    case effect::Place::kSensor:
      model.views =
          model.views || entry.id == Id::kSensorRunout || entry.id == Id::kSensorNonlinearity;
      model.outputs = model.outputs || entry.id == Id::kSensorOffset ||
                      entry.id == Id::kMainsPickup || entry.id == Id::kSensorNoise;
      break;
    case effect::Place::kRotor:
      model.motions = model.motions || entry.id == Id::kShaftBow ||
                      entry.id == Id::kShaftAnisotropy || entry.id == Id::kInternalDamping ||
                      entry.id == Id::kBreathingCrack;
      break;
    case effect::Place::kExternal:
      model.motions = model.motions || entry.id != Id::kStaticLoad;
      break;
    case effect::Place::kTiming:
      model.outputs = model.outputs || entry.id == Id::kSampleJitter;
      break;
    case effect::Place::kAmplifier:
      model.magnets =
          model.magnets || (entry.id != Id::kAmplifierBandwidth && entry.id != Id::kAmplifierSlew);
      break;
    case effect::Place::kGear:
      break;
  }
}

}  // namespace

EntryShapes MakeEntryShapes(const PlantParameters& parameters) {
  const auto flexible = static_cast<std::size_t>(parameters.modes.frequency_rad_per_s.size() -
                                                 parameters.modes.rigid_modes);
  EntryShapes shapes;
  shapes.reserve(parameters.config.effects.size());
  for (const EffectConfig& entry : parameters.config.effects) {
    const effect::Row& row = effect::At(entry.id);
    if (row.scope == effect::Scope::kMode && (entry.mode < 1 || entry.mode > flexible)) {
      throw std::invalid_argument(
          fmt::format("effect {}: mode {}, allowed 1 to {} (the flexible "
                      "modes kept); correct the rig description",
                      row.name, entry.mode, flexible));
    }
    shapes.push_back(EntryShape(parameters, entry));
  }
  return shapes;
}

EffectModel PrepareEffects(const PlantParameters& parameters, StateLayout& layout) {
  EffectModel model;
  const std::size_t bearings = parameters.config.bearings.size();
  model.bearings.resize(bearings);
  model.turns.resize(bearings);
  for (const EffectConfig& entry : parameters.config.effects) {
    if (OfTheTrain(parameters, entry)) continue;
    Mark(entry, model);
    ReserveOnShaft(parameters, entry, model, layout);
    if (effect::At(entry.id).scope != effect::Scope::kChannels) continue;
    for (std::size_t axis = 0; axis < 2 * bearings; ++axis) {
      if (entry.Acts(axis)) ReserveAxis(entry, axis, model.bearings[axis / 2], model, layout);
    }
  }
  return model;
}

}  // namespace levitas::plant
