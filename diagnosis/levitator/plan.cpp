#include "diagnosis/levitator/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "plant_sim/effect/catalogue.hpp"

namespace levitas::levitator {
namespace {

using effect::Id;

/// What a scenario can do about a pair.
struct Ways {
  bool stroke{}, shake{}, clock{};
};

/// What separates two effects.
struct Separation {
  Ways ways;
  const char* words;
};

struct Pair {
  Id one, other;
  Separation by;
};

constexpr Ways kStroke{true, false, false};
constexpr Ways kShake{false, true, false};
constexpr Ways kClock{false, false, true};
constexpr Ways kBoth{true, true, false};
constexpr Ways kNoRecord{};

constexpr const char* kProfileWords =
    "the ball led over its stroke with a test signal on the current: a profile lets the coil's lag "
    "change with the gap, an inductance is larger at every gap alike";
constexpr const char* kIronWords =
    "the ball led over its stroke and shaken: saturation depends on the current, an inductance on "
    "the air gap";
constexpr const char* kLoadWords =
    "the ball shaken: a load adds the same to every force, a mass or a force constant scales them "
    "all";
constexpr const char* kWeighWords =
    "the ball weighed: mass and force constant make the same motion of the same current, whatever "
    "is recorded";
constexpr const char* kGapWords =
    "the ball led over its stroke: effects that depend on the position then differ from those that "
    "do not";
constexpr const char* kPlaceWords =
    "the ball laid against a stop of known place: under this law of force an offset of the sensor "
    "is a force constant";
constexpr const char* kAmmeterWords =
    "an ammeter in the lead of the coil: the gain of a current probe cannot be identified from its "
    "own readings";
constexpr const char* kDriveWords =
    "the ball led over its stroke, so that the duty runs from little to much: a dead band takes "
    "the same of each, a curved drive and a supply in proportion";
constexpr const char* kLagWords =
    "a test signal of a bit per period: a delay shifts it, a lag rounds it";
constexpr const char* kResistanceWords =
    "a test signal of a bit per period: both set the current at last, a resistance its lag as well";
constexpr const char* kDampingWords =
    "the ball shaken slowly and fast: friction does not grow with the velocity, damping does, and "
    "a slow sensor with the frequency";

constexpr std::array kPairs{
    Pair{Id::kInductanceProfile, Id::kCoilInductance, {kStroke, kProfileWords}},
    Pair{Id::kInductanceProfile, Id::kMagneticSaturation, {kBoth, kIronWords}},
    Pair{Id::kCoilInductance, Id::kMagneticSaturation, {kBoth, kIronWords}},
    Pair{Id::kStaticLoad, Id::kRotorMass, {kShake, kLoadWords}},
    Pair{Id::kStaticLoad, Id::kForceConstant, {kShake, kLoadWords}},
    Pair{Id::kStaticLoad, Id::kCoilAsymmetry, {kStroke, kGapWords}},
    Pair{Id::kStaticLoad, Id::kDriveAsymmetry, {kStroke, kGapWords}},
    Pair{Id::kStaticLoad, Id::kSensorGain, {kStroke, kGapWords}},
    Pair{Id::kStaticLoad, Id::kDisplacementStiffness, {kStroke, kGapWords}},
    Pair{Id::kStaticLoad, Id::kCouplingStiffness, {kStroke, kGapWords}},
    Pair{Id::kDisplacementStiffness, Id::kCouplingStiffness, {kStroke, kGapWords}},
    Pair{Id::kDisplacementStiffness, Id::kSensorGain, {kStroke, kGapWords}},
    Pair{Id::kDisplacementStiffness, Id::kSensorNonlinearity, {kStroke, kGapWords}},
    Pair{Id::kCouplingStiffness, Id::kSensorGain, {kStroke, kGapWords}},
    Pair{Id::kRotorMass, Id::kForceConstant, {kNoRecord, kWeighWords}},
    Pair{Id::kSensorOffset, Id::kForceConstant, {kNoRecord, kPlaceWords}},
    Pair{Id::kSensorOffset, Id::kRotorMass, {kNoRecord, kPlaceWords}},
    Pair{Id::kCurrentSensorGain, Id::kForceConstant, {kNoRecord, kAmmeterWords}},
    Pair{Id::kCurrentSensorGain, Id::kSupplyVoltage, {kNoRecord, kAmmeterWords}},
    Pair{Id::kCurrentSensorGain, Id::kCoilResistance, {kNoRecord, kAmmeterWords}},
    Pair{Id::kVoltageDrop, Id::kDriveNonlinearity, {kStroke, kDriveWords}},
    Pair{Id::kVoltageDrop, Id::kSupplyVoltage, {kStroke, kDriveWords}},
    Pair{Id::kDriveNonlinearity, Id::kSupplyVoltage, {kStroke, kDriveWords}},
    Pair{Id::kSupplyVoltage, Id::kCoilResistance, {kClock, kResistanceWords}},
    Pair{Id::kExtraDelay, Id::kEddyCurrent, {kClock, kLagWords}},
    Pair{Id::kExtraDelay, Id::kCurrentSensorBandwidth, {kClock, kLagWords}},
    Pair{Id::kExtraDelay, Id::kSensorBandwidth, {kClock, kLagWords}},
    Pair{Id::kViscousDamping, Id::kDryFriction, {kShake, kDampingWords}},
    Pair{Id::kViscousDamping, Id::kSensorBandwidth, {kShake, kDampingWords}},
    Pair{Id::kDryFriction, Id::kSensorBandwidth, {kShake, kDampingWords}}};

constexpr const char* kAllWords =
    "the ball led over its stroke and shaken, with a test signal on the current";

bool AnyRecord(const Ways& ways) { return ways.stroke || ways.shake || ways.clock; }

/// Of two effects; everything that a scenario can do where the table does not know them.
Separation Between(const std::string& one, const std::string& other) {
  const auto are = [&](Id a, Id b) {
    return effect::At(a).name == one && effect::At(b).name == other;
  };
  for (const Pair& pair : kPairs) {
    if (are(pair.one, pair.other) || are(pair.other, pair.one)) return pair.by;
  }
  return {{true, true, true}, kAllWords};
}

bool Nameless(const diagnosis::DiagnosisReport& report) {
  return report.verdict == diagnosis::Verdict::kUnknown;
}

Ways WaysOf(const diagnosis::DiagnosisReport& report) {
  if (Nameless(report)) return {true, true, true};
  Ways all;
  for (const diagnosis::ReportTie& tie : report.ties) {
    for (const std::string& other : tie.others) {
      const Ways ways = Between(tie.cause, other).ways;
      all = {all.stroke || ways.stroke, all.shake || ways.shake, all.clock || ways.clock};
    }
  }
  return all;
}

}  // namespace

std::vector<std::string> Separations(const diagnosis::DiagnosisReport& report) {
  std::vector<std::string> out;
  if (Nameless(report)) {
    out.emplace_back(std::string("to learn where the residual belongs: ") + kAllWords);
  }
  for (const diagnosis::ReportTie& tie : report.ties) {
    // Told once of all that the same does for.
    std::vector<std::pair<std::string, std::string>> told;
    for (const std::string& other : tie.others) {
      const std::string words = Between(tie.cause, other).words;
      const auto same = std::find_if(told.begin(), told.end(),
                                     [&](const auto& entry) { return entry.second == words; });
      if (same != told.end()) {
        same->first += ", " + other;
      } else {
        told.emplace_back(fmt::format("{} from {}", tie.cause, other), words);
      }
    }
    for (const auto& [who, words] : told) out.push_back(fmt::format("{}: {}", who, words));
    for (std::size_t i = 0; i < tie.others.size(); ++i) {
      for (std::size_t k = i + 1; k < tie.others.size(); ++k) {
        const Separation by = Between(tie.others[i], tie.others[k]);
        if (AnyRecord(by.ways)) continue;
        out.push_back(fmt::format("{} from {}: {}", tie.others[i], tie.others[k], by.words));
      }
    }
  }
  return out;
}

std::string PlanScenario(const configuration::RigFile& rig,
                         const diagnosis::DiagnosisReport& report) {
  const Ways ways = WaysOf(report);
  if (!AnyRecord(ways)) return {};
  const plant::BearingConfig& bearing = rig.plant.bearings.at(0);
  const std::string& channel = rig.numbers.channels.front();
  constexpr double kMost = 5000.0;  // the largest that a scenario may ask for
  const double clearance_um = bearing.touchdown.clearance_m * 1e6;
  const double lead_um = std::min(0.4 * clearance_um, kMost);
  const double shake_um = std::min(0.15 * clearance_um, kMost);
  const double limit_um = std::min(0.8 * clearance_um, kMost);
  const double bias_a = bearing.magnet.bias_current_a;
  const double test_a = 0.08 * std::min(bias_a, bearing.magnet.max_coil_current_a - bias_a);
  const auto moved = [&](double hold_s, double size_um, double from_hz, double to_hz) {
    return fmt::format(
        "  - do: nothing\n    hold_s: {0:.0f}\n    orbit_limit_um: {1:.4g}\n    excitation:\n"
        "      - {{channel: {2}, signal: chirp, point: measured_position, amplitude_um: {3:.4g}, "
        "from_hz: {4:.4g}, to_hz: {5:.4g}, repeat_s: {0:.0f}}}\n",
        hold_s, limit_um, channel, size_um, from_hz, to_hz);
  };
  std::string text = "kind: scenario\nname: diagnosis_next\n\n";
  for (const std::string& words : Separations(report)) text += fmt::format("# {}.\n", words);
  text +=
      "# The ball leaves its objective on purpose: a verdict of such a run is not one of the rig.\n"
      "steps:\n  - {do: lift, until: levitating, timeout_s: 10, hold_s: 1}\n";
  if (ways.stroke) {
    text += moved(16.0, lead_um, 0.125, 0.5);
    text += fmt::format("      - {{channel: {}, amplitude_a: {:.4g}, order: 10, divisor: 8}}\n",
                        channel, test_a);
  }
  if (ways.shake) text += moved(12.0, shake_um, 2.0, 15.0);
  if (ways.clock) {
    text += fmt::format(
        "  - do: nothing\n    hold_s: 8\n    excitation:\n"
        "      - {{channel: {}, amplitude_a: {:.4g}, order: 12}}\n",
        channel, test_a);
  }
  return text + "  - {do: land, until: off, timeout_s: 10, hold_s: 0.2}\n";
}

}  // namespace levitas::levitator
