#pragma once
// The catalogue of effects: one row per id. Configuration, parameter access and documentation read
// this table. Diagnosis reads names, places and needs here; diagnosis/terms models effects anew.
//
// Units      every number is SI; `file_suffix` is the unit a file writes it in.
// Neutral    the value at which the plant equals the nominal one, bit for bit, or as the limit.
//            Infinity = in the limit of ever larger values; kOwn = the value that the rig has.
// Clear      a size that shows clearly on a laboratory rig; for neutral kOwn a factor on it.
// Thread     any; constant data. Failure: At() of an id outside the table is a programming error.

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "plant_sim/effect/effect_config.hpp"

namespace levitas::effect {

/// What one entry refers to.
enum class Scope : std::uint8_t { kRig, kChannels, kBearing, kMode, kGear };

/// How a value goes from neutral to full with the strength s. Fixed values (phases, orders) do not.
enum class Scaling : std::uint8_t {
  kLinear,     ///< neutral + s (value - neutral)
  kInverse,    ///< value / s: neutral at infinity
  kGeometric,  ///< own^(1-s) value^s
  kFixed
};

inline constexpr double kOwn = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kNever = std::numeric_limits<double>::infinity();

struct Parameter {
  std::string_view stem;         ///< "amplitude": amplitude_m in the program, amplitude_um in files
  std::string_view si_suffix;    ///< empty: a pure number
  std::string_view file_suffix;  ///< of the same dimension
  double low{};
  double high{};
  double clear{};
  double neutral{};
  Scaling scaling{Scaling::kLinear};
  std::optional<double> fallback;  ///< when a file leaves it out; none = required
  std::string_view meaning;
  bool whole{};  ///< an order or a count
};

/// Which picture shows it best.
enum class Shows : std::uint8_t {
  kResponse,  ///< frequency response of the plant
  kSpectrum,  ///< orbit and spectrum of the turning rotor
  kForce,     ///< force over current and displacement
  kGearMesh
};

/// How it enters the modes of the rotor (`amb modes`).
enum class Modes : std::uint8_t {
  kNone,        ///< adds a force or a reading
  kOnTheRotor,  ///< changes them with the rotor free in its bearings
  kTurning,     ///< changes them periodically with the angle: no modes of their own
  kOnTheLoop    ///< only with the loop closed
};

/// Each says something of the effect that others ask for; what is left out is false.
struct Facts {
  bool repeats{};           ///< several entries on one place add up; else one each
  bool needs_rotation{};    ///< shows only while the shaft turns: by its angle, speed or teeth
  bool needs_excitation{};  ///< hardly shows without a test signal: adds no force
  Shows shows_in{Shows::kSpectrum};
  Modes modes{Modes::kNone};
};

struct Row {
  Id id;
  std::string_view name;
  Place place;
  Scope scope;
  std::span<const Parameter> parameters;
  std::string_view meaning;
  std::string_view equation;
  std::string_view signature;  ///< what it changes: order, place, sign
  std::string_view source;
  Facts facts;
  /// Of one that is no entry of the list `effects`: the key of a rig file that stands for it.
  /// Empty: an entry; or, of IsEntry false, nothing in a rig file does.
  std::string_view rig_key{};
};

/// Whether the list `effects` of a rig file takes it. Those of coils on a voltage and of a ball are
/// found by a diagnosis; a simulated rig has them by keys of its coil, or not at all.
[[nodiscard]] bool IsEntry(const Row& row) noexcept;
/// What to do where one that is none was written; a clause without a full stop.
[[nodiscard]] std::string InPlaceOfAnEntry(const Row& row);

/// All rows, in the order of Id.
[[nodiscard]] std::span<const Row> Catalogue();
/// Those that the list `effects` of a rig file takes, in the same order.
[[nodiscard]] std::span<const Row> EntryRows();
[[nodiscard]] const Row& At(Id id);
/// Null when no effect has this name.
[[nodiscard]] const Row* Find(std::string_view name);
/// Of lists that come from files, options and reports, or go there. What the catalogue lacks is
/// left out.
[[nodiscard]] std::vector<Id> IdsOf(std::span<const std::string> names);
[[nodiscard]] std::vector<std::string> NamesOf(std::span<const Id> ids);
/// Order of tables by effect: that of the names, so that it stays when ids are added between.
struct ByName {
  [[nodiscard]] bool operator()(Id one, Id other) const { return At(one).name < At(other).name; }
};
[[nodiscard]] std::string_view Name(Place place) noexcept;
[[nodiscard]] std::string_view Name(Scope scope) noexcept;

/// "amplitude_um": the key of a rig file; "amplitude_m": the same quantity in SI.
[[nodiscard]] std::string FileKey(const Parameter& parameter);
[[nodiscard]] std::string SiName(const Parameter& parameter);

/// An entry with every value at its clear size (`own` supplies what the rig has, see kOwn).
[[nodiscard]] EffectConfig ClearEntry(Id id, double own = 1.0);

// The rows by place; one file each.
[[nodiscard]] std::span<const Row> LoopRows();
[[nodiscard]] std::span<const Row> MagnetRows();
[[nodiscard]] std::span<const Row> SensorRows();
[[nodiscard]] std::span<const Row> RotorRows();
[[nodiscard]] std::span<const Row> ExternalRows();
[[nodiscard]] std::span<const Row> GearRows();
[[nodiscard]] std::span<const Row> CoilRows();
[[nodiscard]] std::span<const Row> BallRows();

}  // namespace levitas::effect
