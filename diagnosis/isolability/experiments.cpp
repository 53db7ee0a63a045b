#include "diagnosis/isolability/experiments.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "common/rotational_speed.hpp"

namespace levitas::diagnosis {
namespace {

constexpr int kBits = 2047;  // of order 11
constexpr int kDivisor = 2;

class Writer {
 public:
  Writer(const configuration::RigFile& rig, double current_limit_a)
      : rig_(rig),
        amplitude_a_(std::min(0.1, 0.1 * current_limit_a)),
        clearance_um_(1e6 * rig.numbers.clearance_m),
        top_rpm_(RadPerSToRpm(rig.numbers.max_speed_rad_per_s)),
        rate_rpm_per_s_(RadPerSToRpm(0.5 * rig.plant.drive.max_acceleration_rad_per_s2)) {}

  [[nodiscard]] std::vector<Experiment> All() const {
    std::vector<Experiment> all;
    all.push_back(
        {fmt::format("standing, test signal of {:.3g} A on every axis in turn", amplitude_a_),
         Whole("standing", Signals(amplitude_a_))});
    all.push_back({fmt::format("standing, the test signal three times as large ({:.3g} A)",
                               3.0 * amplitude_a_),
                   Whole("standing_large", Signals(3.0 * amplitude_a_))});
    all.push_back(
        {fmt::format("standing, led slowly {:.3g} um to either side of the centre", Led()),
         Whole("led", Lead())});
    if (!(top_rpm_ > 0.0)) return all;
    for (const double share : {0.08, 0.5, 0.95}) {
      const double rpm = share * top_rpm_;
      all.push_back({fmt::format("turning at {:.0f} rpm, test signal on every axis in turn", rpm),
                     Whole(fmt::format("turning_{:.0f}", rpm),
                           Spin(rpm, 0.5) + Signals(amplitude_a_) + Stop())});
    }
    all.push_back(
        {fmt::format("run-up from {:.0f} to {:.0f} rpm", 0.08 * top_rpm_, 0.95 * top_rpm_),
         Whole("run_up", Spin(0.08 * top_rpm_, 0.5) + Spin(0.95 * top_rpm_, 0.5) + Stop())});
    return all;
  }

 private:
  [[nodiscard]] static std::string Whole(const std::string& name, const std::string& steps) {
    return fmt::format(
        "kind: scenario\nname: {}\n\nsteps:\n"
        "  - {{do: lift, until: levitating, timeout_s: 10, hold_s: 1}}\n{}"
        "  - {{do: land, until: 'off', timeout_s: 10, hold_s: 0.1}}\n",
        name, steps);
  }

  /// On every axis in turn.
  [[nodiscard]] std::string Signals(double amplitude_a) const {
    std::string text;
    for (const std::string& channel : rig_.numbers.channels) {
      text += Hold(1.5 * kBits * kDivisor * rig_.numbers.period_s(),
                   fmt::format("channel: {}, amplitude_a: {:.6g}, order: 11, divisor: {}", channel,
                               amplitude_a, kDivisor));
    }
    return text;
  }

  [[nodiscard]] double Led() const { return 0.08 * clearance_um_; }
  [[nodiscard]] std::string Lead() const {
    constexpr double kBitS = 0.1;
    constexpr double kPatternS = 0.7;  // of order 3
    const auto divisor = static_cast<int>(kBitS / rig_.numbers.period_s());
    std::string text;
    for (const std::string& channel : rig_.numbers.channels) {
      text += Hold(kPatternS, fmt::format("channel: {}, point: measured_position, amplitude_um: "
                                          "{:.6g}, order: 3, divisor: {}",
                                          channel, Led(), divisor));
    }
    return text;
  }

  [[nodiscard]] std::string Hold(double hold_s, const std::string& excitation) const {
    return fmt::format(
        "  - do: nothing\n    hold_s: {:.4f}\n    orbit_limit_um: {:.6g}\n    excitation:\n"
        "      - {{{}}}\n",
        hold_s, 0.5 * clearance_um_, excitation);
  }

  [[nodiscard]] std::string Spin(double rpm, double hold_s) const {
    return fmt::format(
        "  - do: spin\n    speed_rpm: {:.0f}\n    acceleration_rpm_per_s: {:.0f}\n"
        "    until: speed_reached\n    timeout_s: {:.0f}\n    hold_s: {:.1f}\n",
        rpm, rate_rpm_per_s_, 5.0 + 3.0 * top_rpm_ / rate_rpm_per_s_, hold_s);
  }
  [[nodiscard]] std::string Stop() const {
    return fmt::format(
        "  - do: spin\n    speed_rpm: 0\n    acceleration_rpm_per_s: {:.0f}\n"
        "    until: standstill\n    timeout_s: {:.0f}\n",
        rate_rpm_per_s_, 10.0 + 3.0 * top_rpm_ / rate_rpm_per_s_);
  }

  const configuration::RigFile& rig_;
  double amplitude_a_, clearance_um_, top_rpm_, rate_rpm_per_s_;
};

}  // namespace

std::vector<Experiment> Experiments(const configuration::RigFile& rig, double current_limit_a) {
  return Writer(rig, current_limit_a).All();
}

}  // namespace levitas::diagnosis
