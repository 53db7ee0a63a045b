// What Apply needs: mode shapes at the planes of the entries, storage, and places in the state.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <variant>

#include "plant_sim/effect/catalogue.hpp"
#include "plant_sim/effect/eddy_current.hpp"
#include "plant_sim/effect/placed_id.hpp"
#include "plant_sim/plant/applied_effects/apply_effects.hpp"
#include "plant_sim/rotor/plane_shape.hpp"

namespace levitas::plant {
namespace {

using effect::EffectConfig;
using effect::ExternalId;
using effect::Id;
using effect::RotorId;
using effect::SensorId;
using effect::SupportId;

// Between geared shafts it belongs to the train, coupling_effects.hpp.
bool OfTheTrain(const PlantParameters& parameters, const EffectConfig& entry) {
  return entry.id == Id::kMisalignment && !parameters.config.shafts.empty();
}

/// By which shape of the shaft an entry acts, at a place or of a mode.
enum class ActingShape : std::uint8_t {
  kNone,
  kLargest,     ///< of its mode, anywhere on the shaft
  kAtSensor,    ///< deflection at the sensor, moved
  kCurvature,   ///< at its plane
  kBending,     ///< deflection at its plane, of the flexible modes
  kDeflection,  ///< at its plane
};

/// No default where shafts are acted on: the compiler names a new effect there.
struct ActingShapeOf {
  ActingShape operator()(effect::TimingId /*id*/) const { return ActingShape::kNone; }
  ActingShape operator()(effect::AmplifierId /*id*/) const { return ActingShape::kNone; }
  ActingShape operator()(effect::MagnetId /*id*/) const { return ActingShape::kNone; }
  ActingShape operator()(effect::SupportId /*id*/) const { return ActingShape::kNone; }
  ActingShape operator()(effect::GearId /*id*/) const { return ActingShape::kNone; }
  ActingShape operator()(effect::CoilId /*id*/) const { return ActingShape::kNone; }
  ActingShape operator()(effect::BallId /*id*/) const { return ActingShape::kNone; }

  ActingShape operator()(SensorId id) const {
    switch (id) {
      case SensorId::kSensorPosition:
        return ActingShape::kAtSensor;
      case SensorId::kSensorGain:
      case SensorId::kSensorOffset:
      case SensorId::kSensorNonlinearity:
      case SensorId::kSensorBandwidth:
      case SensorId::kSensorRunout:
      case SensorId::kMainsPickup:
      case SensorId::kSensorNoise:
        break;
    }
    return ActingShape::kNone;
  }

  ActingShape operator()(RotorId id) const {
    switch (id) {
      case RotorId::kShaftBow:
        return ActingShape::kLargest;
      case RotorId::kBreathingCrack:
        return ActingShape::kCurvature;
      case RotorId::kInternalDamping:
        return ActingShape::kBending;
      case RotorId::kUnbalance:
        return ActingShape::kDeflection;
      case RotorId::kShaftAnisotropy:
      case RotorId::kModalFrequency:
      case RotorId::kModalDamping:
      case RotorId::kGyroscopicInertia:
      case RotorId::kRotorMass:
        break;
    }
    return ActingShape::kNone;
  }

  ActingShape operator()(ExternalId id) const {
    switch (id) {
      case ExternalId::kMisalignment:
      case ExternalId::kCouplingStiffness:
      case ExternalId::kCrossCoupledStiffness:
      case ExternalId::kStaticLoad:
        break;
    }
    return ActingShape::kDeflection;
  }
};

std::vector<double> EntryShape(const PlantParameters& parameters, const EffectConfig& entry) {
  if (OfTheTrain(parameters, entry)) return {};
  const rotor::ModalRotor& modes = parameters.modes;
  switch (std::visit(ActingShapeOf{}, effect::Placed(entry.id))) {
    case ActingShape::kNone:
      break;
    case ActingShape::kLargest:
      // The largest deflection that a unit of this mode makes anywhere on the shaft.
      return {modes.shapes.col(static_cast<Eigen::Index>(FlexibleMode(parameters, entry)))
                  .cwiseAbs()
                  .maxCoeff()};
    case ActingShape::kAtSensor:
      return rotor::DeflectionAt(
          modes, parameters.config.bearings[entry.bearing].sensor_z_m + entry.values[0]);
    case ActingShape::kCurvature:
      return rotor::CurvatureAt(modes, entry.values[0]);
    case ActingShape::kBending: {
      auto bending = rotor::DeflectionAt(modes, entry.values[0]);
      std::fill_n(bending.begin(), modes.rigid_modes, 0.0);
      return bending;
    }
    case ActingShape::kDeflection:
      return rotor::DeflectionAt(modes, entry.values[0]);
  }
  return {};
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

/// Room for what an entry adds beside its channels. No default: the compiler names a new effect of
/// the rotor, its supports and what pushes it.
struct Reserve {
  const PlantParameters& parameters;
  const EffectConfig& entry;
  EffectModel& model;
  StateLayout& layout;

  // Of channels, ReserveAxis(); of gears, gear_effects.hpp.
  void operator()(effect::TimingId /*id*/) const {}
  void operator()(effect::AmplifierId /*id*/) const {}
  void operator()(effect::MagnetId /*id*/) const {}
  void operator()(SensorId /*id*/) const {}
  void operator()(effect::GearId /*id*/) const {}
  void operator()(effect::CoilId /*id*/) const {}
  void operator()(effect::BallId /*id*/) const {}

  void operator()(RotorId id) const {
    const std::vector<double> empty(layout.modes, 0.0);
    switch (id) {
      case RotorId::kShaftBow:
        model.bow.assign(2 * layout.modes, 0.0);
        break;
      case RotorId::kInternalDamping:
        model.dampers.push_back({empty, 0.0});
        break;
      case RotorId::kBreathingCrack:
        model.cracks.push_back({empty, 0.0, 1.0, 0.0});
        break;
      case RotorId::kUnbalance:  // these change numbers that every rotor has
      case RotorId::kShaftAnisotropy:
      case RotorId::kModalFrequency:
      case RotorId::kModalDamping:
      case RotorId::kGyroscopicInertia:
      case RotorId::kRotorMass:
        break;
    }
  }

  void operator()(ExternalId id) const {
    const std::vector<double> empty(layout.modes, 0.0);
    switch (id) {
      case ExternalId::kMisalignment:
        model.order_forces.push_back({empty, 0, 0.0});
        break;
      case ExternalId::kCouplingStiffness:
      case ExternalId::kCrossCoupledStiffness:
        model.springs.push_back({empty, 0.0, 0.0, 0.0, 0.0});
        break;
      case ExternalId::kStaticLoad:
        break;
    }
  }

  void operator()(SupportId id) const {
    BearingEffects& bearing = model.bearings[entry.bearing];
    switch (id) {
      case SupportId::kTouchdownRub: {
        support::Touchdown rub;
        rub.journal_radius_m = parameters.config.bearings[entry.bearing].touchdown.journal_radius_m;
        bearing.rubs.push_back(rub);
        break;
      }
      case SupportId::kSupportMode:
        bearing.housing_state = layout.size;
        layout.size += 4;
        model.housings = true;
        break;
    }
  }
};

/// Which parts of the time step an entry switches on. No default: the compiler names a new effect.
struct Mark {
  const EffectConfig& entry;
  EffectModel& model;

  void operator()(effect::MagnetId /*id*/) const {
    (entry.on_sensor ? model.views : model.magnets) = true;
  }

  void operator()(SupportId id) const {
    model.magnets = true;
    switch (id) {
      case SupportId::kSupportMode:
        model.views = true;
        break;
      case SupportId::kTouchdownRub:
        break;
    }
  }

  void operator()(SensorId id) const {
    switch (id) {
      case SensorId::kSensorRunout:
      case SensorId::kSensorNonlinearity:
        model.views = true;
        break;
      case SensorId::kSensorOffset:
      case SensorId::kMainsPickup:
      case SensorId::kSensorNoise:
        model.outputs = true;
        break;
      case SensorId::kSensorGain:  // these change numbers that every sensor has
      case SensorId::kSensorBandwidth:
      case SensorId::kSensorPosition:
        break;
    }
  }

  void operator()(RotorId id) const {
    switch (id) {
      case RotorId::kShaftBow:
      case RotorId::kShaftAnisotropy:
      case RotorId::kInternalDamping:
      case RotorId::kBreathingCrack:
        model.motions = true;
        break;
      case RotorId::kUnbalance:  // these change numbers that every rotor has
      case RotorId::kModalFrequency:
      case RotorId::kModalDamping:
      case RotorId::kGyroscopicInertia:
      case RotorId::kRotorMass:
        break;
    }
  }

  void operator()(ExternalId id) const {
    switch (id) {
      case ExternalId::kMisalignment:
      case ExternalId::kCouplingStiffness:
      case ExternalId::kCrossCoupledStiffness:
        model.motions = true;
        break;
      case ExternalId::kStaticLoad:
        break;
    }
  }

  void operator()(effect::TimingId id) const {
    using effect::TimingId;
    switch (id) {
      case TimingId::kSampleJitter:
        model.outputs = true;
        break;
      case TimingId::kExtraDelay:
      case TimingId::kDroppedSamples:
        break;
    }
  }

  void operator()(effect::AmplifierId id) const {
    using effect::AmplifierId;
    switch (id) {
      case AmplifierId::kCurrentGain:
      case AmplifierId::kCommandOffset:
        model.magnets = true;
        break;
      case AmplifierId::kAmplifierBandwidth:
      case AmplifierId::kAmplifierSlew:
        break;
    }
  }

  void operator()(effect::GearId /*id*/) const {}  // gear_effects.hpp
  void operator()(effect::CoilId /*id*/) const {}  // no entries
  void operator()(effect::BallId /*id*/) const {}
};

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
    const effect::PlacedId placed = effect::Placed(entry.id);
    std::visit(Mark{entry, model}, placed);
    std::visit(Reserve{parameters, entry, model, layout}, placed);
    if (effect::At(entry.id).scope != effect::Scope::kChannels) continue;
    for (std::size_t axis = 0; axis < 2 * bearings; ++axis) {
      if (entry.Acts(axis)) ReserveAxis(entry, axis, model.bearings[axis / 2], model, layout);
    }
  }
  return model;
}

}  // namespace levitas::plant
