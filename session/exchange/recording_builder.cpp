#include "session/exchange/recording_builder.hpp"

#include <algorithm>
#include <cmath>

namespace levitas::session {
namespace {

/// Appends `value`; a column stays empty until a value is not zero.
void AppendUnlessZero(Column& column, double value, std::size_t rows_before) {
  if (column.empty() && value == 0.0) return;
  if (column.empty()) column.assign(rows_before, 0.0);
  column.push_back(value);
}

}  // namespace

RecordingBuilder::RecordingBuilder(const std::string& name, const RigNumbers& rig)
    : frame_(rig), axes_(rig.axes()) {
  recording_.name = name;
  recording_.period_ns = rig.period_ns;
  recording_.channels = rig.channels;
  for (std::size_t axis = 0; axis < axes_; ++axis) {
    recording_.sensor_range_m.push_back(rig.SensorRangeOf(axis / 2));
  }
  recording_.current_limit_a =
      std::min(rig.bias_current_a, rig.max_coil_current_a - rig.bias_current_a);
  for (auto* columns : {&recording_.position_m, &recording_.current_a, &recording_.excitation_a,
                        &recording_.excitation_m}) {
    columns->assign(axes_, {});
  }
}

void RecordingBuilder::Take(const cycle::CycleRecord& record) {
  const SensorFrame& frame = record.in.frame;
  const CurrentFrame& command = record.out.current;
  TakeCoils(record.in);
  for (std::size_t axis = 0; axis < axes_; ++axis) {
    AppendUnlessZero(recording_.excitation_a[axis], record.in.op.excitation_a[axis],
                     recording_.rows());
    AppendUnlessZero(recording_.excitation_m[axis], record.in.op.excitation_m[axis],
                     recording_.rows());
  }
  const AxisSample sample = frame_.Bearing(record);
  for (std::size_t axis = 0; axis < axes_; ++axis) {
    recording_.position_m[axis].push_back(sample.position_m[axis]);
    recording_.current_a[axis].push_back(sample.current_a[axis]);
  }
  recording_.levitated.push_back(IsLevitated(record, axes_) ? 1 : 0);
  recording_.amplifiers_enabled.push_back(command.amplifiers_enabled ? 1 : 0);
  recording_.speed_rad_per_s.push_back(frame.speed_rad_per_s);
  recording_.angle_rad.push_back(frame.angle_rad);
  recording_.bias_current_a.push_back(command.bias_current_a);
  recording_.cycle.push_back(frame.cycle);
  recording_.time_s.push_back(1e-9 * static_cast<double>(frame.sample_time_ns));
}

Recording RecordingBuilder::Finish() {
  recording_.cycle.shrink_to_fit();
  recording_.levitated.shrink_to_fit();
  recording_.amplifiers_enabled.shrink_to_fit();
  for (Column* column : {&recording_.time_s, &recording_.speed_rad_per_s, &recording_.angle_rad,
                         &recording_.bias_current_a}) {
    column->shrink_to_fit();
  }
  for (auto* columns : {&recording_.position_m, &recording_.current_a, &recording_.excitation_a,
                        &recording_.excitation_m, &recording_.coil_current_a}) {
    for (Column& column : *columns) column.shrink_to_fit();
  }
  return std::move(recording_);
}

// The first record that has coil currents adds their columns; rows without are NaN.
void RecordingBuilder::TakeCoils(const cycle::CycleInputs& in) {
  auto& coils = recording_.coil_current_a;
  if (in.coils > coils.size()) {
    coils.resize(in.coils, Column(recording_.rows(), std::nan("")));
  }
  for (std::size_t coil = 0; coil < coils.size(); ++coil) {
    coils[coil].push_back(coil < in.coils ? in.coil_current_a[coil] : std::nan(""));
  }
}

}  // namespace levitas::session
