#pragma once
// What an effect is called in a workshop, what it does to the machine, and what to do about it: one
// row per id, beside the catalogue (catalogue.hpp). What a diagnosis tells people reads this table.
//
// Name      two where the sign matters: above and below the neutral value of the parameter `size`.
// Size      the parameter that says how large it is, by its stem in the catalogue.
// Severity  from the size alone where a standard or a margin says so (Yardstick); the limits stand
//           with their sources below. Elsewhere only orbit and currents can tell.
// Stop      whether the machine may go on running, once it is certain that the effect is there.
// Thread    any; constant data. Failure: Words() of an id outside the table is a programming error.
// Not done  no numbers of a rig, no sentences made of values: diagnosis/report/workshop_text.hpp.

#include <span>
#include <string_view>

#include "plant_sim/effect/effect_config.hpp"

namespace levitas::effect {

/// How its size is said.
enum class SizeForm : std::uint8_t {
  kPlain,    ///< number and unit
  kPercent,  ///< a share of 1
  kOff       ///< a factor on the nominal value: by how many per cent it is off
};

/// By what its size is judged.
enum class Yardstick : std::uint8_t {
  kNone,       ///< the size alone does not say it
  kGrows,      ///< severe at any size, because it grows while the machine runs
  kClearance,  ///< a deflection over the touchdown clearance
  kBalance,    ///< a moment times the rated speed over the rotor's mass
  kLoopGain    ///< a factor on the gain of the loop
};

enum class Stop : std::uint8_t {
  kRunOn,     ///< nothing is lost by running on
  kIfSevere,  ///< when it is severe
  kAtOnce
};

struct Words {
  std::string_view effect;    ///< its name in files
  std::string_view name;      ///< "Crack in the shaft"
  std::string_view opposite;  ///< below the neutral value; empty: the same name
  std::string_view size;      ///< stem of the parameter that says how large it is
  SizeForm form{SizeForm::kPlain};
  std::string_view of;  ///< behind the number: "of the shaft's diameter deep"
  Yardstick yardstick{Yardstick::kNone};
  Stop stop{Stop::kRunOn};
  std::string_view does;   ///< to the machine; a sentence
  std::string_view check;  ///< what to look at or measure, and what to do; sentences
};

/// Of the touchdown clearance, where zones A/B, B/C and C/D of shaft displacement meet:
/// ISO 14839-2:2004, table 1.
inline constexpr double kZoneAB = 0.3;
inline constexpr double kZoneBC = 0.4;
inline constexpr double kZoneCD = 0.5;

/// [m/s] balance quality grades G 2.5 (turbines, machine tool drives) and G 6.3 (pumps, general
/// machinery): ISO 21940-11:2016, table 1.
inline constexpr double kGradeFine = 2.5e-3;
inline constexpr double kGradeGeneral = 6.3e-3;

/// A loop whose largest sensitivity is S stays stable for gains from S/(S + 1) to S/(S - 1):
/// Skogestad & Postlethwaite 2005, Multivariable Feedback Control, 2nd ed., ch. 2. S = 3 is the end
/// of zone A, ISO 14839-3:2006.
inline constexpr double kZoneASensitivity = 3.0;
inline constexpr double kLeastGain = kZoneASensitivity / (kZoneASensitivity + 1.0);
inline constexpr double kMostGain = kZoneASensitivity / (kZoneASensitivity - 1.0);

/// All rows, in the order of Id.
[[nodiscard]] std::span<const Words> Workshop();
[[nodiscard]] const Words& WordsOf(Id id);
/// Null when no effect of the catalogue has this name.
[[nodiscard]] const Words* FindWords(std::string_view effect);

// The rows by place; one file each.
[[nodiscard]] std::span<const Words> WordsOfElectronics();
[[nodiscard]] std::span<const Words> WordsOfMechanics();
[[nodiscard]] std::span<const Words> WordsOfCoils();

}  // namespace levitas::effect
