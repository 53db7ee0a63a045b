#include "diagnosis/levitator/parameters.hpp"

namespace levitas::levitator {
namespace {

using effect::Id;

constexpr double kAny = -1e300;

// In the order of Parameter.
constexpr std::array<Row, kParameters> kRows{{
    {Id::kExtraDelay, "delay_samples", "samples", Side::kCoils, 0.02, 1.0, 0.0},
    {Id::kSupplyVoltage, "ratio", "", Side::kCoils, 0.01, 0.3, -0.9},
    {Id::kCoilResistance, "ratio", "", Side::kCoils, 0.01, 0.3, -0.9},
    {Id::kCoilInductance, "ratio", "", Side::kCoils, 0.05, 0.5, -0.95},
    {Id::kInductanceProfile, "gap_dependence", "", Side::kCoils, 0.02, 1.0, kAny},
    {Id::kMagneticSaturation, "inductance_1_per_a2", "1/A2", Side::kCoils, 0.0, 0.3, 0.0},
    {Id::kVoltageDrop, "dead_band_a", "A", Side::kCoils, 0.005, 0.15, 0.0},
    // What is taken from a command is the bridge's drop.
    {Id::kCommandOffset, "offset_a", "A", Side::kCoils, 0.0, 0.1, 0.0},
    {Id::kCommandOffset, "offset_away_a", "A", Side::kCoils, 0.0, 0.1, 0.0},
    {Id::kDriveNonlinearity, "curvature", "", Side::kCoils, 0.0, 0.5, kAny},
    {Id::kCoilHeating, "resistance_1_per_s", "1/s", Side::kCoils, 1e-4, 5e-3, kAny},
    {Id::kMotionEmf, "share", "", Side::kCoils, 0.02, 1.0, kAny},
    {Id::kEddyCurrent, "share", "", Side::kCoils, 0.0, 0.2, 0.0},
    {Id::kMutualInductance, "share", "", Side::kCoils, 0.0, 0.1, kAny},
    {Id::kDriveAsymmetry, "ratio", "", Side::kCoils, 0.02, 0.3, -0.9},
    {Id::kCoilInductance, "ratio_away", "", Side::kCoils, 0.05, 0.5, -0.95},
    {Id::kCurrentSensorGain, "ratio", "", Side::kBoth, 0.005, 0.2, -0.9},
    {Id::kCurrentSensorOffset, "offset_a", "A", Side::kBoth, 0.005, 0.1, kAny},
    {Id::kCurrentSensorBandwidth, "lag_s", "s", Side::kBoth, 2e-5, 2e-3, kAny},
    {Id::kForceConstant, "ratio", "", Side::kMotion, 0.02, 0.3, -0.9},
    {Id::kDisplacementStiffness, "ratio", "", Side::kMotion, 0.02, 0.3, -0.9},
    {Id::kForceExponent, "exponent", "", Side::kMotion, 0.0, 0.3, kAny},
    {Id::kMagneticSaturation, "knee_1_per_a2", "1/A2", Side::kMotion, 0.0, 0.2, 0.0},
    {Id::kEddyCurrent, "lag_s", "s", Side::kMotion, 0.0, 3e-3, 0.0},
    {Id::kCoilAsymmetry, "ratio", "", Side::kMotion, 0.03, 0.3, -0.9},
    {Id::kSensorGain, "ratio", "", Side::kBoth, 0.005, 0.2, -0.9},
    {Id::kSensorOffset, "offset_m", "m", Side::kBoth, 30e-6, 1e-3, kAny},
    {Id::kSensorNonlinearity, "a2", "1/m", Side::kBoth, 0.0, 30.0, kAny},
    {Id::kSensorNonlinearity, "a3", "1/m2", Side::kBoth, 0.0, 1e4, kAny},
    {Id::kSensorBandwidth, "lag_s", "s", Side::kMotion, 2e-5, 2e-3, kAny},
    {Id::kRotorMass, "ratio", "", Side::kMotion, 0.003, 0.3, -0.9},
    {Id::kStaticLoad, "force_n", "N", Side::kMotion, 0.001, 0.1, kAny},
    {Id::kViscousDamping, "damping_n_s_per_m", "N s/m", Side::kMotion, 0.005, 0.5, kAny},
    {Id::kDryFriction, "force_n", "N", Side::kMotion, 0.0, 0.02, 0.0},
    {Id::kCouplingStiffness, "stiffness_n_per_m", "N/m", Side::kMotion, 0.0, 20.0, kAny},
}};

}  // namespace

std::span<const Row> Table() { return kRows; }
const Row& At(Parameter parameter) { return kRows[parameter]; }

}  // namespace levitas::levitator
