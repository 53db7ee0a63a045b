#include "diagnosis/levitator/parameters.hpp"

namespace levitas::levitator {
namespace {

constexpr double kAny = -1e300;
constexpr const char* kAmplifier = "amplifier";
constexpr const char* kMagnet = "magnet";
constexpr const char* kSensor = "sensor";

// In the order of Parameter.
constexpr std::array<Row, kParameters> kRows{{
    {"extra_delay", "timing", "delay_samples", "samples", Side::kCoils, 0.02, 1.0, 0.0},
    {"supply_voltage", kAmplifier, "ratio", "", Side::kCoils, 0.01, 0.3, -0.9},
    {"coil_resistance", kAmplifier, "ratio", "", Side::kCoils, 0.01, 0.3, -0.9},
    {"coil_inductance", kAmplifier, "ratio", "", Side::kCoils, 0.05, 0.5, -0.95},
    {"inductance_profile", kAmplifier, "gap_dependence", "", Side::kCoils, 0.02, 1.0, kAny},
    {"magnetic_saturation", kMagnet, "inductance_1_per_a2", "1/A2", Side::kCoils, 0.0, 0.3, 0.0},
    {"voltage_drop", kAmplifier, "dead_band_a", "A", Side::kCoils, 0.005, 0.15, 0.0},
    // What is taken from a command is the bridge's drop.
    {"command_offset", kAmplifier, "offset_a", "A", Side::kCoils, 0.0, 0.1, 0.0},
    {"command_offset", kAmplifier, "offset_away_a", "A", Side::kCoils, 0.0, 0.1, 0.0},
    {"drive_nonlinearity", kAmplifier, "curvature", "", Side::kCoils, 0.0, 0.5, kAny},
    {"coil_heating", kAmplifier, "resistance_1_per_s", "1/s", Side::kCoils, 1e-4, 5e-3, kAny},
    {"motion_emf", kAmplifier, "share", "", Side::kCoils, 0.02, 1.0, kAny},
    {"eddy_current", kMagnet, "share", "", Side::kCoils, 0.0, 0.2, 0.0},
    {"magnet_coupling", kMagnet, "share", "", Side::kCoils, 0.0, 0.1, kAny},
    {"drive_asymmetry", kAmplifier, "ratio", "", Side::kCoils, 0.02, 0.3, -0.9},
    {"coil_inductance", kAmplifier, "ratio_away", "", Side::kCoils, 0.05, 0.5, -0.95},
    {"current_sensor_gain", kSensor, "ratio", "", Side::kBoth, 0.005, 0.2, -0.9},
    {"current_sensor_offset", kSensor, "offset_a", "A", Side::kBoth, 0.005, 0.1, kAny},
    {"current_sensor_bandwidth", kSensor, "lag_s", "s", Side::kBoth, 2e-5, 2e-3, kAny},
    {"current_gain", kMagnet, "ratio", "", Side::kMotion, 0.02, 0.3, -0.9},
    {"displacement_stiffness", kMagnet, "ratio", "", Side::kMotion, 0.02, 0.3, -0.9},
    {"force_exponent", kMagnet, "exponent", "", Side::kMotion, 0.0, 0.3, kAny},
    {"magnetic_saturation", kMagnet, "knee_1_per_a2", "1/A2", Side::kMotion, 0.0, 0.2, 0.0},
    {"eddy_current", kMagnet, "lag_s", "s", Side::kMotion, 0.0, 3e-3, 0.0},
    {"coil_asymmetry", kMagnet, "ratio", "", Side::kMotion, 0.03, 0.3, -0.9},
    {"sensor_gain", kSensor, "ratio", "", Side::kBoth, 0.005, 0.2, -0.9},
    {"sensor_offset", kSensor, "offset_m", "m", Side::kBoth, 30e-6, 1e-3, kAny},
    {"sensor_nonlinearity", kSensor, "a2", "1/m", Side::kBoth, 0.0, 30.0, kAny},
    {"sensor_nonlinearity", kSensor, "a3", "1/m2", Side::kBoth, 0.0, 1e4, kAny},
    {"sensor_bandwidth", kSensor, "lag_s", "s", Side::kMotion, 2e-5, 2e-3, kAny},
    {"rotor_mass", "rotor", "ratio", "", Side::kMotion, 0.003, 0.3, -0.9},
    {"static_load", "external", "force_n", "N", Side::kMotion, 0.001, 0.1, kAny},
    {"viscous_damping", "external", "damping_n_s_per_m", "N s/m", Side::kMotion, 0.005, 0.5, kAny},
    {"dry_friction", "external", "force_n", "N", Side::kMotion, 0.0, 0.02, 0.0},
    {"coupling_stiffness", "external", "stiffness_n_per_m", "N/m", Side::kMotion, 0.0, 20.0, kAny},
}};

}  // namespace

std::span<const Row> Table() { return kRows; }
const Row& At(Parameter parameter) { return kRows[parameter]; }

}  // namespace levitas::levitator
