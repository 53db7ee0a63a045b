#pragma once
// Parameters that several effects have: phase, plane, order. Part of the catalogue's tables.

#include <numbers>

#include "plant_sim/effect/catalogue.hpp"

namespace levitas::effect {

inline constexpr double kTurn = 2.0 * std::numbers::pi;
inline constexpr double kDegree = std::numbers::pi / 180.0;

[[nodiscard]] constexpr Parameter Phase(std::string_view meaning) {
  return {"phase", "rad", "deg", -kTurn, kTurn, 0.0, 0.0, Scaling::kFixed, 0.0, meaning, false};
}

[[nodiscard]] constexpr Parameter Plane(std::optional<double> fallback, double clear) {
  return {"z",  "m", "mm", 0.0, 100.0, clear, 0.0, Scaling::kFixed, fallback, "place on the shaft",
          false};
}

[[nodiscard]] constexpr Parameter Ratio(double low, double high, double clear,
                                        std::string_view meaning) {
  return {"ratio", "", "", low, high, clear, 1.0, Scaling::kLinear, std::nullopt, meaning, false};
}

}  // namespace levitas::effect
