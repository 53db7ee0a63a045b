#include "controller/law/law_schedule.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace levitas::law {
namespace {

/// Where a speed stands between two of the table.
struct Place {
  std::size_t below{};  ///< above is the next one
  double share{};       ///< 0 to 1 of the way
};

Place PlaceOf(const std::vector<LawAtSpeed>& schedule, double speed_rad_per_s) {
  const double speed = std::abs(speed_rad_per_s);
  if (!(speed > schedule.front().speed_rad_per_s)) return {};
  for (std::size_t i = 0; i + 1 < schedule.size(); ++i) {
    const double from = schedule[i].speed_rad_per_s;
    const double to = schedule[i + 1].speed_rad_per_s;
    if (speed <= to) return {i, (speed - from) / (to - from)};
  }
  return {schedule.size() - 2, 1.0};
}

AxisLawConfig Between(const AxisLawConfig& a, const AxisLawConfig& b, double share) {
  const auto mix = [share](double from, double to) { return std::lerp(from, to, share); };
  AxisLawConfig out = a;
  out.kp_a_per_m = mix(a.kp_a_per_m, b.kp_a_per_m);
  out.ki_a_per_m_s = mix(a.ki_a_per_m_s, b.ki_a_per_m_s);
  out.kd_a_s_per_m = mix(a.kd_a_s_per_m, b.kd_a_s_per_m);
  out.derivative_hz = mix(a.derivative_hz, b.derivative_hz);
  for (std::size_t i = 0; i < out.lead_lags.size(); ++i) {
    out.lead_lags[i] = {mix(a.lead_lags[i].zero_hz, b.lead_lags[i].zero_hz),
                        mix(a.lead_lags[i].pole_hz, b.lead_lags[i].pole_hz)};
  }
  for (std::size_t i = 0; i < out.notches.size(); ++i) {
    Notch& notch = out.notches[i];
    const Notch& to = b.notches[i];
    notch.frequency_hz = mix(notch.frequency_hz, to.frequency_hz);
    notch.zero_damping = mix(notch.zero_damping, to.zero_damping);
    notch.pole_damping = mix(notch.pole_damping, to.pole_damping);
  }
  return out;
}

AxisArray Between(const AxisArray& a, const AxisArray& b, double share) {
  AxisArray out{};
  for (std::size_t i = 0; i < kMaxAxes; ++i) out[i] = std::lerp(a[i], b[i], share);
  return out;
}

StateSpaceConfig Between(const StateSpaceConfig& a, const StateSpaceConfig& b, double share) {
  StateSpaceConfig out = a;
  for (std::size_t i = 0; i < out.blocks.size(); ++i) {
    ModalBlock& block = out.blocks[i];
    const ModalBlock& to = b.blocks[i];
    block.pole_real = std::lerp(block.pole_real, to.pole_real, share);
    block.pole_imaginary = std::lerp(block.pole_imaginary, to.pole_imaginary, share);
    block.first_input = Between(block.first_input, to.first_input, share);
    block.second_input = Between(block.second_input, to.second_input, share);
    block.first_output = Between(block.first_output, to.first_output, share);
    block.second_output = Between(block.second_output, to.second_output, share);
  }
  for (std::size_t i = 0; i < kMaxAxes; ++i)
    out.direct[i] = Between(a.direct[i], b.direct[i], share);
  out.input_v_per_m = Between(a.input_v_per_m, b.input_v_per_m, share);
  out.output_a_per_v = Between(a.output_a_per_v, b.output_a_per_v, share);
  return out;
}

std::string WhyDifferent(const AxisLawConfig& a, const AxisLawConfig& b, std::size_t axis) {
  const std::string where = "axis " + std::to_string(axis + 1) + " has ";
  if (a.lead_lags.size() != b.lead_lags.size()) {
    return where + std::to_string(a.lead_lags.size()) + " lead-lags before and " +
           std::to_string(b.lead_lags.size()) + " here";
  }
  if (a.notches.size() != b.notches.size()) {
    return where + std::to_string(a.notches.size()) + " notches before and " +
           std::to_string(b.notches.size()) + " here";
  }
  for (std::size_t i = 0; i < a.notches.size(); ++i) {
    if (a.notches[i].prewarp != b.notches[i].prewarp) {
      return where + "a notch whose prewarp is not that of the one before";
    }
  }
  return {};
}

std::string WhyDifferent(const StateSpaceConfig& a, const StateSpaceConfig& b) {
  if (a.axes != b.axes) return "its state-space law is of other axes than the one before";
  if (a.discrete != b.discrete) return "its blocks are in another time than those before";
  if (a.blocks.size() != b.blocks.size()) {
    return "it has " + std::to_string(b.blocks.size()) + " blocks, the one before " +
           std::to_string(a.blocks.size());
  }
  for (std::size_t i = 0; i < a.blocks.size(); ++i) {
    const double before = a.blocks[i].pole_imaginary;
    const double here = b.blocks[i].pole_imaginary;
    if ((before == 0.0) != (here == 0.0) || before * here < 0.0) {
      return "its block " + std::to_string(i + 1) +
             " is not of the kind of the one before: one state or two, one sign of im";
    }
  }
  return {};
}

std::size_t AxesOf(const LawAtSpeed& at) {
  return at.state_space ? at.state_space->axes : at.axes.size();
}

/// The entries of a table, that of rest included.
std::vector<LawAtSpeed> TableOf(const LawConfig& config) {
  std::vector<LawAtSpeed> table{{0.0, config.axes, config.state_space}};
  table.insert(table.end(), config.schedule.begin(), config.schedule.end());
  return table;
}

double WidthOf(const LawConfig& config) {
  return config.schedule.back().speed_rad_per_s / static_cast<double>(kRungs - 1);
}

/// The rung nearest to a speed, of which what is no number is the first.
std::size_t NearestRung(double speed_rad_per_s, double width_rad_per_s) noexcept {
  constexpr auto kLast = static_cast<double>(kRungs - 1);
  const double rung = std::abs(speed_rad_per_s) / width_rad_per_s;
  return rung > 0.0 ? static_cast<std::size_t>(std::lround(std::min(rung, kLast))) : 0;
}

/// A law of the table as it stands.
LawConfig Alone(const LawConfig& config, const LawAtSpeed& at) {
  LawConfig out;
  out.period_s = config.period_s;
  out.current_limit_a = config.current_limit_a;
  out.axes = at.axes;
  out.state_space = at.state_space;
  return out;
}

Place PlaceOfRung(const LawConfig& config, const std::vector<LawAtSpeed>& table, std::size_t rung) {
  // The last rung is the last entry, whatever rounding makes of its speed.
  if (rung + 1 == kRungs) return {table.size() - 2, 1.0};
  return PlaceOf(table, WidthOf(config) * static_cast<double>(rung));
}

LawConfig AtRung(const LawConfig& config, const std::vector<LawAtSpeed>& table, std::size_t rung) {
  const Place place = PlaceOfRung(config, table, rung);
  const LawAtSpeed& below = table[place.below];
  const LawAtSpeed& above = table[place.below + 1];
  if (above.exchange) return Alone(config, place.share < 1.0 ? below : above);
  LawConfig out = Alone(config, {});
  for (std::size_t axis = 0; axis < below.axes.size(); ++axis) {
    out.axes.push_back(Between(below.axes[axis], above.axes[axis], place.share));
  }
  if (below.state_space) {
    out.state_space = Between(*below.state_space, *above.state_space, place.share);
  }
  return out;
}

constexpr double kFarEnough = 0.75;  // of a rung

/// [rungs] by which the speed falls below an exchange before it is taken back: a tachometer's noise
/// of a percent at a speed that stands there must not make the laws change to and fro.
double BackFrom(std::size_t exchange) noexcept {
  constexpr double kShare = 0.03;  // of its speed
  return std::max(kFarEnough, kShare * static_cast<double>(exchange));
}

/// How many exchanges lie at or below a rung.
std::size_t ExchangesTo(const Place& place, const std::vector<LawAtSpeed>& table) {
  std::size_t count = 0;
  for (std::size_t i = 1; i <= place.below + 1; ++i) {
    const bool reached = i <= place.below || place.share >= 1.0;
    if (table[i].exchange && reached) ++count;
  }
  return count;
}

void RefuseNoSchedule(const LawConfig& config) {
  const std::string why = WhyNoSchedule(config);
  if (!why.empty()) throw std::invalid_argument("schedule: " + why);
}

}  // namespace

std::string WhyUnlike(const LawAtSpeed& a, const LawAtSpeed& b) {
  if (a.state_space.has_value() != b.state_space.has_value()) {
    return "one has a state-space law, the other laws of axes";
  }
  if (a.state_space) return WhyDifferent(*a.state_space, *b.state_space);
  if (a.axes.size() != b.axes.size()) return "it has laws for other axes than the one before";
  for (std::size_t axis = 0; axis < a.axes.size(); ++axis) {
    std::string why = WhyDifferent(a.axes[axis], b.axes[axis], axis);
    if (!why.empty()) return why;
  }
  return {};
}

std::string WhyNotAfter(const LawAtSpeed& before, const LawAtSpeed& at) {
  if (!(at.speed_rad_per_s > before.speed_rad_per_s)) {
    return before.speed_rad_per_s == 0.0
               ? "its speed is not above rest, where the law of the file holds"
               : "its speed is not above that of the entry before";
  }
  if (at.exchange) {
    return AxesOf(before) != AxesOf(at) ? "it has laws for other axes than the one before" : "";
  }
  const std::string why = WhyUnlike(before, at);
  return why.empty() ? why : why + "; `exchange: true` lets it take over all the same";
}

std::string WhyNoSchedule(const LawConfig& config) {
  const std::vector<LawAtSpeed> table = TableOf(config);
  for (std::size_t i = 1; i < table.size(); ++i) {
    const std::string why = WhyNotAfter(table[i - 1], table[i]);
    if (!why.empty()) return "entry " + std::to_string(i) + ": " + why;
  }
  return {};
}

LawConfig LawAt(const LawConfig& config, double speed_rad_per_s) {
  if (config.schedule.empty()) return config;
  RefuseNoSchedule(config);
  return AtRung(config, TableOf(config), NearestRung(speed_rad_per_s, WidthOf(config)));
}

std::vector<Exchange> Exchanges(const LawConfig& config) {
  std::vector<Exchange> out;
  if (config.schedule.empty()) return out;
  RefuseNoSchedule(config);
  const std::vector<LawAtSpeed> table = TableOf(config);
  const double width = WidthOf(config);
  for (std::size_t rung = 1; rung < kRungs; ++rung) {
    const Place here = PlaceOfRung(config, table, rung);
    if (ExchangesTo(here, table) == ExchangesTo(PlaceOfRung(config, table, rung - 1), table)) {
      continue;
    }
    const auto at = static_cast<double>(rung);
    out.push_back({AtRung(config, table, rung - 1), AtRung(config, table, rung), width * at,
                   width * (at - BackFrom(rung))});
  }
  return out;
}

LawLadder::LawLadder(const LawConfig& config) {
  if (config.schedule.empty()) {
    rungs_.emplace_back(config);
    stretches_.push_back(0);
    return;
  }
  RefuseNoSchedule(config);
  width_rad_per_s_ = WidthOf(config);
  const std::vector<LawAtSpeed> table = TableOf(config);
  rungs_.reserve(kRungs);
  for (std::size_t rung = 0; rung < kRungs; ++rung) {
    rungs_.emplace_back(AtRung(config, table, rung));
    stretches_.push_back(ExchangesTo(PlaceOfRung(config, table, rung), table));
  }
}

std::size_t LawLadder::Nearest(double speed_rad_per_s) const noexcept {
  if (rungs_.size() == 1) return 0;
  return NearestRung(speed_rad_per_s, width_rad_per_s_);
}

std::size_t LawLadder::Next(std::size_t rung, double speed_rad_per_s) const noexcept {
  if (rungs_.size() == 1) return 0;
  const double here = width_rad_per_s_ * static_cast<double>(rung);
  const double off = (std::abs(speed_rad_per_s) - here) / width_rad_per_s_;
  if (off > kFarEnough) return std::min(rung + 1, rungs_.size() - 1);
  if (rung == 0) return rung;
  const bool exchange = Stretch(rung) != Stretch(rung - 1);
  return off < -(exchange ? BackFrom(rung) : kFarEnough) ? rung - 1 : rung;
}

bool LawLadder::StillAsksFor(std::size_t acting, std::size_t other,
                             double speed_rad_per_s) const noexcept {
  const std::size_t exchange = std::max(acting, other);
  const double off = std::abs(speed_rad_per_s) / width_rad_per_s_ - static_cast<double>(exchange);
  const double back = -0.5 * BackFrom(exchange);
  return other > acting ? !(off < back) : !(off > back);
}

}  // namespace levitas::law
