#include "session/export_rows.hpp"

#include "common/rotational_speed.hpp"

namespace levitas::session {

ExportRows::ExportRows(const SessionHeader& header)
    : names_{"time_s", "rotor_angle_rad", "speed_rpm"},
      axes_(header.channels.size()),
      injects_position_(header.scenario_yaml.find("point: measured_position") != std::string::npos),
      period_ns_(static_cast<std::uint64_t>(header.period_ns)),
      from_zero_(header.pace == "realtime") {
  const auto name_all = [&](const char* quantity, const char* unit) {
    for (const auto& channel : header.channels) names_.push_back(quantity + channel + unit);
  };
  name_all("position_", "_m");
  name_all("control_current_", "_a");
  name_all("excitation_", "_a");
  if (injects_position_) name_all("excitation_", "_m");
}

// Modulo 2^64: stamps that no rig gives, of a file that lies, must not be undefined.
std::int64_t ExportRows::TimeOf(const cycle::CycleInputs& in) {
  const auto sample_ns = static_cast<std::uint64_t>(in.frame.sample_time_ns);
  if (!started_) {
    offset_ns_ = from_zero_ ? 0U - sample_ns : 0U;
  } else if (in.frame.rig_session != rig_session_) {
    // A new rig counts anew: the controller's own count bridges the restart.
    offset_ns_ = time_ns_ + (in.cycle - cycle_) * period_ns_ - sample_ns;
  }
  started_ = true;
  rig_session_ = in.frame.rig_session;
  cycle_ = in.cycle;
  time_ns_ = sample_ns + offset_ns_;
  return static_cast<std::int64_t>(time_ns_);
}

std::int64_t ExportRows::Next(const cycle::CycleRecord& record, std::vector<double>& values) {
  const SensorFrame& frame = record.in.frame;
  values.clear();
  values.push_back(frame.angle_rad);
  values.push_back(RadPerSToRpm(frame.speed_rad_per_s));
  const auto add = [&](const AxisArray& numbers) {
    for (std::size_t axis = 0; axis < axes_; ++axis) values.push_back(numbers[axis]);
  };
  add(frame.position_m);
  add(record.out.current.control_current_a);
  add(record.in.op.excitation_a);
  if (injects_position_) add(record.in.op.excitation_m);
  return TimeOf(record.in);
}

}  // namespace levitas::session
