#include "diagnosis/levitator/causes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace levitas::levitator {
namespace {

using diagnosis::Hypothesis;
using effect::Id;

void AddCause(const char* where, std::vector<std::size_t> moves, std::vector<Hypothesis>& causes) {
  Hypothesis& cause = causes.emplace_back();
  cause.effect = Table()[moves.front()].effect;
  cause.place = where;
  cause.terms = std::move(moves);
}

/// Of the loop, the coils, what their current does, and their probes.
void AddCoilCauses(std::vector<Hypothesis>& causes) {
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
void AddBallCauses(std::vector<Hypothesis>& causes) {
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

std::vector<Hypothesis> Make() {
  std::vector<Hypothesis> causes;
  AddCoilCauses(causes);
  AddBallCauses(causes);
  for (Hypothesis& cause : causes) {
    const auto same = std::count_if(causes.begin(), causes.end(), [&](const Hypothesis& other) {
      return other.effect == cause.effect;
    });
    cause.log_prior = -std::log(static_cast<double>(same));
  }
  return causes;
}

/// Effects that do much the same to the data by their physics.
using Group = std::vector<Id>;
const std::vector<Group>& Groups() {
  static const std::vector<Group> kGroups{
      {Id::kForceConstant, Id::kRotorMass, Id::kSensorOffset, Id::kCurrentSensorGain,
       Id::kForceExponent},
      {Id::kSupplyVoltage, Id::kCoilResistance, Id::kCoilInductance, Id::kCurrentSensorGain},
      {Id::kDisplacementStiffness, Id::kCouplingStiffness, Id::kSensorGain, Id::kStaticLoad},
      {Id::kExtraDelay, Id::kCurrentSensorBandwidth, Id::kEddyCurrent},
      {Id::kInductanceProfile, Id::kCoilInductance, Id::kMagneticSaturation},
      {Id::kVoltageDrop, Id::kCommandOffset, Id::kDriveNonlinearity, Id::kSupplyVoltage},
      {Id::kViscousDamping, Id::kDryFriction, Id::kSensorBandwidth},
  };
  return kGroups;
}

bool Has(const Group& group, Id effect) {
  return std::find(group.begin(), group.end(), effect) != group.end();
}

}  // namespace

bool Alike(Id one, Id other) {
  return one != other && std::any_of(Groups().begin(), Groups().end(), [&](const Group& group) {
           return Has(group, one) && Has(group, other);
         });
}

const std::vector<diagnosis::Hypothesis>& Causes() {
  static const std::vector<Hypothesis> kCauses = Make();
  return kCauses;
}

}  // namespace levitas::levitator
