#include "configuration/schema/unit.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace levitas::configuration {
namespace {

using namespace unit;
constexpr std::array kUnits{
    kOne,
    kMetre,
    kMillimetre,
    kMicrometre,
    kSecond,
    kMillisecond,
    kMicrosecond,
    kHertz,
    kKilohertz,
    kKilobitPerSecond,
    kMegabitPerSecond,
    kRpm,
    kRadPerSecond,
    kTurnsPerSecond,
    kRpmPerSecond,
    kRadPerSecond2,
    kDegree,
    kRadian,
    kMicroradian,
    kAmpere,
    kMilliampere,
    kKilogram,
    kGram,
    kInertia,
    kGramMillimetre,
    kKilogramMetre,
    kGigapascal,
    kPascal,
    kDensity,
    kStiffness,
    kSquareMillimetre,
    kSquareMetre,
    kStiffnessMicro,
    kDamping,
    kForcePerAmpere,
    kForceConstant,
    kForcePerSquareAmpere,
    kPerSquareAmpere,
    kAmperePerSecond,
    kGravity,
    kPerSecond,
    kGainP,
    kGainPMilli,
    kGainI,
    kGainD,
    kNewton,
    kNewtonMetre,
    kBending,
    kTorsion,
    kTorsionDamping,
    kPerMetre,
    kPerSquareMetre,
    kVoltPerMetre,
    kVoltPerMillimetre,
    kAmperePerVolt,
};

/// A decimal text taken apart: value = digits x 10^exponent ("457.2" -> "457.2", 0).
struct Parts {
  std::string_view mantissa;
  int exponent{};
};

std::optional<Parts> Split(std::string_view text) noexcept {
  if (!IsDecimal(text)) return std::nullopt;
  if (text.front() == '+') text.remove_prefix(1);  // from_chars takes no plus sign
  const std::size_t e = text.find_first_of("eE");
  if (e == std::string_view::npos) return Parts{text, 0};
  Parts parts{text.substr(0, e), 0};
  std::string_view exponent = text.substr(e + 1);
  if (exponent.front() == '+') exponent.remove_prefix(1);
  const auto [end, error] =
      std::from_chars(exponent.data(), exponent.data() + exponent.size(), parts.exponent);
  // Nothing that a double can hold needs more; the limit keeps the shift from overflowing.
  if (error != std::errc{} || std::abs(parts.exponent) > 5000) return std::nullopt;
  return parts;
}

template <class Real>
std::optional<Real> Read(std::string_view mantissa, int exponent) {
  const std::string text = fmt::format("{}e{}", mantissa, exponent);
  Real value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Plain notation ("0.4572", "4510") where it is short, exponent notation elsewhere.
std::string Layout(std::string digits, int point, bool negative) {
  const int count = static_cast<int>(digits.size());
  std::string text;
  if (point > 0 && point <= 9 && point - count < 6) {
    if (count <= point) {
      text = digits + std::string(static_cast<std::size_t>(point - count), '0');
    } else {
      text = fmt::format("{}.{}", digits.substr(0, static_cast<std::size_t>(point)),
                         digits.substr(static_cast<std::size_t>(point)));
    }
  } else if (point <= 0 && point > -4) {
    text = "0." + std::string(static_cast<std::size_t>(-point), '0') + digits;
  } else {
    text = fmt::format("{}{}{}e{}", digits[0], count > 1 ? "." : "", digits.substr(1), point - 1);
  }
  return fmt::format("{}{}", negative ? "-" : "", text);
}

/// Digits and decimal point position of scientific notation: 4.572e-1 -> "4572", 0.
template <class Real>
std::string Decimal(Real value, int shift, std::optional<int> digits) {
  std::array<char, 64> buffer{};
  char* const end = buffer.data() + buffer.size();
  const auto result =
      digits ? std::to_chars(buffer.data(), end, value, std::chars_format::scientific, *digits - 1)
             : std::to_chars(buffer.data(), end, value, std::chars_format::scientific);
  std::string_view text(buffer.data(), static_cast<std::size_t>(result.ptr - buffer.data()));
  const bool negative = text.front() == '-';
  if (negative) text.remove_prefix(1);
  const auto parts = Split(text);
  std::string figures;
  for (const char c : parts->mantissa) {
    if (c != '.') figures += c;
  }
  while (figures.size() > 1 && figures.back() == '0') figures.pop_back();
  if (figures == "0") return negative ? "-0" : "0";
  return Layout(figures, parts->exponent + 1 + shift, negative);
}

bool SameBits(double a, double b) noexcept { return a == b && std::signbit(a) == std::signbit(b); }

}  // namespace

std::span<const Unit> AllUnits() noexcept { return kUnits; }

bool IsDecimal(std::string_view text) noexcept {
  std::size_t at = 0;
  const auto digits = [&] {
    const std::size_t from = at;
    while (at < text.size() && text[at] >= '0' && text[at] <= '9') ++at;
    return at - from;
  };
  const auto sign = [&] {
    if (at < text.size() && (text[at] == '-' || text[at] == '+')) ++at;
  };
  sign();
  std::size_t count = digits();
  if (at < text.size() && text[at] == '.') {
    ++at;
    count += digits();
  }
  if (count == 0) return false;
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    ++at;
    sign();
    if (digits() == 0) return false;
  }
  return at == text.size();
}

std::optional<double> ToSi(std::string_view text, const Unit& unit) noexcept {
  const auto parts = Split(text);
  if (!parts) return std::nullopt;
  const int exponent = parts->exponent + unit.decimal_exponent;
  if (unit.factor == 1.0L) return Read<double>(parts->mantissa, exponent);
  const auto value = Read<long double>(parts->mantissa, exponent);
  if (!value) return std::nullopt;
  const auto si = static_cast<double>(*value * unit.factor);
  if (!std::isfinite(si) || (si == 0.0 && *value != 0.0L)) return std::nullopt;
  return si;
}

std::string FromSi(double si, const Unit& unit) {
  if (unit.factor == 1.0L) return Decimal(si, -unit.decimal_exponent, std::nullopt);
  const long double value = static_cast<long double>(si) / unit.factor;
  std::string text;
  for (int digits = 1; digits <= 24; ++digits) {
    text = Decimal(value, -unit.decimal_exponent, digits);
    const auto back = ToSi(text, unit);
    if (back && SameBits(*back, si)) break;
  }
  return text;
}

std::string BoundText(double bound) { return FromSi(bound, kOne); }

}  // namespace levitas::configuration
