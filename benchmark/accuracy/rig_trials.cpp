#include "benchmark/accuracy/rig_trials.hpp"

#include "benchmark/accuracy/hidden_effect.hpp"

namespace levitas::accuracy {
namespace {

using effect::Id;

RigTrials FlexibleRotor() {
  RigTrials trials;
  for (const Id id : HiddenIds()) trials.effects.push_back({id, 1.0});
  return trials;
}

/// Twenty times as fast and balanced accordingly. Its loop has little margin: a test signal moves
/// it far, and a delay of half a sample is the most it bears.
RigTrials Pump() {
  RigTrials trials;
  trials.effects = {{Id::kMagneticSaturation, 1.0},
                    {Id::kSensorNonlinearity, 1.0},
                    {Id::kExtraDelay, 0.35},
                    {Id::kCurrentGain, 0.5},
                    {Id::kDisplacementStiffness, 0.5},
                    {Id::kAmplifierBandwidth, 0.5},
                    {Id::kSensorGain, 0.5},
                    {Id::kEddyCurrent, 1.0},
                    {Id::kModalFrequency, 1.0},
                    {Id::kUnbalance, 0.1}};
  trials.campaign.spinning_rpm = 18e3;
  trials.spinning_from_rpm = 16e3;
  trials.spinning_to_rpm = 20e3;
  trials.campaign.runup_from_rpm = 9e3;
  trials.campaign.runup_to_rpm = 21e3;
  trials.campaign.excitation_a = 0.1;
  trials.campaign.limit_m = 60e-6;  // half the clearance: a diagnosis leaves out what is beyond
  trials.mismatch.unbalance_kg_m = 0.2e-6;
  trials.runup_share = 0.5;                 // twice the samples in a second
  trials.mismatch.sensor_position_m = 0.0;  // its modes are known at the sensors alone
  trials.mismatch.sensor_offset_m = 3e-6;
  trials.mismatch.sensor_runout_m = 0.4e-6;
  return trials;
}

/// Slow, pushed by its teeth all the time.
RigTrials Geared() {
  RigTrials trials;
  trials.effects = {{Id::kMeshStiffness, 1.0},     {Id::kMeshStiffnessVariation, 1.0},
                    {Id::kBacklash, 0.1},          {Id::kMeshFriction, 1.0},
                    {Id::kTransmissionError, 1.0}, {Id::kGearRunout, 1.0},
                    {Id::kToothCrack, 1.0},        {Id::kCurrentGain, 1.0},
                    {Id::kSensorGain, 1.0},        {Id::kSensorRunout, 1.0},
                    {Id::kExtraDelay, 1.0}};
  trials.spinning_from_rpm = 1000.0;
  trials.spinning_to_rpm = 1600.0;
  trials.campaign.runup_from_rpm = 480.0;
  trials.campaign.runup_to_rpm = 1800.0;
  trials.campaign.excitation_a = 0.3;
  trials.campaign.limit_m = 200e-6;  // half the way to the stator
  return trials;
}

}  // namespace

double RigTrials::Factor(Id id) const noexcept {
  for (const SizeOnRig& entry : effects) {
    if (entry.id == id) return entry.factor;
  }
  return 1.0;
}

RigTrials TrialsOf(const configuration::RigFile& rig) {
  if (rig.numbers.name == "turbomolecular_pump") return Pump();
  if (!rig.plant.shafts.empty()) return Geared();
  return FlexibleRotor();
}

}  // namespace levitas::accuracy
