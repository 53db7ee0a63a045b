// Table of the lines of a rig file.
#include <fmt/format.h>

#include <array>
#include <vector>

#include "configuration/schema/schema.hpp"

namespace levitas::configuration {
namespace {

using namespace unit;

constexpr std::array<std::string_view, 2> kLevels{"low", "high"};
constexpr std::array<std::string_view, 2> kBiases{"external", "internal"};

void Describe(Visitor& v, gpio::LinePlace& line) {
  v.Name({"chip", "name, label or path of the chip, as gpiodetect shows it", "-./:"}, line.chip);
  v.Integer({"offset", 0, 1023, std::nullopt, "of the line within its chip"}, line.offset);
  std::size_t level = line.active_high ? 1 : 0;
  v.Choice({"active", kLevels, "high", "level of the wire that counts as active"}, level);
  line.active_high = level == 1;
  auto bias = static_cast<std::size_t>(line.bias);
  v.Choice({"bias", kBiases, "external",
            "what holds the line at its safe level when nobody drives it: a resistor on the "
            "board, or the pull of the chip"},
           bias);
  line.bias = static_cast<gpio::Bias>(bias);
}

template <class Line, class Body>
void DescribeOptional(Visitor& v, std::string_view key, std::string_view meaning,
                      std::optional<Line>& line, Body body) {
  bool present = line.has_value();
  Line content = line.value_or(Line{});
  v.OptionalGroup(key, meaning, present, [&] { body(content); });
  if (present) {
    line = content;
  } else {
    line.reset();
  }
}

void Describe(Visitor& v, gpio::HeartbeatConfig& heartbeat, double period_s) {
  Describe(v, heartbeat.line);
  v.Integer({"toggle_cycles", 1, 10000, 5, "cycles between two edges"}, heartbeat.toggle_cycles);
  v.Number(
      {"timeout", kMillisecond, 0.1, 10000, 5, "the rig gives up after this long without edge"},
      heartbeat.timeout_s);
  v.RefuseIf(heartbeat.timeout_s < 2.0 * heartbeat.toggle_cycles * period_s, "timeout_ms",
             fmt::format("found {:.6g} ms, but two edges alone take {:.6g} ms",
                         heartbeat.timeout_s * 1e3, 2e3 * heartbeat.toggle_cycles * period_s));
}

void Describe(Visitor& v, gpio::KeyPhasorConfig& key_phasor) {
  Describe(v, key_phasor.line);
  v.Integer({"pulses_per_turn", 1, 360, 1, "marks on the shaft, equally spaced"},
            key_phasor.pulses_per_turn);
  v.Number({"angle", kDegree, -360, 360, 0, "of the rotor when the line becomes active"},
           key_phasor.angle_rad);
  v.Number({"max_acceleration", kRpmPerSecond, 1, 1e7, kRequired,
            "a faster change of speed is not believed; at least twice what the drive can do"},
           key_phasor.max_acceleration_rad_per_s2);
  v.Number({"jitter", kMicrosecond, 0, 10000, 50, "of a time stamp, early or late"},
           key_phasor.jitter_s);
}

void RefuseSharedLines(Visitor& v, const gpio::LinesConfig& lines) {
  std::vector<const gpio::LinePlace*> places;
  places.reserve(5);
  for (const auto* line :
       {&lines.emergency_stop, &lines.amplifier_enable, &lines.amplifier_fault}) {
    if (*line) places.push_back(&**line);
  }
  if (lines.heartbeat) places.push_back(&lines.heartbeat->line);
  if (lines.key_phasor) places.push_back(&lines.key_phasor->line);
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      v.RefuseIf(
          places[i]->chip == places[j]->chip && places[i]->offset == places[j]->offset, "",
          fmt::format("two functions share line {} of {}", places[i]->offset, places[i]->chip));
    }
  }
}

}  // namespace

void Describe(Visitor& v, gpio::LinesConfig& lines, double period_s) {
  bool present = !lines.empty();
  v.OptionalGroup(
      "lines", "digital lines between controller and rig, used in real time", present, [&] {
        const auto place = [&](gpio::LinePlace& line) { Describe(v, line); };
        DescribeOptional(v, "emergency_stop", "input; active while the stop chain is closed",
                         lines.emergency_stop, place);
        DescribeOptional(v, "amplifier_enable", "output; active while amplifiers may drive current",
                         lines.amplifier_enable, place);
        DescribeOptional(v, "amplifier_fault", "input; active while an amplifier reports a fault",
                         lines.amplifier_fault, place);
        DescribeOptional(
            v, "heartbeat", "output; edges while the control cycle runs", lines.heartbeat,
            [&](gpio::HeartbeatConfig& heartbeat) { Describe(v, heartbeat, period_s); });
        DescribeOptional(v, "key_phasor", "input; becomes active once per mark of the shaft",
                         lines.key_phasor,
                         [&](gpio::KeyPhasorConfig& config) { Describe(v, config); });
        v.Number({"watchdog", kMillisecond, 4, 10000, 20,
                  "the guard process drops the enable line after this long without a cycle"},
                 lines.watchdog_s);
        RefuseSharedLines(v, lines);
        v.RefuseIf(lines.empty(), "", "names no line; leave the group out");
      });
  if (!present) lines = {};
}

}  // namespace levitas::configuration
