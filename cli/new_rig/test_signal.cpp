#include "cli/new_rig/test_signal.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "analysis/critical_speeds.hpp"
#include "analysis/loop_response.hpp"
#include "analysis/sampled_loop.hpp"
#include "common/rotational_speed.hpp"

namespace levitas::cli {
namespace {

constexpr double kPeriodS = 0.8;        // about: lines 1.2 Hz apart
constexpr int kPeriods = 4;             // the first is the transient
constexpr double kOfBias = 0.1;         // of the bias current: keeps the magnet linear
constexpr double kOfClearance = 0.2;    // of the touchdown clearance, by the test signal alone
constexpr double kOrbitLimit = 0.4;     // of the clearance, unbalance included
constexpr double kPeakOverSigma = 3.3;  // once in a thousand samples
constexpr double kAwayFromCritical = 0.12;

double Sinc(double x) {
  const double angle = std::numbers::pi * x;
  return angle == 0.0 ? 1.0 : std::sin(angle) / angle;
}

/// Standard deviation of the axis that moves most, per ampere of the sequence on that axis [m/A].
double DeviationPerAmpere(const configuration::RigFile& rig, const law::LawConfig& law,
                          const TestSignal& signal) {
  const analysis::LoopResponse response(analysis::CloseLoop(rig.plant, law, 0.0));
  const double length = std::exp2(signal.order) - 1.0;
  const double clock_hz = 2.0 * response.nyquist_hz() / signal.divisor;
  const auto axes = static_cast<Eigen::Index>(response.axes());
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(axes);
  const double spacing_hz = clock_hz / length;
  for (double hz = spacing_hz; hz < response.nyquist_hz(); hz += spacing_hz) {
    const double lobe = Sinc(hz / clock_hz);
    // Twice: the line at -hz moves the rotor as much.
    const double power = 2.0 * (length + 1.0) / (length * length) * lobe * lobe;
    // y = P (I + C P)^-1 d = (I + P C)^-1 P d
    const Eigen::MatrixXcd moved = response.Sensitivity(hz) * response.Plant(hz);
    variance += power * moved.diagonal().cwiseAbs2();
  }
  return std::sqrt(variance.maxCoeff());
}

/// The speed nearest to `wanted`, half of it to one and a half, that no critical speed is near;
/// none where they leave no room.
std::optional<double> Away(double wanted, const std::vector<double>& critical) {
  const auto near = [&](double speed) {
    return std::ranges::any_of(
        critical, [&](double at) { return std::abs(speed - at) < kAwayFromCritical * at; });
  };
  constexpr int kSteps = 25;
  for (int i = 0; i <= kSteps; ++i) {
    const double by = 0.5 * wanted * i / kSteps;
    for (const double speed : {wanted - by, wanted + by}) {
      if (!near(speed)) return speed;
    }
  }
  return std::nullopt;
}

/// Of one axis [s].
double HoldOf(const RigSketch& sketch, const TestSignal& signal) {
  return kPeriods * (std::exp2(signal.order) - 1.0) * signal.divisor / sketch.rate_hz;
}

/// Steps that excite one axis after the other.
std::string ExcitationText(const configuration::RigFile& rig, const TestSignal& signal,
                           double hold_s) {
  std::string text;
  for (const std::string& channel : rig.numbers.channels) {
    text += fmt::format(
        "  - do: nothing\n"
        "    hold_s: {:.6g}\n"
        "    orbit_limit_um: {:.4g}\n"
        "    excitation:\n"
        "      - {{channel: {}, amplitude_a: {:.4g}, order: {}, divisor: {}}}\n"
        "  - {{do: nothing, hold_s: 0.3}}\n",
        hold_s, 1e6 * signal.orbit_limit_m, channel, signal.amplitude_a, signal.order,
        signal.divisor);
  }
  return text;
}

/// Two figures, downwards: a number one would have typed.
double RoundedDown(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return unit * std::floor(value / unit + 1e-9);
}

}  // namespace

TestSignal TestSignalOf(const configuration::RigFile& rig, const law::LawConfig& law) {
  TestSignal signal;
  signal.divisor = 2;
  const double clock_hz = 1.0 / (signal.divisor * rig.numbers.period_s());
  signal.order = std::clamp(static_cast<int>(std::lround(std::log2(kPeriodS * clock_hz))), 9, 20);
  double clearance_m = rig.plant.bearings.front().touchdown.clearance_m;
  for (const auto& bearing : rig.plant.bearings) {
    clearance_m = std::min(clearance_m, bearing.touchdown.clearance_m);
  }
  signal.orbit_limit_m = kOrbitLimit * clearance_m;
  const double moved = kPeakOverSigma * DeviationPerAmpere(rig, law, signal);
  signal.amplitude_a =
      RoundedDown(std::min(kOfBias * rig.plant.bearings.front().magnet.bias_current_a,
                           kOfClearance * clearance_m / moved));
  const double top = rig.numbers.max_speed_rad_per_s;
  std::vector<double> critical;
  for (const auto& crossing : analysis::LevitatedCampbell(rig.plant, law, top).crossings) {
    critical.push_back(crossing.speed_rad_per_s);
  }
  for (const double share : {0.25, 0.5}) {
    if (const auto speed = Away(share * top, critical)) signal.speeds_rad_per_s.push_back(*speed);
  }
  std::ranges::sort(signal.speeds_rad_per_s);
  return signal;
}

double DurationOf(const RigSketch& sketch, const configuration::RigFile& rig,
                  const TestSignal& signal) {
  constexpr double kBetween = 0.3;
  constexpr double kAround = 2.5;  // lift, settle, land
  const double axes = static_cast<double>(rig.numbers.channels.size());
  const double each = HoldOf(sketch, signal) + kBetween;
  const double speeds = static_cast<double>(signal.speeds_rad_per_s.size());
  const double fastest =
      signal.speeds_rad_per_s.empty() ? 0.0 : RadPerSToRpm(signal.speeds_rad_per_s.back());
  return kAround + (1.0 + speeds) * axes * each + 0.5 * speeds +
         2.0 * fastest / SketchAcceleration(sketch);
}

std::string SketchIdentify(const RigSketch& sketch, const configuration::RigFile& rig,
                           const TestSignal& signal) {
  const std::string excite = ExcitationText(rig, signal, HoldOf(sketch, signal));
  std::string text = fmt::format(
      "kind: scenario\n"
      "name: {}_identify\n\n"
      "# Test signals for amb identify modal and amb diagnose: on each axis in turn a "
      "pseudo-random "
      "binary current,\n"
      "# {} periods of which the first is the transient, at rest and at two speeds away from the "
      "critical ones. The\n"
      "# amplitude follows from rig file and first law; beyond orbit_limit_um the controller cuts "
      "it "
      "back and says so.\n"
      "steps:\n"
      "  - {{do: lift, until: levitating, timeout_s: 5, hold_s: 1}}\n",
      sketch.name, kPeriods);
  const double acceleration = SketchAcceleration(sketch);
  const double patience_s = SketchPatience(sketch);
  const auto spin = [&](double rpm, const char* until) {
    text += fmt::format(
        "\n  - {{do: spin, speed_rpm: {:.0f}, acceleration_rpm_per_s: {:.6g}, until: {}, "
        "timeout_s: {:.4g}, hold_s: 0.5}}\n",
        rpm, acceleration, until, patience_s);
  };
  text += excite;
  for (const double speed : signal.speeds_rad_per_s) {
    spin(RadPerSToRpm(speed), "speed_reached");
    text += excite;
  }
  spin(0.0, "standstill");
  return text + "  - {do: land, until: off, timeout_s: 5, hold_s: 0.2}\n";
}

}  // namespace levitas::cli
