#include "diagnosis/levitator/causes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace levitas::levitator {
namespace {

std::vector<Cause> Make() {
  std::vector<Cause> causes;
  const auto add = [&](const char* where, std::vector<std::size_t> moves) {
    causes.push_back({std::string(Table()[moves.front()].effect), where, std::move(moves), 0.0});
  };
  add("whole rig", {kDelay});
  add("both coils", {kSupply});
  add("both coils", {kResistance});
  add("both coils", {kInductance});
  add("lower coil", {kAwayInductance});
  add("both coils", {kProfile});
  add("both coils, another size at no gap", {kProfile, kInductance});
  add("inductance", {kIronInductance});
  add("force", {kForceKnee});
  add("force and inductance", {kForceKnee, kIronInductance});
  add("both coils", {kDeadBand});
  add("both coils", {kDriveCurve});
  add("both coils", {kHeating});
  add("both coils", {kMotionEmf});
  add("winding", {kEddyShare});
  add("force", {kForceLag});
  add("winding and force", {kEddyShare, kForceLag});
  add("both coils", {kMutual});
  add("lower coil", {kAwaySupply});
  add("both probes", {kProbeGain});
  add("both probes", {kProbeOffset});
  add("both probes", {kProbeLag});
  add("ball_x", {kForce});
  add("ball_x", {kForceDecay});
  add("both coils", {kForceExponent});
  add("lower coil", {kForceAway});
  add("ball_x", {kSensorGain});
  add("ball_x", {kSensorOffset});
  add("ball_x", {kSensorSquare, kSensorCube});
  add("ball_x", {kSensorLag});
  add("ball", {kMass});
  add("ball_x", {kLoad});
  add("ball", {kDamping});
  add("ball", {kDryFriction});
  add("ball_x", {kSpring});
  for (Cause& cause : causes) {
    const auto same = std::count_if(causes.begin(), causes.end(), [&](const Cause& other) {
      return other.effect == cause.effect;
    });
    cause.log_prior = -std::log(static_cast<double>(same));
  }
  return causes;
}

using Group = std::array<std::string_view, 5>;
constexpr std::array kGroups{
    Group{"current_gain", "rotor_mass", "sensor_offset", "current_sensor_gain", "force_exponent"},
    Group{"supply_voltage", "coil_resistance", "coil_inductance", "current_sensor_gain", ""},
    Group{"displacement_stiffness", "coupling_stiffness", "sensor_gain", "static_load", ""},
    Group{"extra_delay", "current_sensor_bandwidth", "eddy_current", "", ""},
    Group{"inductance_profile", "coil_inductance", "magnetic_saturation", "", ""},
    Group{"voltage_drop", "drive_nonlinearity", "supply_voltage", "", ""},
    Group{"viscous_damping", "dry_friction", "sensor_bandwidth", "", ""}};

bool Has(const Group& group, const std::string& effect) {
  return std::find(group.begin(), group.end(), effect) != group.end();
}

}  // namespace

bool Alike(const std::string& one, const std::string& other) {
  return one != other && std::any_of(kGroups.begin(), kGroups.end(), [&](const Group& group) {
           return Has(group, one) && Has(group, other);
         });
}

const std::vector<Cause>& Causes() {
  static const std::vector<Cause> kCauses = Make();
  return kCauses;
}

}  // namespace levitas::levitator
