#include "diagnosis/levitator/causes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace levitas::levitator {
namespace {

void AddCause(const char* where, std::vector<std::size_t> moves, std::vector<Cause>& causes) {
  causes.push_back({std::string(Table()[moves.front()].effect), where, std::move(moves), 0.0});
}

/// Of the loop, the coils, what their current does, and their probes.
void AddCoilCauses(std::vector<Cause>& causes) {
  AddCause("whole rig", {kDelay}, causes);
  AddCause("both coils", {kSupply}, causes);
  AddCause("both coils", {kResistance}, causes);
  AddCause("both coils", {kInductance}, causes);
  AddCause("lower coil", {kAwayInductance}, causes);
  AddCause("both coils", {kProfile}, causes);
  AddCause("both coils, another size at no gap", {kProfile, kInductance}, causes);
  AddCause("inductance", {kIronInductance}, causes);
  AddCause("force", {kForceKnee}, causes);
  AddCause("force and inductance", {kForceKnee, kIronInductance}, causes);
  AddCause("both coils", {kDeadBand}, causes);
  AddCause("upper coil", {kCommandUpper}, causes);
  AddCause("lower coil", {kCommandLower}, causes);
  AddCause("both coils", {kDriveCurve}, causes);
  AddCause("both coils", {kHeating}, causes);
  AddCause("both coils", {kMotionEmf}, causes);
  AddCause("winding", {kEddyShare}, causes);
  AddCause("force", {kForceLag}, causes);
  AddCause("winding and force", {kEddyShare, kForceLag}, causes);
  AddCause("both coils", {kMutual}, causes);
  AddCause("lower coil", {kAwaySupply}, causes);
  AddCause("both probes", {kProbeGain}, causes);
  AddCause("both probes", {kProbeOffset}, causes);
  AddCause("both probes", {kProbeLag}, causes);
}

/// Of the force over current and place, the position sensor and the ball.
void AddBallCauses(std::vector<Cause>& causes) {
  AddCause("ball_x", {kForce}, causes);
  AddCause("ball_x", {kForceDecay}, causes);
  AddCause("both coils", {kForceExponent}, causes);
  AddCause("lower coil", {kForceAway}, causes);
  AddCause("ball_x", {kSensorGain}, causes);
  AddCause("ball_x", {kSensorOffset}, causes);
  AddCause("ball_x", {kSensorSquare, kSensorCube}, causes);
  AddCause("ball_x", {kSensorLag}, causes);
  AddCause("ball", {kMass}, causes);
  AddCause("ball_x", {kLoad}, causes);
  AddCause("ball", {kDamping}, causes);
  AddCause("ball", {kDryFriction}, causes);
  AddCause("ball_x", {kSpring}, causes);
}

std::vector<Cause> Make() {
  std::vector<Cause> causes;
  AddCoilCauses(causes);
  AddBallCauses(causes);
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
    Group{"voltage_drop", "command_offset", "drive_nonlinearity", "supply_voltage", ""},
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
