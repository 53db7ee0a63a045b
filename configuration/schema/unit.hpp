#pragma once
// Units a person may write in the key of a file, and their exact conversion to SI.
//
// A number is converted from its text, not from a rounded double: "457.2" under a key in mm becomes
// the double nearest to 0.4572. Units that are powers of ten shift the decimal exponent; the others
// (rpm, deg) multiply in long double and round once. FromSi finds the shortest text that converts
// back to the same bits, so a written file reads back exactly.
//
// Thread   any. Failure: an unreadable text is a value (nullopt), never an exception.

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace levitas::configuration {

struct Unit {
  std::string_view suffix;     ///< of the key, "mm"; empty: a pure number
  std::string_view symbol;     ///< for people, "mm"
  std::string_view dimension;  ///< units of one dimension may replace each other in a key
  int decimal_exponent{};      ///< SI = number x 10^decimal_exponent x factor
  long double factor{1.0L};
};

namespace unit {
inline constexpr long double kPi = 3.141592653589793238462643383279502884L;
inline constexpr Unit kOne{"", "", ""};
inline constexpr Unit kMetre{"m", "m", "length"};
inline constexpr Unit kMillimetre{"mm", "mm", "length", -3};
inline constexpr Unit kMicrometre{"um", "um", "length", -6};
inline constexpr Unit kSecond{"s", "s", "time"};
inline constexpr Unit kMillisecond{"ms", "ms", "time", -3};
inline constexpr Unit kMicrosecond{"us", "us", "time", -6};
inline constexpr Unit kHertz{"hz", "Hz", "frequency"};
inline constexpr Unit kKilohertz{"khz", "kHz", "frequency", 3};
inline constexpr Unit kKilobitPerSecond{"kbit_per_s", "kbit/s", "bit rate", 3};
inline constexpr Unit kMegabitPerSecond{"mbit_per_s", "Mbit/s", "bit rate", 6};
inline constexpr Unit kRpm{"rpm", "rpm", "speed", 0, kPi / 30.0L};
inline constexpr Unit kRadPerSecond{"rad_per_s", "rad/s", "speed"};
inline constexpr Unit kTurnsPerSecond{"rev_per_s", "rev/s", "speed", 0, 2.0L * kPi};
inline constexpr Unit kRpmPerSecond{"rpm_per_s", "rpm/s", "acceleration", 0, kPi / 30.0L};
inline constexpr Unit kRadPerSecond2{"rad_per_s2", "rad/s^2", "acceleration"};
inline constexpr Unit kDegree{"deg", "deg", "angle", 0, kPi / 180.0L};
inline constexpr Unit kMicroradian{"urad", "urad", "angle", -6};
inline constexpr Unit kRadian{"rad", "rad", "angle"};
inline constexpr Unit kAmpere{"a", "A", "current"};
inline constexpr Unit kMilliampere{"ma", "mA", "current", -3};
inline constexpr Unit kKilogram{"kg", "kg", "mass"};
inline constexpr Unit kGram{"g", "g", "mass", -3};
inline constexpr Unit kInertia{"kg_m2", "kg m^2", "inertia"};
inline constexpr Unit kGramMillimetre{"g_mm", "g mm", "unbalance", -6};
inline constexpr Unit kKilogramMetre{"kg_m", "kg m", "unbalance"};
inline constexpr Unit kGigapascal{"gpa", "GPa", "pressure", 9};
inline constexpr Unit kPascal{"pa", "Pa", "pressure"};
inline constexpr Unit kDensity{"kg_per_m3", "kg/m^3", "density"};
inline constexpr Unit kSquareMillimetre{"mm2", "mm^2", "area", -6};
inline constexpr Unit kSquareMetre{"m2", "m^2", "area"};
inline constexpr Unit kStiffness{"n_per_m", "N/m", "stiffness"};
inline constexpr Unit kStiffnessMicro{"n_per_um", "N/um", "stiffness", 6};
inline constexpr Unit kDamping{"n_s_per_m", "N s/m", "damping"};
inline constexpr Unit kNewton{"n", "N", "force"};
inline constexpr Unit kNewtonMetre{"n_m", "N m", "moment"};
inline constexpr Unit kBending{"n_m2", "N m^2", "bending stiffness"};
inline constexpr Unit kTorsion{"n_m_per_rad", "N m/rad", "torsional stiffness"};
inline constexpr Unit kTorsionDamping{"n_m_s_per_rad", "N m s/rad", "torsional damping"};
inline constexpr Unit kForcePerAmpere{"n_per_a", "N/A", "force per current"};
inline constexpr Unit kForcePerSquareAmpere{"n_per_a2", "N/A^2", "force per current squared"};
inline constexpr Unit kForceConstant{"n_m2_per_a2", "N m^2/A^2", "magnet constant"};
inline constexpr Unit kPerSquareAmpere{"1_per_a2", "1/A^2", "inverse current squared"};
inline constexpr Unit kAmperePerSecond{"a_per_s", "A/s", "slew"};
inline constexpr Unit kGravity{"m_per_s2", "m/s^2", "linear acceleration"};
inline constexpr Unit kPerSecond{"1_per_s", "1/s", "rate"};
inline constexpr Unit kPerMetre{"1_per_m", "1/m", "curvature"};
inline constexpr Unit kPerSquareMetre{"1_per_m2", "1/m^2", "cubic coefficient"};
inline constexpr Unit kVoltPerMetre{"v_per_m", "V/m", "signal per displacement"};
inline constexpr Unit kVoltPerMillimetre{"v_per_mm", "V/mm", "signal per displacement", 3};
inline constexpr Unit kAmperePerVolt{"a_per_v", "A/V", "current per signal"};
inline constexpr Unit kGainP{"a_per_m", "A/m", "proportional gain"};
inline constexpr Unit kGainPMilli{"a_per_mm", "A/mm", "proportional gain", 3};
inline constexpr Unit kGainI{"a_per_m_s", "A/(m s)", "integral gain"};
inline constexpr Unit kGainD{"a_s_per_m", "A s/m", "derivative gain"};
}  // namespace unit

/// Every unit, for the families and the generated documentation.
[[nodiscard]] std::span<const Unit> AllUnits() noexcept;

/// True when `text` is a plain decimal number: sign, digits, point, exponent; nothing else.
[[nodiscard]] bool IsDecimal(std::string_view text) noexcept;

/// SI value of a decimal text in `unit`; nullopt when it is no decimal number or beyond a double.
[[nodiscard]] std::optional<double> ToSi(std::string_view text, const Unit& unit) noexcept;

/// Shortest decimal text in `unit` that ToSi turns back into the same bits. `si` must be finite.
[[nodiscard]] std::string FromSi(double si, const Unit& unit);

/// Shortest text of a bound of the tables, "0.05", "1e-06".
[[nodiscard]] std::string BoundText(double bound);

}  // namespace levitas::configuration
