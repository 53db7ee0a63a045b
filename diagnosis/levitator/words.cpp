#include "diagnosis/levitator/words.hpp"

#include <initializer_list>

namespace levitas::levitator {
namespace {

using effect::SizeForm;
using effect::Words;

Words Row(std::string_view effect, std::string_view name, std::string_view opposite,
          std::string_view size, SizeForm form, std::string_view does, std::string_view check) {
  return {effect, name, opposite, size, form, "", effect::Yardstick::kNone, effect::Stop::kRunOn,
          does,   check};
}

std::vector<Words> WordsOfCoils() {
  return {
      Row("supply_voltage", "Supply voltage is too high", "Supply voltage is too low", "ratio",
          SizeForm::kOff, "The coils get another current for the same duty.",
          "Measure the supply under load; check cable and fuse."),
      Row("coil_resistance", "Resistance of the coils is too high",
          "Resistance of the coils is too low", "ratio", SizeForm::kOff,
          "The coils get another current for the same duty.",
          "Measure the resistance of both coils cold; look for a bad plug or shorted turns."),
      Row("coil_inductance", "Inductance of the coils is too high",
          "Inductance of the coils is too low", "ratio", SizeForm::kOff,
          "Current rises more slowly, or faster, than designed for.",
          "Measure the inductance of both coils; look for shorted turns or a displaced core."),
      Row("inductance_profile", "Inductance changes otherwise with the gap", "", "",
          SizeForm::kPlain, "Current depends on the ball's place otherwise than designed for.",
          "Measure the inductance at two gaps; check the core and the ball's material."),
  };
}

std::vector<Words> WordsOfDrive() {
  return {
      Row("voltage_drop", "Bridge drops voltage", "", "dead_band", SizeForm::kPlain,
          "Small commands do nothing: the ball wanders about its place.",
          "Measure the bridge's output at small duty; check its dead time."),
      Row("drive_nonlinearity", "Drive is not straight over its command", "", "curvature",
          SizeForm::kPlain, "The loop has another gain at large commands than at small ones.",
          "Measure current over duty of each coil."),
      Row("coil_heating", "Coils warm up and lose current", "", "", SizeForm::kPlain,
          "Force falls while the machine runs.",
          "Measure the coils' temperature; let them cool, lower the load."),
      Row("motion_emf", "Motion of the ball induces voltage", "", "share", SizeForm::kPercent,
          "Fast motion changes the current by itself.",
          "Enter it in the rig file, or control the current in a loop of its own."),
      Row("magnet_coupling", "One coil feels the other's field", "", "share", SizeForm::kPercent,
          "The two currents disturb each other.",
          "Check the distance of the cores and the sense of the windings."),
      Row("drive_asymmetry", "Lower coil gets more current than the upper one",
          "Lower coil gets less current than the upper one", "ratio", SizeForm::kOff,
          "Force is no longer the same up and down.",
          "Measure both coils' current at the same duty."),
  };
}

std::vector<Words> WordsOfProbes() {
  return {
      Row("current_sensor_gain", "Current probes read too much", "Current probes read too little",
          "ratio", SizeForm::kOff, "The force is thought to be another than it is.",
          "Calibrate the current probes with a meter."),
      Row("current_sensor_offset", "Current probes' zero is off", "", "offset", SizeForm::kPlain,
          "The force is thought to be another than it is.",
          "Read the probes without a current and trim their zero."),
      Row("current_sensor_bandwidth", "Current probes lag", "", "", SizeForm::kPlain,
          "The current is seen later than it flows.", "Check the filter of the probes' channels."),
  };
}

std::vector<Words> WordsOfBall() {
  return {
      Row("force_exponent", "Force follows the current by another power", "", "exponent",
          SizeForm::kPlain, "The loop has another gain at large currents.",
          "Measure force over current with a scale; check the cores for saturation."),
      Row("rotor_mass", "Ball is heavier than the file says", "Ball is lighter than the file says",
          "ratio", SizeForm::kOff, "The loop has another gain, and another current carries it.",
          "Weigh the ball; correct the file."),
      Row("viscous_damping", "Something damps the ball", "", "damping", SizeForm::kPlain,
          "The ball moves less than designed for.", "Check guides and cables that touch it."),
      Row("dry_friction", "Something rubs on the ball", "", "force", SizeForm::kPlain,
          "The ball sticks at small motion.", "Check guides and cables that touch it; clean them."),
  };
}

std::vector<Words> Joined(std::initializer_list<std::vector<Words>> tables) {
  std::vector<Words> all;
  for (const auto& table : tables) all.insert(all.end(), table.begin(), table.end());
  return all;
}

}  // namespace

const std::vector<Words>& OwnWords() {
  static const std::vector<Words> kRows =
      Joined({WordsOfCoils(), WordsOfDrive(), WordsOfProbes(), WordsOfBall()});
  return kRows;
}

}  // namespace levitas::levitator
