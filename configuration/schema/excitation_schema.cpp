// Table of an excitation of a scenario.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "configuration/schema/schema.hpp"

namespace levitas::configuration {
namespace {

using namespace unit;
using scenario::Injection;
using scenario::SignalKind;

// In the order of SignalKind and of Injection.
constexpr std::array<std::string_view, 6> kSignals{"prbs",  "paprbs",    "stepped_sine",
                                                   "chirp", "multisine", "impulse"};
constexpr std::string_view kEveryAxis = "all";
constexpr std::array<std::string_view, 2> kPoints{"control_current", "measured_position"};

void DescribeAmplitude(Visitor& v, scenario::Excitation& excitation, const RigNumbers& rig) {
  auto point = static_cast<std::size_t>(excitation.point);
  v.Choice({"point", kPoints, "control_current",
            "where it enters: added to the law's current, or to the position that the law reads"},
           point);
  excitation.point = static_cast<Injection>(point);
  v.When(excitation.point == Injection::kControlCurrent, "with point: control_current", [&] {
    v.Number({"amplitude", kAmpere, 1e-6, 100, kRequired, "largest current, plus or minus"},
             excitation.amplitude_a);
    const double limit_a =
        std::min(rig.bias_current_a, rig.max_coil_current_a - rig.bias_current_a);
    v.RefuseIf(!rig.channels.empty() && excitation.amplitude_a > limit_a, "amplitude_a",
               fmt::format("found {:.6g} A, but the coils leave {:.6g} A in all",
                           excitation.amplitude_a, limit_a));
  });
  v.When(excitation.point == Injection::kMeasuredPosition, "with point: measured_position", [&] {
    v.Number({"amplitude", kMicrometre, 1e-4, 5000, kRequired, "largest shift, plus or minus"},
             excitation.amplitude_m);
    v.RefuseIf(rig.clearance_m > 0.0 && excitation.amplitude_m >= rig.clearance_m, "amplitude_um",
               fmt::format("must be smaller than the clearance, {:.6g} um", rig.clearance_m * 1e6));
  });
}

void DescribeBits(Visitor& v, scenario::Excitation& excitation) {
  v.Integer({"order", 2, 31, 12, "the sequence repeats after 2^order - 1 bits"}, excitation.order);
  v.Integer({"divisor", 1, 100000, 1, "control cycles per bit"}, excitation.divisor);
  v.Number({"start", kOne, 0, 0.999999, 0,
            "where in the sequence it begins; spread channels (0, 0.25, ...) to decorrelate them"},
           excitation.start);
}

void DescribeFrequencies(Visitor& v, scenario::Excitation& excitation, const RigNumbers& rig) {
  v.Number({"from", kHertz, 0.001, 1e6, kRequired, "lowest (or first) frequency"},
           excitation.from_hz);
  v.Number({"to", kHertz, 0.001, 1e6, kRequired, "highest (or last) frequency"}, excitation.to_hz);
  const double nyquist_hz = 0.5 / rig.period_s();
  v.RefuseIf(!rig.channels.empty() && std::max(excitation.from_hz, excitation.to_hz) > nyquist_hz,
             "to_hz", fmt::format("beyond half the sampling frequency, {:.6g} Hz", nyquist_hz));
}

void DescribeSpacing(Visitor& v, scenario::Excitation& excitation) {
  constexpr std::array<std::string_view, 2> kSpacings{"logarithmic", "linear"};
  std::size_t spacing = excitation.linear ? 1 : 0;
  v.Choice({"spacing", kSpacings, "logarithmic", "equal ratios or equal differences in frequency"},
           spacing);
  excitation.linear = spacing == 1;
}

void DescribeRepeat(Visitor& v, scenario::Excitation& excitation, std::string_view meaning) {
  v.Number({"repeat", kSecond, 1e-4, 1000, kRequired, meaning}, excitation.repeat_s);
}

/// An axis, or the word for all of them, which SpreadOverAxes takes apart.
void DescribeAxes(Visitor& v, scenario::Excitation& excitation, const RigNumbers& rig) {
  std::vector<std::string_view> names(rig.channels.begin(), rig.channels.end());
  if (names.empty()) names.push_back(excitation.channel);  // written without its rig
  names.push_back(kEveryAxis);
  const auto at = std::ranges::find(names, excitation.channel);
  auto index = at == names.end() ? 0 : static_cast<std::size_t>(at - names.begin());
  const std::string owner = "rig " + rig.name;
  v.Choice({"channel", names, kRequired, "axis of the rig, or every axis at once", owner}, index);
  if (rig.channels.empty()) return;
  excitation.channel = names[index];
  excitation.axis = std::min(index, rig.channels.size() - 1);
}

/// One signal for each axis, pseudo-random ones begun at even shares of their period, so that they
/// do not resemble each other.
std::vector<scenario::Excitation> OnEveryAxis(const scenario::Excitation& one,
                                              const RigNumbers& rig) {
  std::vector<scenario::Excitation> all(rig.channels.size(), one);
  for (std::size_t axis = 0; axis < all.size(); ++axis) {
    all[axis].channel = rig.channels[axis];
    all[axis].axis = axis;
    const double share = static_cast<double>(axis) / static_cast<double>(all.size());
    all[axis].start = std::fmod(one.start + share, 1.0);
  }
  return all;
}

}  // namespace

void SpreadOverAxes(std::vector<scenario::Excitation>& excitations, const RigNumbers& rig) {
  if (rig.channels.empty()) return;
  std::vector<scenario::Excitation> spread;
  for (const scenario::Excitation& one : excitations) {
    if (one.channel != kEveryAxis) {
      spread.push_back(one);
      continue;
    }
    const auto all = OnEveryAxis(one, rig);
    spread.insert(spread.end(), all.begin(), all.end());
  }
  excitations = std::move(spread);
}

void DescribeSwitch(Visitor& v, std::string_view key, std::string_view meaning, bool& on) {
  constexpr std::array<std::string_view, 2> kWords{"false", "true"};
  std::size_t word = on ? 1 : 0;
  v.Choice({key, kWords, kWords[0], meaning}, word);
  on = word == 1;
}

void DescribeAxis(Visitor& v, std::string_view key, std::string_view meaning, const RigNumbers& rig,
                  std::size_t& axis) {
  const std::vector<std::string_view> names(rig.channels.begin(), rig.channels.end());
  v.Choice({key, names, kRequired, meaning}, axis);
}

void DescribeChannel(Visitor& v, const RigNumbers& rig, std::string& channel, std::size_t& axis) {
  std::vector<std::string_view> names(rig.channels.begin(), rig.channels.end());
  if (names.empty()) names.push_back(channel);  // written without its rig
  const auto at = std::ranges::find(names, channel);
  auto index = at == names.end() ? 0 : static_cast<std::size_t>(at - names.begin());
  const std::string owner = "rig " + rig.name;
  v.Choice({"channel", names, kRequired, "axis of the rig", owner}, index);
  if (rig.channels.empty()) return;
  channel = rig.channels[index];
  axis = index;
}

void Describe(Visitor& v, scenario::Excitation& excitation, const RigNumbers& rig) {
  DescribeAxes(v, excitation, rig);
  auto kind = static_cast<std::size_t>(excitation.kind);
  v.Choice({"signal", kSignals, "prbs", "kind of test signal"}, kind);
  excitation.kind = static_cast<SignalKind>(kind);
  const auto is = [&](SignalKind wanted) { return excitation.kind == wanted; };
  DescribeAmplitude(v, excitation, rig);
  v.When(is(SignalKind::kPrbs) || is(SignalKind::kPaprbs), "with signal: prbs or paprbs",
         [&] { DescribeBits(v, excitation); });
  v.When(is(SignalKind::kPaprbs), "with signal: paprbs", [&] {
    v.Number({"low_share", kOne, 0, 1, 0,
              "amplitude of a bit is drawn between this share of the largest and the largest"},
             excitation.low_share);
    v.Integer({"seed", 0, 1000000000, 1, "of the drawn amplitudes"}, excitation.seed);
  });
  v.When(is(SignalKind::kSteppedSine) || is(SignalKind::kChirp) || is(SignalKind::kMultisine),
         "with signal: stepped_sine, chirp or multisine",
         [&] { DescribeFrequencies(v, excitation, rig); });
  v.When(is(SignalKind::kSteppedSine) || is(SignalKind::kChirp),
         "with signal: stepped_sine or chirp", [&] { DescribeSpacing(v, excitation); });
  v.When(is(SignalKind::kSteppedSine), "with signal: stepped_sine", [&] {
    v.Integer({"frequencies", 1, 100000, 20, "how many, first and last included"},
              excitation.frequencies);
    v.Number({"dwell", kSecond, 1e-4, 1000, kRequired, "time on each frequency"},
             excitation.dwell_s);
  });
  v.When(is(SignalKind::kChirp) || is(SignalKind::kMultisine), "with signal: chirp or multisine",
         [&] { DescribeRepeat(v, excitation, "one sweep; or 1 over the distance of the lines"); });
  v.When(is(SignalKind::kImpulse), "with signal: impulse", [&] {
    v.Number({"width", kMillisecond, 0.001, 10000, 1, "how long it lasts"}, excitation.width_s);
    v.Number({"every", kSecond, 0, 1000, 0, "then again after this; 0: once"}, excitation.repeat_s);
  });
}

}  // namespace levitas::configuration
