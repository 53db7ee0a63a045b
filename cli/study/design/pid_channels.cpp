#include "cli/study/design/pid_channels.hpp"

#include <fmt/core.h>

#include <array>

namespace levitas::cli {
namespace {

/// Of the x plane; those of the y plane are the same.
constexpr std::array<const char*, 2> kNames{"translation", "tilt"};
const law::AxisLawConfig& Of(const law::LawConfig& channels, std::size_t name) {
  return channels.axes.at(2 * name);
}

}  // namespace

std::string ChannelsText(const law::LawConfig& channels) {
  std::string out;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const auto& pid = Of(channels, i);
    out += fmt::format("{}{} Kp {:.6g} A/m, Ki {:.6g} A/(m s), Kd {:.6g} A s/m to {:.6g} Hz",
                       i == 0 ? "" : "; ", kNames[i], pid.kp_a_per_m, pid.ki_a_per_m_s,
                       pid.kd_a_s_per_m, pid.derivative_hz);
    for (const auto& lead : pid.lead_lags)
      out += fmt::format(", lead-lag {:.6g}/{:.6g} Hz", lead.zero_hz, lead.pole_hz);
    for (const auto& notch : pid.notches)
      out += fmt::format(", notch {:.6g} Hz {:.6g}/{:.6g}", notch.frequency_hz, notch.zero_damping,
                         notch.pole_damping);
  }
  return out;
}

nlohmann::ordered_json ChannelsJson(const law::LawConfig& channels) {
  nlohmann::ordered_json out;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const auto& pid = Of(channels, i);
    nlohmann::ordered_json one{{"name", kNames[i]},
                               {"kp_a_per_m", pid.kp_a_per_m},
                               {"ki_a_per_m_s", pid.ki_a_per_m_s},
                               {"kd_a_s_per_m", pid.kd_a_s_per_m},
                               {"derivative_hz", pid.derivative_hz}};
    for (const auto& lead : pid.lead_lags)
      one["lead_lags"].push_back({{"zero_hz", lead.zero_hz}, {"pole_hz", lead.pole_hz}});
    for (const auto& notch : pid.notches)
      one["notches"].push_back({{"frequency_hz", notch.frequency_hz},
                                {"zero_damping", notch.zero_damping},
                                {"pole_damping", notch.pole_damping}});
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace levitas::cli
