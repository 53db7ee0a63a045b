#include "common/enums.hpp"

#include <array>

namespace levitas {
namespace {

template <class Enum, std::size_t N>
std::string_view Lookup(const std::array<std::string_view, N>& names, Enum value) noexcept {
  const auto index = static_cast<std::size_t>(value);
  return index < N ? names[index] : "invalid";
}

constexpr std::array<std::string_view, kModeCount> kModes{
    "off", "self_test", "lift", "levitating", "spinning", "coast_down", "landing", "tripped"};
constexpr std::array<std::string_view, kFaultCount> kFaults{"none",
                                                            "orbit_exceeded",
                                                            "sensor_out_of_range",
                                                            "sensor_frozen",
                                                            "sensor_not_finite",
                                                            "frame_missing",
                                                            "deadline_missed",
                                                            "coil_saturated",
                                                            "over_speed",
                                                            "emergency_stop",
                                                            "rig_restarted",
                                                            "amplifier_fault",
                                                            "self_test_failed",
                                                            "lift_failed",
                                                            "speed_unknown",
                                                            "law_not_finite",
                                                            "frames_lost",
                                                            "currents_late"};
constexpr std::array<std::string_view, kOperatorCommandCount> kCommands{
    "none",           "lift",  "spin",   "coast_down",     "land",
    "emergency_stop", "reset", "excite", "end_excitation", "mark"};

}  // namespace

std::string_view Name(Mode mode) noexcept { return Lookup(kModes, mode); }
std::string_view Name(Fault fault) noexcept { return Lookup(kFaults, fault); }
std::string_view Name(OperatorCommand command) noexcept { return Lookup(kCommands, command); }

}  // namespace levitas
