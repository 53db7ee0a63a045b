#include "dashboard/snapshot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>

#include "common/enums.hpp"
#include "common/rotational_speed.hpp"

namespace levitas::dashboard {
namespace {

constexpr double kNano = 1e9;
constexpr double kMilli = 1e3;
constexpr std::int64_t kSilentNs = 1'000'000'000;  // a hundred states late
constexpr double kOrbitTurns = 2.0;
constexpr double kShortestOrbitSeconds = 0.02;
constexpr double kLongestOrbitSeconds = 0.1;
constexpr double kSlowestRadPerS = 1.0;  // [rad/s] below, the rotor counts as standing

/// A whole number; what is none becomes null, which JSON has and NaN is not.
void Put(std::string& text, double value) {
  if (!std::isfinite(value)) {
    text += "null";
    return;
  }
  constexpr double kMost = 9e15;  // exact in the page's numbers
  fmt::format_to(std::back_inserter(text), "{}",
                 static_cast<std::int64_t>(std::llround(std::clamp(value, -kMost, kMost))));
}

/// Adds "first,second,...", each `value(i)`.
template <class Value>
void PutList(std::string& text, std::size_t count, Value value) {
  text += '[';
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) text += ',';
    value(i);
  }
  text += ']';
}

/// How many samples the orbit picture spans: two turns, within bounds.
std::size_t OrbitSpan(const SampleStore& store) {
  const double speed = std::abs(static_cast<double>(store.Speed(0)));
  const double turns_s =
      speed > kSlowestRadPerS ? kOrbitTurns * 2.0 * std::numbers::pi / speed : kLongestOrbitSeconds;
  const double span_s = std::clamp(turns_s, kShortestOrbitSeconds, kLongestOrbitSeconds);
  const auto wanted = static_cast<std::size_t>(span_s / store.period_s());
  return std::min(wanted, store.contiguous());
}

/// The points of the orbit at which the key phasor has just passed.
void PutKeyPhasor(std::string& text, const SampleStore& store, std::size_t points,
                  std::size_t stride) {
  std::vector<std::size_t> passes;
  for (std::size_t back = points * stride - 1; back > 0; --back) {
    const double step =
        static_cast<double>(store.Angle(back - 1)) - static_cast<double>(store.Angle(back));
    if (std::abs(step) > std::numbers::pi) passes.push_back(points - 1 - (back - 1) / stride);
  }
  text += ",\"orbit_key\":";
  PutList(text, passes.size(), [&](std::size_t i) { Put(text, static_cast<double>(passes[i])); });
}

void PutOrbits(std::string& text, const SampleStore& store) {
  const std::size_t span = OrbitSpan(store);
  const std::size_t stride = std::max<std::size_t>(1, (span + kOrbitPoints - 1) / kOrbitPoints);
  const std::size_t points = span / stride;
  text += ",\"orbit_nm\":";
  PutList(text, store.bearings(), [&](std::size_t bearing) {
    PutList(text, 2 * points, [&](std::size_t i) {
      const std::size_t back = (points - 1 - i / 2) * stride;
      Put(text, kNano * static_cast<double>(store.Displacement(bearing, i % 2, back)));
    });
  });
  if (points > 0) PutKeyPhasor(text, store, points, stride);
}

void PutEnvelopes(std::string& text, std::vector<Envelope> buckets, std::size_t axes) {
  const std::size_t surplus = buckets.size() - std::min(buckets.size(), kTickEnvelopes);
  buckets.erase(buckets.begin(), buckets.begin() + static_cast<std::ptrdiff_t>(surplus));
  const auto both = [&](const std::vector<float> Envelope::*low,
                        const std::vector<float> Envelope::*high, double factor) {
    PutList(text, axes, [&](std::size_t axis) {
      PutList(text, 2 * buckets.size(), [&](std::size_t i) {
        const Envelope& bucket = buckets[i / 2];
        const auto& side = i % 2 == 0 ? bucket.*low : bucket.*high;
        Put(text, factor * static_cast<double>(side[axis]));
      });
    });
  };
  text += ",\"t_ms\":";
  PutList(text, buckets.size(), [&](std::size_t i) { Put(text, kMilli * buckets[i].time_s); });
  text += ",\"rpm\":";
  PutList(text, buckets.size(),
          [&](std::size_t i) { Put(text, RadPerSToRpm(buckets[i].speed_rad_per_s)); });
  text += ",\"position_nm\":";
  both(&Envelope::low_m, &Envelope::high_m, kNano);
  text += ",\"current_ma\":";
  both(&Envelope::low_a, &Envelope::high_a, kMilli);
}

void PutState(std::string& text, const LiveRun& run, std::int64_t now_ns) {
  const auto& state = run.state();
  const bool silent = !state || now_ns - run.state_arrived_ns() > kSilentNs;
  fmt::format_to(std::back_inserter(text), "\"silent\":{}", silent);
  if (!state) return;
  fmt::format_to(
      std::back_inserter(text),
      ",\"cycle\":{},\"mode\":\"{}\",\"fault\":\"{}\",\"fault_axis\":{},\"records_lost\":{}",
      state->cycle, Name(static_cast<Mode>(state->mode)), Name(static_cast<Fault>(state->fault)),
      static_cast<int>(state->fault_axis), state->records_lost);
  text += ",\"speed_rpm\":";
  Put(text, RadPerSToRpm(state->speed_rad_per_s));
  text += ",\"bias_ma\":";
  Put(text, kMilli * state->bias_current_a);
  if (run.saves_bias()) text += ",\"saves_bias\":true";
  if (run.blocks().empty()) return;
  nlohmann::json blocks = nlohmann::json::array();
  for (const LiveBlock& block : run.blocks()) {
    blocks.push_back({{"name", block.name}, {"acts", block.acts}, {"why", block.why}});
  }
  text += ",\"blocks\":" + blocks.dump();
}

/// Of a configuration file's text: what stands behind the key `name` of its top level.
std::string NameIn(const std::string& yaml) {
  constexpr std::string_view kKey = "name: ";
  const std::size_t at =
      yaml.starts_with(kKey) ? 0 : std::min(yaml.find("\nname: "), yaml.size() - 1) + 1;
  if (at >= yaml.size()) return {};
  const std::size_t from = at + kKey.size();
  return yaml.substr(from, std::min(yaml.find('\n', from), yaml.size()) - from);
}

}  // namespace

std::string RigJson(const LiveRun& run, std::int64_t server) {
  nlohmann::json json{{"run", run.run_number()}, {"server", server}};
  if (run.rig()) {
    const RigNumbers& rig = *run.rig();
    const session::SessionHeader& header = run.header();
    json.update({{"name", rig.name},
                 {"channels", rig.channels},
                 {"bearings", rig.bearings},
                 {"speed_ratios", run.speed_ratios()},
                 {"period_s", rig.period_s()},
                 {"clearance_m", rig.clearance_m},
                 {"bias_a", rig.bias_current_a},
                 {"max_coil_current_a", rig.max_coil_current_a},
                 {"amplifier_hz", run.amplifier_hz()},
                 {"max_speed_rpm", RadPerSToRpm(rig.max_speed_rad_per_s)},
                 {"controller", NameIn(header.controller_yaml)},
                 {"scenario", NameIn(header.scenario_yaml)},
                 {"pace", header.pace},
                 {"version", header.program_version},
                 {"source", header.source}});
  }
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string TickJson(LiveRun& run, std::int64_t now_ns) {
  std::string text = "{";
  PutState(text, run, now_ns);
  if (auto& store = run.samples(); store && store->count() > 0) {
    fmt::format_to(std::back_inserter(text), ",\"sample_ns\":{},\"sent_ns\":{}",
                   store->newest_time_ns(), now_ns);
    PutOrbits(text, *store);
    PutEnvelopes(text, store->TakeEnvelopes(), store->axes());
  }
  return text + "}";
}

std::string SpectrumJson(const FullSpectrum& spectrum,
                         const std::vector<std::complex<double>>& first_order) {
  std::string text = fmt::format(
      "{{\"line_hz\":{},\"highest_hz\":{},\"t_ms\":{:.0f},\"rpm\":{:.1f}", spectrum.line_spacing_hz,
      spectrum.highest_hz, kMilli * spectrum.time_s, RadPerSToRpm(spectrum.speed_rad_per_s));
  // Tenths of a nanometre: below the noise of any sensor here, and short.
  text += ",\"amplitude_dnm\":";
  PutList(text, spectrum.amplitude_m.size(), [&](std::size_t bearing) {
    const auto& lines = spectrum.amplitude_m[bearing];
    PutList(text, lines.size(), [&](std::size_t i) { Put(text, 10.0 * kNano * lines[i]); });
  });
  if (first_order.empty()) return text + "}";
  text += ",\"first_order_nm\":";
  PutList(text, first_order.size(),
          [&](std::size_t i) { Put(text, kNano * std::abs(first_order[i])); });
  constexpr double kTenthsOfDegrees = 1800.0 / std::numbers::pi;
  text += ",\"first_order_ddeg\":";
  PutList(text, first_order.size(),
          [&](std::size_t i) { Put(text, kTenthsOfDegrees * std::arg(first_order[i])); });
  return text + "}";
}

std::string TimingJson(const LiveRun& run) {
  nlohmann::json json;
  if (const auto& t = run.timing()) {
    json.update({{"cycles", t->cycle},
                 {"skipped", t->skipped_periods},
                 {"missing_frames", t->missing_frames},
                 {"wakeup_p99_ns", t->wakeup_p99_ns},
                 {"wakeup_max_ns", t->wakeup_max_ns},
                 {"compute_p50_ns", t->compute_p50_ns},
                 {"compute_p99_ns", t->compute_p99_ns},
                 {"compute_max_ns", t->compute_max_ns},
                 {"latency_p99_ns", t->latency_p99_ns}});
  }
  if (const auto& h = run.histogram()) {
    json.update({{"edge_ns", h->edge_ns},
                 {"wakeup", h->wakeup},
                 {"compute", h->compute},
                 {"latency", h->latency}});
  }
  return json.dump();
}

std::string EventJson(const NumberedEvent& numbered) {
  const session::Event& event = numbered.event;
  const nlohmann::json json{
      {"number", numbered.number}, {"cycle", event.cycle},
      {"time_s", numbered.time_s}, {"severity", static_cast<int>(event.severity)},
      {"mode", Name(event.mode)},  {"fault", Name(event.fault)},
      {"text", event.text}};
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string EndJson(const std::string& how) {
  return nlohmann::json{{"text", how}}.dump(-1, ' ', false,
                                            nlohmann::json::error_handler_t::replace);
}

}  // namespace levitas::dashboard
