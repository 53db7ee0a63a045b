#include "diagnosis/levitator/causes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace levitas::levitator {
namespace {

using diagnosis::Hypothesis;
using effect::Id;

void Put(const char* where, std::vector<std::size_t> moves, std::vector<Hypothesis>& causes) {
  Hypothesis& cause = causes.emplace_back();
  cause.effect = Table()[moves.front()].effect;
  cause.place = where;
  cause.terms = std::move(moves);
}

/// Of the loop, the coils, what their current does, and their probes.
void AddCoilCauses(std::vector<Hypothesis>& causes) {
  Put("whole rig", {kDelay}, causes);
  Put("both coils", {kSupply}, causes);
  Put("both coils", {kResistance}, causes);
  Put("both coils", {kInductance}, causes);
  Put("lower coil", {kAwayInductance}, causes);
  Put("both coils", {kProfile}, causes);
  Put("both coils, another size at no gap", {kProfile, kInductance}, causes);
  Put("inductance", {kIronInductance}, causes);
  Put("force", {kForceKnee}, causes);
  Put("force and inductance", {kForceKnee, kIronInductance}, causes);
  Put("both coils", {kDeadBand}, causes);
  Put("upper coil", {kCommandUpper}, causes);
  Put("lower coil", {kCommandLower}, causes);
  Put("both coils", {kDriveCurve}, causes);
  Put("both coils", {kHeating}, causes);
  Put("both coils", {kMotionEmf}, causes);
  Put("winding", {kEddyShare}, causes);
  Put("force", {kForceLag}, causes);
  Put("winding and force", {kEddyShare, kForceLag}, causes);
  Put("both coils", {kMutual}, causes);
  Put("lower coil", {kAwaySupply}, causes);
  Put("both probes", {kProbeGain}, causes);
  Put("both probes", {kProbeOffset}, causes);
  Put("both probes", {kProbeLag}, causes);
}

/// Of the force over current and place, the position sensor and the ball.
void AddBallCauses(std::vector<Hypothesis>& causes) {
  Put("ball_x", {kForce}, causes);
  Put("ball_x", {kForceDecay}, causes);
  Put("both coils", {kForceExponent}, causes);
  Put("lower coil", {kForceAway}, causes);
  Put("ball_x", {kSensorGain}, causes);
  Put("ball_x", {kSensorOffset}, causes);
  Put("ball_x", {kSensorSquare, kSensorCube}, causes);
  Put("ball_x", {kSensorLag}, causes);
  Put("ball", {kMass}, causes);
  Put("ball_x", {kLoad}, causes);
  Put("ball", {kDamping}, causes);
  Put("ball", {kDryFriction}, causes);
  Put("ball_x", {kSpring}, causes);
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

const std::vector<diagnosis::Hypothesis>& AllCauses() {
  static const std::vector<Hypothesis> kCauses = Make();
  return kCauses;
}

}  // namespace levitas::levitator
