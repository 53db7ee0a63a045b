#include "hil/rig_lines/rig_lines.hpp"

#include <cmath>
#include <numbers>

namespace levitas::gpio {

namespace {
std::optional<std::int64_t> HeartbeatTimeout(const LinesConfig& config) {
  if (!config.heartbeat) return std::nullopt;
  return static_cast<std::int64_t>(config.heartbeat->timeout_s * 1e9);
}
}  // namespace

RigLines::RigLines(const LinesConfig& config) : gate_(HeartbeatTimeout(config)) {
  if (config.amplifier_enable) enable_.emplace(*config.amplifier_enable);
  if (config.heartbeat) heartbeat_.emplace(config.heartbeat->line);
  if (config.key_phasor) {
    key_phasor_.emplace(config.key_phasor->line);
    mark_rad_ = config.key_phasor->angle_rad;
    spacing_rad_ = 2.0 * std::numbers::pi / config.key_phasor->pulses_per_turn;
    key_phasor_->Pull(false);
  }
  if (config.emergency_stop) SimulatedLine(*config.emergency_stop).Pull(true);
  if (config.amplifier_fault) SimulatedLine(*config.amplifier_fault).Pull(false);
}

bool RigLines::Poll(std::int64_t now_ns) noexcept {
  const bool enable = !enable_ || enable_->Driven();
  const bool heartbeat = heartbeat_ && heartbeat_->Driven();
  switch (gate_.Sample(enable, heartbeat, now_ns)) {
    case GateEvent::kNone:
      break;
    case GateEvent::kOpened:
      counters_.opened.fetch_add(1, std::memory_order_relaxed);
      break;
    case GateEvent::kEnableFell:
      counters_.enable_falls.fetch_add(1, std::memory_order_relaxed);
      break;
    case GateEvent::kHeartbeatLost:
      counters_.heartbeat_losses.fetch_add(1, std::memory_order_relaxed);
      break;
  }
  return gate_.open();
}

void RigLines::Turn(double angle_rad) noexcept {
  if (!key_phasor_) return;
  double past_rad = std::fmod(angle_rad - mark_rad_, spacing_rad_);
  if (past_rad < 0.0) past_rad += spacing_rad_;
  const bool on_mark = past_rad < spacing_rad_ / 2.0;
  if (on_mark == on_mark_) return;
  on_mark_ = on_mark;
  key_phasor_->Pull(on_mark);
}

}  // namespace levitas::gpio
