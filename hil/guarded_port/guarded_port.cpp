#include "hil/guarded_port/guarded_port.hpp"

namespace levitas::gpio {

GuardedPort::GuardedPort(port::RigPort& port, Lines& lines, const LinesConfig& config) noexcept
    : port_(port), lines_(lines) {
  if (config.heartbeat) heartbeat_.emplace(config.heartbeat->toggle_cycles);
  if (config.key_phasor) key_phasor_.emplace(*config.key_phasor);
}

port::ReadResult GuardedPort::Read(SensorFrame& frame, std::int64_t deadline_ns) noexcept {
  const port::ReadResult result = port_.Read(frame, deadline_ns);
  TakeInputs(frame);
  if (result == port::ReadResult::kFrame && key_phasor_) TakePulses(frame);
  return result;
}

void GuardedPort::TakeInputs(SensorFrame& frame) noexcept {
  const InputLevels levels = lines_.ReadInputs();
  const bool closed = levels.stop_chain_closed && levels.readable;
  if (!closed) frame.rig_status |= kRigEmergencyStop;
  if (chain_closed_ && !closed) ++counters_.stops;
  chain_closed_ = closed;
  if (levels.amplifier_fault || write_failed_) frame.rig_status |= kRigAmplifierFault;
}

void GuardedPort::TakePulses(SensorFrame& frame) noexcept {
  const std::size_t count = lines_.ReadPulses(pulse_ns_);
  for (std::size_t i = 0; i < count; ++i) key_phasor_->Pulse(pulse_ns_.at(i));
  const SpeedReading reading = key_phasor_->At(frame.sample_time_ns);
  frame.speed_rad_per_s = reading.speed_rad_per_s;
  frame.angle_rad = reading.angle_rad;
  if (reading.state == SpeedState::kUnknown) frame.rig_status |= kRigSpeedUnknown;
  counters_.pulses = key_phasor_->counters();
}

bool GuardedPort::Write(const CurrentFrame& frame) noexcept {
  const bool sent = port_.Write(frame);
  bool written = true;
  if (frame.amplifiers_enabled != enabled_) {
    written = lines_.WriteEnable(frame.amplifiers_enabled);
    if (frame.amplifiers_enabled && written) ++counters_.enables;
    // What could not be written is tried again in the next cycle.
    if (written) enabled_ = frame.amplifiers_enabled;
  }
  if (heartbeat_ && heartbeat_->Step()) {
    written = lines_.WriteHeartbeat(heartbeat_->level()) && written;
  }
  write_failed_ = !written;
  if (!written) ++counters_.write_failures;
  lines_.CycleDone();
  return sent;
}

void GuardedPort::SayGoodbye(const CurrentFrame& last) noexcept {
  lines_.WriteEnable(false);
  enabled_ = false;
  port_.SayGoodbye(last);
}

}  // namespace levitas::gpio
