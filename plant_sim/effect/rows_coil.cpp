// Catalogue: coils on a voltage with their current probes, and a ball between two magnets.
#include "plant_sim/effect/parameter_kinds.hpp"
#include "plant_sim/effect/placed_id.hpp"

namespace levitas::effect {
namespace {

constexpr Parameter Value(std::string_view stem, std::string_view unit, double most, double clear,
                          std::string_view meaning) {
  return {stem,         unit,    unit, -most, most, clear, 0.0, Scaling::kLinear,
          std::nullopt, meaning, false};
}

constexpr Parameter Size(std::string_view stem, std::string_view unit, double most, double clear,
                         std::string_view meaning) {
  return {stem, unit, unit, 0.0, most, clear, 0.0, Scaling::kLinear, std::nullopt, meaning, false};
}

constexpr std::array kSupply{Ratio(0.01, 100.0, 1.12, "over that of the rig file")};
constexpr std::array kResistance{Ratio(0.1, 10.0, 1.12, "over that of the rig file")};
constexpr Parameter Named(std::string_view stem, Parameter parameter) {
  parameter.stem = stem;
  return parameter;
}
constexpr std::array kInductance{
    Ratio(0.05, 20.0, 1.35, "over that of the rig file"),
    Named("ratio_away", Ratio(0.05, 20.0, 1.35, "of the lower coil alone, beside it"))};
constexpr std::array kProfile{
    Value("gap_dependence", "", 10.0, 0.4, "share of the fall with the gap that is missing")};
constexpr std::array kDrop{
    Size("dead_band", "a", 100.0, 0.1, "what the bridge takes from all that is commanded")};
constexpr std::array kCurvature{Value("curvature", "", 1.0, 0.3, "q of the drive")};
constexpr std::array kAsymmetry{
    Ratio(0.01, 100.0, 1.15, "current at last of the lower coil over that of the upper one")};
constexpr std::array kHeating{
    Value("resistance", "1_per_s", 1.0, 0.008, "resistance gained per second")};
constexpr std::array kEmf{
    Value("share", "", 1e6, 0.5, "of the voltage that the motion induces, beyond the rig file's")};
constexpr std::array kMutual{
    Value("share", "", 1.0, 0.08, "of one coil's change of current that the other one feels")};
constexpr std::array kProbeGain{Ratio(0.1, 10.0, 1.06, "reading over the current")};
constexpr std::array kProbeOffset{Value("offset", "a", 10.0, 0.05, "reading without a current")};
constexpr std::array kProbeLag{Value("lag", "s", 0.1, 1e-3, "of the reading")};
constexpr std::array kExponent{Value("exponent", "", 2.0, 0.2, "n beyond the square")};
constexpr std::array kDamping{
    Value("damping", "n_s_per_m", 1e6, 0.3, "force against the velocity, over it")};
constexpr std::array kFriction{Size("force", "n", 1e6, 0.02, "against the motion, at any speed")};

constexpr std::string_view kCoilLaw =
    "Schweitzer & Maslen 2009, Magnetic Bearings, ch. 3; docs/derivations.md (19a), (19b)";
constexpr std::string_view kForceLaw = "Schweitzer & Maslen 2009, Magnetic Bearings, ch. 3";
constexpr Facts kMoving{.needs_excitation = true, .shows_in = Shows::kResponse};
constexpr Facts kStanding{.shows_in = Shows::kForce};

constexpr std::array kCoilRows{
    Row{Id::kSupplyVoltage, "supply_voltage", Place::kCoil, Scope::kRig, kSupply,
        "the voltage behind the duty differs from nominal", "g -> ratio g in (19b)",
        "current at last scaled by ratio, its lag unchanged", kCoilLaw, kStanding,
        "steady of amplifier.voltage"},
    Row{Id::kCoilResistance, "coil_resistance", Place::kCoil, Scope::kRig, kResistance,
        "the resistance of both coils differs from nominal", "r -> ratio r in (19b)",
        "current at last and lag both divided by ratio", kCoilLaw, kStanding,
        "steady, offset_ma and time_constant_ms of amplifier.voltage, each over the ratio,"},
    Row{Id::kCoilInductance, "coil_inductance", Place::kCoil, Scope::kRig, kInductance,
        "the inductance of both coils differs from nominal", "tau0 -> ratio tau0 in (19b)",
        "lag of the current scaled by ratio at every gap alike, current at last unchanged",
        kCoilLaw, kMoving, "time_constant_ms and away_time_constant_ratio of amplifier.voltage"},
    Row{Id::kInductanceProfile, "inductance_profile", Place::kCoil, Scope::kRig, kProfile,
        "the inductance falls otherwise with the gap than nominal",
        "1/d -> (1 - gap_dependence)/d in (19a)",
        "lag of the current that changes with the place of the ball", kCoilLaw, kMoving,
        "decay_mm of amplifier.voltage"},
    Row{Id::kVoltageDrop, "voltage_drop", Place::kCoil, Scope::kRig, kDrop,
        "the bridge drops voltage", "v = max(0, c - dead_band) in (19b)",
        "current too low by the same amount at every command", kCoilLaw, kStanding,
        "dead_band_ma of amplifier.voltage"},
    Row{Id::kDriveNonlinearity, "drive_nonlinearity", Place::kCoil, Scope::kRig, kCurvature,
        "the current at last is no straight line over the command",
        "u = v + curvature v (1 - c/c_max) in (19b)",
        "gain that falls with the command; nothing at full command", kCoilLaw, kStanding,
        "curvature of amplifier.voltage"},
    Row{Id::kDriveAsymmetry, "drive_asymmetry", Place::kCoil, Scope::kRig, kAsymmetry,
        "the lower coil gets another current for the same duty", "g -> ratio g of one coil",
        "a static force that grows with the square of the bias", kCoilLaw, kStanding,
        "away_steady_ratio of amplifier.voltage"},
    Row{Id::kCoilHeating, "coil_heating", Place::kCoil, Scope::kRig, kHeating, "the coils warm up",
        "r = 1 + resistance t in (19b)", "current at last that falls through the record", kCoilLaw,
        kStanding, "warming_1_per_s of amplifier.voltage"},
    Row{Id::kMotionEmf, "motion_emf", Place::kCoil, Scope::kRig, kEmf,
        "the motion of the ball induces voltage", "epsilon -> epsilon + share in (19a)",
        "current that changes with the velocity of the ball", kCoilLaw, kMoving,
        "motion_emf of amplifier.voltage"},
    Row{Id::kMutualInductance, "mutual_inductance", Place::kCoil, Scope::kRig, kMutual,
        "a change of one coil's current drives one in the other",
        "di1/dt -> di1/dt - share di2/dt, and the same the other way round",
        "the two currents move against each other when one of them changes", kForceLaw, kMoving},
    Row{Id::kCurrentSensorGain, "current_sensor_gain", Place::kCoil, Scope::kRig, kProbeGain,
        "the scale of the current probes is wrong", "reading = ratio i",
        "measured currents scaled by ratio; force and motion unchanged", kForceLaw, kStanding},
    Row{Id::kCurrentSensorOffset, "current_sensor_offset", Place::kCoil, Scope::kRig, kProbeOffset,
        "the zero of the current probes is off", "reading = i + offset",
        "measured currents off by a constant; force and motion unchanged", kForceLaw, kStanding},
    Row{Id::kCurrentSensorBandwidth, "current_sensor_bandwidth", Place::kCoil, Scope::kRig,
        kProbeLag, "the current probes are slower than nominal", "reading = i - lag di/dt",
        "measured currents late; force and motion unchanged", kForceLaw, kMoving},
    Row{Id::kForceExponent, "force_exponent", Place::kCoil, Scope::kRig, kExponent,
        "the force goes by another power of the current than the square",
        "F = f0 i^2 i^exponent e^(-gap/d)", "force too large at large currents, or at small ones",
        kForceLaw, kStanding},
};

constexpr std::array kBallRows{
    Row{Id::kViscousDamping, "viscous_damping", Place::kBall, Scope::kRig, kDamping,
        "something damps the ball", "F = -damping v", "force that grows with the velocity",
        "Genta 2005, Dynamics of Rotating Systems, ch. 4", kMoving},
    Row{Id::kDryFriction, "dry_friction", Place::kBall, Scope::kRig, kFriction,
        "something rubs on the ball", "F = -force tanh(v/v0),  v0 = 2 mm/s",
        "force against the motion that hardly depends on how fast it is",
        "Olsson, Astrom, Canudas de Wit, Gaefvert & Lischinsky 1998, European J. Control 4(3) 176",
        kMoving},
};

static_assert(AreAtTheirPlaces(kCoilRows) && AreAtTheirPlaces(kBallRows));

}  // namespace

std::span<const Row> CoilRows() { return kCoilRows; }
std::span<const Row> BallRows() { return kBallRows; }

}  // namespace levitas::effect
