#pragma once
// Removes polarity: probes on the way in, coils on the way out, and coils of a record on the way
// back.
//
// Equation   q_B = P_s q_S (positions), ic_S = P_a ic_B (currents); P diagonal with +-1.
// Frames     S: as the rig is wired. B: bearing frame, positive x towards the coil that a positive
//            control current strengthens. The two are types, so one cannot be taken for the other.
// Thread     any.
// Failure    the constructor throws std::invalid_argument unless every polarity is +1 or -1.

#include <stdexcept>
#include <string>

#include "common/axes.hpp"
#include "common/rig_numbers.hpp"

namespace levitas::cycle {

/// One number per axis as the rig is wired.
struct RigFrame {
  AxisArray at{};
};
/// One number per axis in the bearing frame.
struct BearingFrame {
  AxisArray at{};
};

class ProbeMap {
 public:
  explicit ProbeMap(const RigNumbers& rig) {
    for (std::size_t i = 0; i < rig.axes() && i < kMaxAxes; ++i) {
      sensor_[i] = Checked(rig.sensor_polarity[i], "sensor_polarity");
      actuator_[i] = Checked(rig.actuator_polarity[i], "actuator_polarity");
    }
  }

  [[nodiscard]] BearingFrame Positions(const RigFrame& read_m) const noexcept {
    return {Product(sensor_, read_m.at)};
  }
  [[nodiscard]] RigFrame Currents(const BearingFrame& wanted_a) const noexcept {
    return {Product(actuator_, wanted_a.at)};
  }
  /// The way back: a sign is its own inverse.
  [[nodiscard]] BearingFrame CommandedCurrents(const RigFrame& commanded_a) const noexcept {
    return {Product(actuator_, commanded_a.at)};
  }
  /// What the probes read at these positions.
  [[nodiscard]] RigFrame Readings(const BearingFrame& position_m) const noexcept {
    return {Product(sensor_, position_m.at)};
  }

 private:
  static double Checked(double polarity, const char* name) {
    if (polarity != 1.0 && polarity != -1.0) {
      throw std::invalid_argument(std::string("rig: ") + name + " = " + std::to_string(polarity) +
                                  ", allowed +1 or -1");
    }
    return polarity;
  }
  static AxisArray Product(const AxisArray& signs, const AxisArray& values) noexcept {
    AxisArray product{};
    for (std::size_t i = 0; i < kMaxAxes; ++i) product[i] = signs[i] * values[i];
    return product;
  }

  AxisArray sensor_{};  // zero beyond the rig's axes: stray numbers there have no effect
  AxisArray actuator_{};
};

}  // namespace levitas::cycle
