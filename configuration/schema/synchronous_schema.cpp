// Table of the synchronous control of a controller file.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "configuration/schema/schema.hpp"
#include "controller/synchronous/inverse_ladder.hpp"
#include "controller/synchronous/orbit_slip.hpp"

namespace levitas::configuration {
namespace {

using namespace unit;

constexpr double kLargestElement =
    1e9;  // of an element of T: rubbish is found, no block is refused
constexpr std::size_t kMostTableSpeeds = 64;
constexpr double kFastestTurningRpm = 1e6;

struct Element {
  std::size_t to{}, from{};
  double real{}, imaginary{};
};

// A matrix as the list of its elements that are not zero.
void DescribeInverse(Visitor& v, synchronous::ComplexMatrix& inverse, bool vibration,
                     const RigNumbers& rig) {
  std::vector<Element> elements;
  for (std::size_t to = 0; to < rig.axes(); ++to) {
    for (std::size_t from = 0; from < rig.axes(); ++from) {
      const double real = inverse.real[to][from];
      const double imaginary = inverse.imaginary[to][from];
      if (real != 0.0 || imaginary != 0.0) elements.push_back({to, from, real, imaginary});
    }
  }
  inverse = {};
  std::array<std::array<bool, kMaxAxes>, kMaxAxes> given{};
  const auto number = [&](std::string_view stem, const Unit& unit, double& value) {
    v.Number({stem, unit, -kLargestElement, kLargestElement, kRequired, "of this element of T"},
             value);
  };
  v.List({"elements", 1, kMaxAxes * kMaxAxes, "of T at this speed, those that are not zero"},
         elements, [&](Element& element, std::size_t) {
           DescribeAxis(v, "to", "axis whose amplitude adapts", rig, element.to);
           DescribeAxis(v, "from", "axis whose error it adapts to", rig, element.from);
           v.When(!vibration, "of target: current", [&] {
             number("real", kOne, element.real);
             number("imaginary", kOne, element.imaginary);
           });
           v.When(vibration, "of target: vibration", [&] {
             number("real", kGainP, element.real);
             number("imaginary", kGainP, element.imaginary);
           });
           v.RefuseIf(given[element.to][element.from], "from",
                      "this element has been given already");
           given[element.to][element.from] = true;
           inverse.real[element.to][element.from] = element.real;
           inverse.imaginary[element.to][element.from] = element.imaginary;
         });
}

void DescribeTable(Visitor& v, synchronous::BlockConfig& block, const RigNumbers& rig) {
  const bool vibration = block.target == synchronous::Target::kVibration;
  v.List(
      {"inverse", 1, kMostTableSpeeds,
       "T over speed, rising; on a straight line between two speeds (amb design notch makes it)"},
      block.inverse, [&](synchronous::InverseAtSpeed& at, std::size_t) {
        v.Number({"speed", kRpm, 0, kFastestTurningRpm, kRequired, "at which this T holds"},
                 at.speed_rad_per_s);
        DescribeInverse(v, at.inverse, vibration, rig);
      });
  for (std::size_t i = 1; i < block.inverse.size(); ++i) {
    v.RefuseIf(block.inverse[i].speed_rad_per_s <= block.inverse[i - 1].speed_rad_per_s, "inverse",
               "the speeds must rise");
  }
}

// The speeds at which a block acts.
void DescribeWindow(Visitor& v, synchronous::BlockConfig& block) {
  v.Number({"from", kRpm, 0, kFastestTurningRpm, kRequired, "acts from this speed"},
           block.from_rad_per_s);
  v.Number({"to", kRpm, 0, kFastestTurningRpm, kRequired, "to this one"}, block.to_rad_per_s);
  v.RefuseIf(block.to_rad_per_s <= block.from_rad_per_s, "to_rpm", "must be above from_rpm");
  v.Number({"hysteresis", kRpm, 0, kFastestTurningRpm, 30, "so far beyond its window it ends"},
           block.hysteresis_rad_per_s);
  v.RefuseIf(block.from_rad_per_s <= block.hysteresis_rad_per_s, "from_rpm",
             "must be above hysteresis_rpm: a block ends before the rotor stands");
}

void DescribeLargestCurrent(Visitor& v, synchronous::BlockConfig& block, const RigNumbers& rig) {
  const double limit_a = std::min(rig.bias_current_a, rig.max_coil_current_a - rig.bias_current_a);
  v.Number({"largest_current", kAmpere, 1e-4, 1e3, kRequired,
            "amplitude of one axis; a block that needs more ends"},
           block.largest_current_a);
  v.RefuseIf(limit_a > 0.0 && block.largest_current_a > limit_a, "largest_current_a",
             fmt::format("found {:.6g} A, the coils leave {:.6g} A to both sides of the bias",
                         block.largest_current_a, limit_a));
}

void DescribeBlock(Visitor& v, synchronous::BlockConfig& block, const RigNumbers& rig) {
  v.Name({"name", "of this block, for its events"}, block.name);
  v.Number({"order", kOne, 0.01, 1000, 1, "multiple of the shaft's angle"}, block.order);
  constexpr std::array<std::string_view, 2> kTargets{"current", "vibration"};
  std::size_t target = block.target == synchronous::Target::kVibration ? 1 : 0;
  v.Choice({"target", kTargets, kTargets[0],
            "what goes to zero at this order: the control current (the rotor turns about its axis "
            "of inertia), or the error of the position (it turns about its centre)"},
           target);
  block.target = target == 1 ? synchronous::Target::kVibration : synchronous::Target::kCurrent;
  v.Number({"time_constant", kSecond, 0.001, 100, 0.3, "of what is left, where T is exact"},
           block.time_constant_s);
  DescribeWindow(v, block);
  v.When(target == 1, "with target: vibration", [&] { DescribeLargestCurrent(v, block, rig); });
  DescribeSwitch(v, "adaptive",
                 "true: T is corrected by what the error answers while the block runs",
                 block.adaptive);
  v.RefuseIf(block.adaptive && block.order != std::floor(block.order), "adaptive",
             "only an order that is a whole number: amplitudes are taken over whole turns");
  v.When(block.adaptive, "with adaptive: true", [&] {
    v.Number({"least_change", kMicrometre, 0.001, 1000, 2,
              "of the synchronous error; what moves it by less teaches nothing"},
             block.least_change_m);
  });
  DescribeTable(v, block, rig);
  const double nyquist_rad_per_s = static_cast<double>(kPi) / rig.period_s();
  v.RefuseIf(
      block.order * (block.to_rad_per_s + block.hysteresis_rad_per_s) >= nyquist_rad_per_s,
      "to_rpm",
      fmt::format("order {:.6g} at this speed lies above half the sampling frequency, {:.6g} "
                  "Hz",
                  block.order, 0.5 / rig.period_s()));
}

struct RunOutOfAxis {
  std::size_t axis{};
  double amplitude_m{}, phase_rad{};
};

void DescribeRunOut(Visitor& v, synchronous::RunOut& run_out, const RigNumbers& rig) {
  v.Number({"order", kOne, 0.01, 1000, 1, "multiple of the shaft's angle"}, run_out.order);
  std::vector<RunOutOfAxis> axes;
  for (std::size_t i = 0; i < rig.axes(); ++i) {
    const double real = run_out.real_m[i];
    const double imaginary = run_out.imaginary_m[i];
    if (real == 0.0 && imaginary == 0.0) continue;
    axes.push_back({i, std::hypot(real, imaginary), std::atan2(imaginary, real)});
  }
  run_out.real_m = run_out.imaginary_m = {};
  v.List({"axes", 1, kMaxAxes, "what each sensor adds"}, axes, [&](RunOutOfAxis& at, std::size_t) {
    DescribeAxis(v, "channel", "axis of the rig", rig, at.axis);
    v.Number({"amplitude", kMicrometre, 0, 5000, kRequired, "peak"}, at.amplitude_m);
    v.Number({"phase", kDegree, -360, 360, kRequired, "added = amplitude cos(order angle + phase)"},
             at.phase_rad);
    run_out.real_m[at.axis] = at.amplitude_m * std::cos(at.phase_rad);
    run_out.imaginary_m[at.axis] = at.amplitude_m * std::sin(at.phase_rad);
  });
}

// Two blocks of one order that act at one speed would integrate the same error: how they share it
// is held by nothing.
void RefuseSharedWork(Visitor& v, const std::vector<synchronous::BlockConfig>& blocks) {
  for (std::size_t k = 1; k < blocks.size(); ++k) {
    for (std::size_t before = 0; before < k; ++before) {
      const synchronous::BlockConfig& a = blocks[before];
      const synchronous::BlockConfig& b = blocks[k];
      v.RefuseIf(a.name == b.name, "blocks", fmt::format("two blocks have the name {}", a.name));
      v.RefuseIf(synchronous::ShareWork(a, b), "blocks",
                 fmt::format("{} and {} have one order and act at the same speeds, hysteresis "
                             "included; leave a gap between their windows",
                             a.name, b.name));
    }
  }
}

void DescribeAngleSource(Visitor& v, synchronous::AngleConfig& angle, const RigNumbers& rig) {
  using synchronous::AngleSource;
  constexpr std::array<std::string_view, 3> kNames{"rig", "speed", "orbit"};
  constexpr std::array kSources{AngleSource::kRig, AngleSource::kSpeed, AngleSource::kOrbit};
  auto source =
      static_cast<std::size_t>(std::ranges::find(kSources, angle.source) - kSources.begin());
  v.Choice(
      {"angle_from", kNames, kNames[0],
       "rig: the angle that it measures; speed: no mark on the shaft, the integral of the "
       "measured speed, which a block follows as long as it drifts slowly; orbit: no mark, and a "
       "speed that is not quite the rotor's, which the orbit mends once a turn"},
      source);
  angle.source = kSources[source];
  v.RefuseIf(angle.source == AngleSource::kOrbit && rig.axes() < 2, "angle_from",
             "orbit needs a bearing with two axes");
  v.Number({"least_followed_orbit", kMicrometre, 0.01, 1000, 2,
            "of angle_from orbit, forward amplitude of one bearing: followed from there on, lost "
            "below a quarter of it"},
           angle.least_followed_m);
}

// What takes the orbit away takes away the angle that is read from it.
void RefuseLostOrbit(Visitor& v, const synchronous::SynchronousConfig& control) {
  if (control.angle.source != synchronous::AngleSource::kOrbit) return;
  for (const synchronous::BlockConfig& block : control.blocks) {
    v.RefuseIf(block.adaptive, "angle_from",
               fmt::format("orbit and adaptive do not go together: {} would learn from an angle "
                           "that follows what it does",
                           block.name));
    v.RefuseIf(
        block.target == synchronous::Target::kVibration &&
            synchronous::ChangesFollowedOrbit(block.order),
        "angle_from",
        fmt::format("orbit needs one, and {} takes it away: target current leaves it", block.name));
  }
}

}  // namespace

void Describe(Visitor& v, synchronous::SynchronousConfig& control, const RigNumbers& rig) {
  DescribeAngleSource(v, control.angle, rig);
  v.Number(
      {"angle_bandwidth", kHertz, 0.1, 1000, 10,
       "of the follower of the rotor's angle; under an acceleration A it lags by A/(2 pi f)^2"},
      control.angle.bandwidth_hz);
  v.RefuseIf(control.angle.bandwidth_hz * rig.period_s() > 0.02, "angle_bandwidth_hz",
             fmt::format("found {:.6g} Hz, allowed a fiftieth of the sampling frequency, {:.6g} Hz",
                         control.angle.bandwidth_hz, 0.02 / rig.period_s()));
  v.Number({"largest_angle_error", kDegree, 1, 170, 20, "beyond it the angle has jumped"},
           control.angle.largest_error_rad);
  v.Number({"largest_speed_difference", kOne, 0.01, 1, 0.1,
            "between the angle's speed and the measured one, as a share of it"},
           control.angle.largest_speed_share);
  v.Number({"orbit_growth", kOne, 1, 100, 2,
            "a block ends when the orbit passes this many times what it was as the block began"},
           control.orbit_growth);
  v.Number({"least_orbit_fraction", kOne, 0, 0.95, 0.35,
            "of the clearance; a smaller orbit ends no block"},
           control.least_orbit_fraction);
  v.Number(
      {"saturated", kMillisecond, 0.1, 60000, 20,
       "of an axis at its current limit, a cycle without counting back a quarter, end the blocks"},
      control.saturated_s);
  v.List({"run_outs", 0, 8,
          "taken off what law and blocks read; protections and records keep what was measured"},
         control.run_outs,
         [&](synchronous::RunOut& run_out, std::size_t) { DescribeRunOut(v, run_out, rig); });
  v.RefuseIf(control.angle.source != synchronous::AngleSource::kRig && !control.run_outs.empty(),
             "angle_from", "run_outs need an angle that is measured");
  v.List({"blocks", 0, synchronous::kMaxBlocks, "generalised notches"}, control.blocks,
         [&](synchronous::BlockConfig& block, std::size_t) { DescribeBlock(v, block, rig); });
  RefuseSharedWork(v, control.blocks);
  RefuseLostOrbit(v, control);
}

}  // namespace levitas::configuration
