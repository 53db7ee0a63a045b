#include "controller/cycle/law_alone.hpp"

#include <algorithm>
#include <cmath>

#include "controller/cycle/law_at_rig_period.hpp"

namespace levitas::cycle {
namespace {

/// Both coils stay within 0 .. maximum.
double PermittedCurrent(const CycleConfig& config) {
  const double bias_a = config.rig.bias_current_a;
  const double limit_a = std::min(bias_a, config.rig.max_coil_current_a - bias_a);
  return config.law.current_limit_a > 0.0 ? std::min(limit_a, config.law.current_limit_a) : limit_a;
}

}  // namespace

LawAlone::LawAlone(const CycleConfig& config)
    : axes_(config.rig.axes()),
      limit_a_(PermittedCurrent(config)),
      probes_(config.rig),
      law_(LawAtRigPeriod(config)) {}

CycleOutputs LawAlone::Step(const CycleInputs& in) noexcept {
  const AxisArray position_m = probes_.Positions({in.frame.position_m}).at;
  bool usable = in.frame_present;
  AxisArray error_m{};
  for (std::size_t axis = 0; axis < axes_; ++axis) {
    usable = usable && std::isfinite(position_m[axis]);
    error_m[axis] = -position_m[axis];
    error_m[axis] -= in.op.excitation_m[axis];
  }
  if (usable) {
    const double speed = in.frame.speed_rad_per_s;
    if (!started_) law_.Start(speed);
    started_ = true;
    given_ = law_.Step(speed, error_m, in.op.excitation_a, limit_a_);
  }
  CycleOutputs out;
  out.current.cycle = in.frame.cycle;
  out.current.axes = static_cast<std::uint32_t>(axes_);
  out.current.control_current_a = probes_.Currents({given_.control_current_a}).at;
  out.current.amplifiers_enabled = true;
  out.saturated_axes = given_.saturated_axes;
  return out;
}

}  // namespace levitas::cycle
