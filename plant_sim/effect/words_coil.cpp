// Words of the workshop: coils on a voltage with their current probes, a ball between two magnets.
#include <array>

#include "plant_sim/effect/workshop.hpp"

namespace levitas::effect {
namespace {

/// None of them is severe by its size alone, or a reason to stop.
constexpr Words Of(std::string_view effect, std::string_view name, std::string_view opposite,
                   std::string_view size, SizeForm form, std::string_view does,
                   std::string_view check, std::string_view of = "") {
  return {effect, name, opposite, size, form, of, Yardstick::kNone, Stop::kRunOn, does, check};
}

constexpr std::array kCoils{
    Of("supply_voltage", "Supply voltage is too high", "Supply voltage is too low", "ratio",
       SizeForm::kOff, "The coils get another current for the same duty.",
       "Measure the supply under load; check cable and fuse."),
    Of("coil_resistance", "Resistance of the coils is too high",
       "Resistance of the coils is too low", "ratio", SizeForm::kOff,
       "The coils get another current for the same duty.",
       "Measure the resistance of both coils cold; look for a bad plug or shorted turns."),
    Of("coil_inductance", "Inductance of the coils is too high",
       "Inductance of the coils is too low", "ratio", SizeForm::kOff,
       "Current rises more slowly, or faster, than designed for.",
       "Measure the inductance of both coils; look for shorted turns or a displaced core."),
    Of("inductance_profile", "Inductance falls too little with the gap",
       "Inductance falls too much with the gap", "gap_dependence", SizeForm::kPercent,
       "Current depends on the ball's place otherwise than designed for.",
       "Measure the inductance at two gaps; check the core and the ball's material.",
       "of the designed fall"),
    Of("voltage_drop", "Bridge drops voltage", "", "dead_band", SizeForm::kPlain,
       "Small commands do nothing: the ball wanders about its place.",
       "Measure the bridge's output at small duty; check its dead time."),
    Of("drive_nonlinearity", "Drive is not straight over its command", "", "curvature",
       SizeForm::kPlain, "The loop has another gain at large commands than at small ones.",
       "Measure current over duty of each coil."),
    Of("drive_asymmetry", "Lower coil gets more current than the upper one",
       "Lower coil gets less current than the upper one", "ratio", SizeForm::kOff,
       "Force is no longer the same up and down.", "Measure both coils' current at the same duty."),
    Of("coil_heating", "Coils warm up and lose current", "Coils cool down and gain current",
       "resistance", SizeForm::kPercent, "Force changes while the machine runs.",
       "Measure the coils' temperature; let them cool, lower the load.",
       "of resistance per second"),
    Of("motion_emf", "Motion of the ball induces more voltage",
       "Motion of the ball induces less voltage", "share", SizeForm::kPercent,
       "Fast motion changes the current by itself.",
       "Enter it in the rig file, or control the current in a loop of its own.",
       "of all that it could"),
    Of("mutual_inductance", "One coil feels the other's field", "", "share", SizeForm::kPercent,
       "The two currents disturb each other.",
       "Check the distance of the cores and the sense of the windings."),
    Of("current_sensor_gain", "Current probes read too much", "Current probes read too little",
       "ratio", SizeForm::kOff, "The force is thought to be another than it is.",
       "Calibrate the current probes with a meter."),
    Of("current_sensor_offset", "Current probes' zero is off", "", "offset", SizeForm::kPlain,
       "The force is thought to be another than it is.",
       "Read the probes without a current and trim their zero."),
    Of("current_sensor_bandwidth", "Current probes lag", "", "lag", SizeForm::kPlain,
       "The current is seen later than it flows.", "Check the filter of the probes' channels."),
    Of("force_exponent", "Force follows the current by another power", "", "exponent",
       SizeForm::kPlain, "The loop has another gain at large currents.",
       "Measure force over current with a scale; check the cores for saturation."),
    Of("viscous_damping", "Something damps the ball", "", "damping", SizeForm::kPlain,
       "The ball moves less than designed for.", "Check guides and cables that touch it."),
    Of("dry_friction", "Something rubs on the ball", "", "force", SizeForm::kPlain,
       "The ball sticks at small motion.", "Check guides and cables that touch it; clean them."),
};

}  // namespace

std::span<const Words> WordsOfCoils() { return kCoils; }

}  // namespace levitas::effect
