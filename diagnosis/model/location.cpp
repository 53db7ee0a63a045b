#include "diagnosis/model/location.hpp"

#include <fmt/core.h>

#include <utility>

namespace levitas::diagnosis {
namespace {

const char* WheelName(bool on_driven) { return on_driven ? "driven" : "driving"; }

}  // namespace

Location Location::Named(const std::string& further) const {
  Location other = *this;
  other.name = fmt::format("{}, {}", name, further);
  return other;
}

Location Location::InMode(std::size_t flexible_mode) const {
  Location other = Named(fmt::format("mode {}", flexible_mode));
  other.mode = flexible_mode;
  return other;
}

Location Everywhere(std::string name) { return {.name = std::move(name)}; }

Location AtAxis(const RigNumbers& rig, std::size_t axis) {
  return {.name = rig.channels[axis], .axis = axis};
}

Location AtBearing(const RigNumbers& rig, std::size_t bearing) {
  return {.name = rig.bearings[bearing], .bearing = bearing};
}

Location AtSide(const RigNumbers& rig, std::size_t bearing, bool on_sensor) {
  return {.name = fmt::format("{} {}", on_sensor ? "sensor" : "magnet", rig.bearings[bearing]),
          .bearing = bearing,
          .on_sensor = on_sensor};
}

Location AtMode(std::size_t flexible_mode) {
  return {.name = fmt::format("mode {}", flexible_mode), .mode = flexible_mode};
}

Location AtPlane(double z_m) { return {.name = fmt::format("z {:.1f} mm", z_m * 1e3), .z_m = z_m}; }

Location AtOrder(int order) { return {.name = fmt::format("order {}", order), .order = order}; }

Location AtOrderOf(const RigNumbers& rig, int order, std::size_t axis) {
  return {
      .name = fmt::format("order {}, {}", order, rig.channels[axis]), .axis = axis, .order = order};
}

Location AtLineOf(const RigNumbers& rig, double frequency_hz, std::size_t axis) {
  return {.name = fmt::format("{:.0f} Hz, {}", frequency_hz, rig.channels[axis]),
          .axis = axis,
          .frequency_hz = frequency_hz};
}

Location AtGear(const std::string& name, std::size_t gear) { return {.name = name, .gear = gear}; }

Location AtGearOrder(const std::string& name, std::size_t gear, int order) {
  return {.name = fmt::format("{}, order {}", name, order), .gear = gear, .order = order};
}

Location AtWheel(const std::string& name, std::size_t gear, bool on_driven) {
  return {.name = fmt::format("{}, {} wheel", name, WheelName(on_driven)),
          .gear = gear,
          .on_driven = on_driven};
}

Location AtTooth(const std::string& name, std::size_t gear, bool on_driven, std::size_t tooth) {
  return {.name = fmt::format("{}, {} tooth {}", name, WheelName(on_driven), tooth),
          .gear = gear,
          .tooth = tooth,
          .on_driven = on_driven};
}

}  // namespace levitas::diagnosis
