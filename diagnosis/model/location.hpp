#pragma once
// Place in a rig at which a parameter acts, as data, and its name for people.
//
// Set     only what the effect refers to: the gain of a sensor has an axis, a run-out an axis and
//         an order, a crack a plane, an effect of the whole rig none of them.
// Name    is written from the same numbers by the functions below, distinguishes the places of one
//         effect, and is never read back: readers take the numbers.
// Units   SI; indices count from 0, flexible modes from 1 (first bending), as in a rig file.
// Thread  plain data.

#include <cstddef>
#include <optional>
#include <string>

#include "common/rig_numbers.hpp"

namespace levitas::diagnosis {

struct Location {
  std::string name;  ///< "de_x", "mode 3", "order 2, nde_y"
  std::optional<std::size_t> axis{}, bearing{};
  std::optional<std::size_t> mode{};  ///< flexible mode
  std::optional<std::size_t> gear{};  ///< pair of gears
  std::optional<std::size_t> tooth{};
  /// Multiple of the rotation, of a gear pair of the tooth engagement; negative: backward.
  std::optional<int> order{};
  std::optional<double> z_m{}, frequency_hz{};
  bool on_sensor{};  ///< of a rotation of the axes: of the sensors, else of the magnets
  bool on_driven{};  ///< of a pair of gears: on the driven wheel, else on the driving one

  /// One axis and nothing that tells places on it apart.
  [[nodiscard]] bool is_axis() const noexcept { return axis && !order && !frequency_hz; }
  [[nodiscard]] bool Touches(std::size_t channel) const noexcept {
    return axis == channel || bearing == channel / 2;
  }
  /// The same place with a further distinction behind its name: a mode, or words.
  [[nodiscard]] Location InMode(std::size_t flexible_mode) const;
  [[nodiscard]] Location Named(const std::string& further) const;
};

/// "all axes", "rotor": the whole rig.
[[nodiscard]] Location Everywhere(std::string name);
[[nodiscard]] Location AtAxis(const RigNumbers& rig, std::size_t axis);
[[nodiscard]] Location AtBearing(const RigNumbers& rig, std::size_t bearing);
/// The magnets or the sensors of a bearing.
[[nodiscard]] Location AtSide(const RigNumbers& rig, std::size_t bearing, bool on_sensor);
[[nodiscard]] Location AtMode(std::size_t flexible_mode);
[[nodiscard]] Location AtPlane(double z_m);
[[nodiscard]] Location AtOrder(int order);
[[nodiscard]] Location AtOrderOf(const RigNumbers& rig, int order, std::size_t axis);
[[nodiscard]] Location AtLineOf(const RigNumbers& rig, double frequency_hz, std::size_t axis);
/// A pair of gears, one order of its engagement, a wheel of it, a tooth of a wheel.
[[nodiscard]] Location AtGear(const std::string& name, std::size_t gear);
[[nodiscard]] Location AtGearOrder(const std::string& name, std::size_t gear, int order);
[[nodiscard]] Location AtWheel(const std::string& name, std::size_t gear, bool on_driven);
[[nodiscard]] Location AtTooth(const std::string& name, std::size_t gear, bool on_driven,
                               std::size_t tooth);

}  // namespace levitas::diagnosis
