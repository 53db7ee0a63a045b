#pragma once
// Signs of probes and coils as they are wired: the one class that knows them, for both directions.
//
// Users      the control cycle (controller/cycle), the simulated rig (plant_sim/plant) and whoever
//            takes frames off the wire or out of a file into the bearing frame or back:
//            session/log/record_frame.hpp. Everything else has numbers of the bearing frame only.
// Equation   q_B = P_s q_S (positions), ic_S = P_a ic_B (currents); P diagonal with +-1.
// Frames     S: as the rig is wired. B: bearing frame, positive x towards the coil that a positive
//            control current strengthens. The two are types, so one cannot be taken for the other.
// Thread     any.
// Failure    the constructor throws std::invalid_argument unless every polarity is +1 or -1.

#include <stdexcept>
#include <string>

#include "common/axes.hpp"
#include "common/rig_numbers.hpp"

namespace levitas {

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
  explicit ProbeMap(const RigNumbers& rig)
      : ProbeMap(rig.sensor_polarity, rig.actuator_polarity, rig.axes()) {}
  ProbeMap(const AxisArray& sensor_polarity, const AxisArray& actuator_polarity, std::size_t axes) {
    for (std::size_t i = 0; i < axes && i < kMaxAxes; ++i) {
      sensor_[i] = Checked(sensor_polarity[i], "sensor_polarity");
      actuator_[i] = Checked(actuator_polarity[i], "actuator_polarity");
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

}  // namespace levitas
