#include "controller/cycle/control_cycle.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "common/probe_map.hpp"
#include "controller/bias/bias_saving.hpp"
#include "controller/cycle/law_at_rig_period.hpp"
#include "controller/law/running_law.hpp"
#include "controller/supervisor/supervisor.hpp"
#include "controller/synchronous/synchronous_control.hpp"

namespace levitas::cycle {
namespace {

const RigNumbers& CheckedRig(const CycleConfig& config) {
  const std::size_t axes = config.rig.axes();
  if (axes == 0 || axes > kMaxAxes || (axes % 2 != 0 && axes != 1)) {
    throw std::invalid_argument("rig: " + std::to_string(axes) +
                                " axes, allowed 1 or an even number to " +
                                std::to_string(kMaxAxes));
  }
  return config.rig;
}

law::LawConfig CheckedLaw(const CycleConfig& config) {
  const std::size_t axes = config.rig.axes();
  if (config.law.axis_count() != axes) {
    throw std::invalid_argument("law for " + std::to_string(config.law.axis_count()) +
                                " axes, the rig has " + std::to_string(axes));
  }
  if (config.law.period_s > 0.0 &&
      std::abs(config.law.period_s - config.rig.period_s()) > 1e-9 * config.rig.period_s()) {
    throw std::invalid_argument("law discretised for a period of " +
                                std::to_string(config.law.period_s) + " s, the rig samples every " +
                                std::to_string(config.rig.period_s()) + " s");
  }
  return LawAtRigPeriod(config);
}

// Both coils stay within 0 .. maximum: i0 - |ic| >= 0 and i0 + |ic| <= maximum.
double CurrentLimit(const CycleConfig& config) {
  const double bias_a = config.rig.bias_current_a;
  double limit_a = std::min(bias_a, config.rig.max_coil_current_a - bias_a);
  if (config.law.current_limit_a > 0.0) limit_a = std::min(limit_a, config.law.current_limit_a);
  if (!(limit_a > 0.0)) {
    throw std::invalid_argument("rig: bias_current_a = " + std::to_string(bias_a) +
                                " leaves no control current below max_coil_current_a = " +
                                std::to_string(config.rig.max_coil_current_a));
  }
  return limit_a;
}

std::unique_ptr<law::OwnLaw> Given(std::unique_ptr<law::OwnLaw> own) {
  if (own == nullptr) throw std::invalid_argument("a law of one's own: there is none");
  return own;
}

}  // namespace

struct ControlCycle::Impl {
  /// Without a law of one's own, that of the configuration.
  Impl(const CycleConfig& config, std::unique_ptr<law::OwnLaw> law)
      : rig(CheckedRig(config)),
        limit_a(CurrentLimit(config)),
        probes(config.rig),
        own(std::move(law)),
        supervisor(config.rig, config.supervisor),
        bias(config.bias, config.rig),
        synchronous(config.synchronous, config.rig, config.supervisor.protection.orbit_fraction) {
    if (own == nullptr) file.emplace(CheckedLaw(config));
  }

  void Read(const CycleInputs& in) noexcept;
  void RunLaw(const OperatorInput& op, const supervisor::Decision& decision) noexcept;
  void StartLaw(const supervisor::Decision& decision) noexcept;
  [[nodiscard]] law::LawOutput StepLaw(const supervisor::Decision& decision,
                                       const AxisArray& error_m, const AxisArray& injected_a,
                                       double allowed_a) noexcept;
  void MoveBias(const OperatorInput& op, const supervisor::Decision& decision) noexcept;
  void CheckLaw() noexcept;
  [[nodiscard]] synchronous::Conditions SynchronousConditions(
      const supervisor::Decision& decision) const noexcept;
  [[nodiscard]] CycleOutputs Outputs(const supervisor::Decision& decision) const noexcept;

  RigNumbers rig;
  double limit_a;
  ProbeMap probes;
  std::optional<law::RunningLaw> file;  ///< one of the two is there
  std::unique_ptr<law::OwnLaw> own;
  supervisor::Supervisor supervisor;
  bias::BiasSaving bias;
  synchronous::SynchronousControl synchronous;
  supervisor::Observation seen;
  double angle_rad{};  ///< of the latest fresh frame
  std::uint64_t frame_cycle{};
  bool any_frame{};
  law::LawOutput given;       // bearing frame
  AxisArray law_current_a{};  ///< at the rig's bias
};

// A frame whose number is not above the last one's (unless the rig has started anew), or that has
// other axes than the rig, is not a new frame.
void ControlCycle::Impl::Read(const CycleInputs& in) noexcept {
  const SensorFrame& frame = in.frame;
  const bool old = any_frame && frame.cycle <= frame_cycle && frame.rig_session == seen.rig_session;
  seen.cycle = in.cycle;
  seen.missed_deadlines = in.missed_deadlines;
  seen.saturated_axes = given.saturated_axes;
  seen.fresh = in.frame_present && frame.axes == rig.axes() && !old;
  if (!seen.fresh) {
    // The stop chain may be a line of its own, read without a frame (hil/guarded_port).
    seen.rig_status |= frame.rig_status & kRigEmergencyStop;
    return;
  }
  any_frame = true;
  frame_cycle = frame.cycle;
  seen.position_m = probes.Positions({frame.position_m}).at;
  seen.speed_rad_per_s = frame.speed_rad_per_s;
  angle_rad = frame.angle_rad;
  seen.rig_session = frame.rig_session;
  seen.rig_status = frame.rig_status;
  seen.held_currents = frame.held_currents;
}

// Test signals pass where the rotor is levitated about its centre and nothing has tripped;
// synchronous control acts in the same states.
synchronous::Conditions ControlCycle::Impl::SynchronousConditions(
    const supervisor::Decision& decision) const noexcept {
  return {.angle = {.fresh = seen.fresh,
                    .speed_unknown = (seen.rig_status & kRigSpeedUnknown) != 0,
                    .angle_rad = angle_rad,
                    .speed_rad_per_s = seen.speed_rad_per_s,
                    .periods = 1 + seen.missed_deadlines},
          .believed_speed_rad_per_s = decision.believed_speed_rad_per_s,
          .levitated = supervisor::Row(decision.state).excitation,
          .saturated_axes = seen.saturated_axes,
          .position_m = seen.position_m};
}

void ControlCycle::Impl::StartLaw(const supervisor::Decision& decision) noexcept {
  synchronous.Reset();
  bias.Reset();
  law_current_a = {};
  if (own != nullptr) {
    own->Start();
    return;
  }
  file->Start(decision.believed_speed_rad_per_s);
}

// A law of one's own says what it wants; the limit holds for it as for any other. What is no number
// passes, for CheckLaw to see.
law::LawOutput ControlCycle::Impl::StepLaw(const supervisor::Decision& decision,
                                           const AxisArray& error_m, const AxisArray& injected_a,
                                           double allowed_a) noexcept {
  if (own == nullptr) {
    return file->Step(decision.believed_speed_rad_per_s, error_m, injected_a, allowed_a);
  }
  const AxisArray wanted_a = own->Step({.error_m = error_m,
                                        .axes = rig.axes(),
                                        .limit_a = allowed_a,
                                        .speed_rad_per_s = decision.believed_speed_rad_per_s});
  law::LawOutput out;
  for (std::size_t i = 0; i < rig.axes(); ++i) {
    const double asked_a = wanted_a[i] + injected_a[i];
    out.control_current_a[i] = std::clamp(asked_a, -allowed_a, allowed_a);
    if (std::abs(asked_a) > allowed_a) out.saturated_axes |= static_cast<std::uint16_t>(1U << i);
  }
  return out;
}

// Without a fresh frame the last currents are held and the filters wait. Positions are taken at
// most as far as the converter reaches: beyond it a number means nothing.
void ControlCycle::Impl::RunLaw(const OperatorInput& op,
                                const supervisor::Decision& decision) noexcept {
  const supervisor::StateRow& row = supervisor::Row(decision.state);
  if (decision.start_law) StartLaw(decision);
  if (!row.energised || !seen.fresh) {
    synchronous.Wait(SynchronousConditions(decision));
    if (!row.energised) given = {};
    return;
  }
  AxisArray error_m{};
  AxisArray injected_a{};
  for (std::size_t i = 0; i < rig.axes(); ++i) {
    const double range_m = rig.SensorRangeOf(i / 2);
    const double position_m = std::clamp(seen.position_m[i], -range_m, range_m);
    error_m[i] = decision.reference_m[i] - position_m;
    if (!row.excitation) continue;
    if (std::isfinite(op.excitation_a[i])) injected_a[i] = op.excitation_a[i];
    if (std::isfinite(op.excitation_m[i])) error_m[i] -= op.excitation_m[i];
  }
  synchronous.Step(SynchronousConditions(decision), error_m, injected_a);
  MoveBias(op, decision);
  AxisArray read_m{};
  for (std::size_t i = 0; i < rig.axes(); ++i) read_m[i] = decision.reference_m[i] - error_m[i];
  given = StepLaw(decision, error_m, injected_a, bias.LimitOf(limit_a, read_m));
  law_current_a = given.control_current_a;
  if (bias.empty()) return;
  given.control_current_a = bias.At(law_current_a, read_m);
  for (std::size_t i = 0; i < rig.axes(); ++i) {
    const bool limited = std::abs(given.control_current_a[i]) >= bias.room_a();
    if (limited) given.saturated_axes |= static_cast<std::uint16_t>(1U << i);
  }
}

// A rotor that is not at its speed yet, or coasts down, will pass what nobody has seen: the bias is
// there before.
void ControlCycle::Impl::MoveBias(const OperatorInput& op,
                                  const supervisor::Decision& decision) noexcept {
  if (bias.empty()) return;
  constexpr double kAtSpeed = 0.005;  // of the rated speed
  const double asked_rad_per_s = decision.drive_enabled ? decision.speed_set_point_rad_per_s : 0.0;
  const double apart = std::abs(decision.believed_speed_rad_per_s - asked_rad_per_s);
  bias.Step({.levitated = supervisor::Row(decision.state).excitation,
             .speed_changes = !(apart <= kAtSpeed * rig.max_speed_rad_per_s),
             .excited = op.excitation_a != AxisArray{} || op.excitation_m != AxisArray{},
             .position_m = seen.position_m,
             .reference_m = decision.reference_m,
             .saturated_axes = seen.saturated_axes},
            law_current_a);
}

// What leaves is a number within the limit, whatever the law's states have come to. Else nothing
// leaves: the rig is released in this very cycle. (A lift starts the law from rest.)
void ControlCycle::Impl::CheckLaw() noexcept {
  for (std::size_t i = 0; i < rig.axes(); ++i) {
    if (std::abs(given.control_current_a[i]) <= limit_a) continue;  // false for what is no number
    given = {};
    supervisor.Drop(seen, {Fault::kLawNotFinite, static_cast<std::int8_t>(i), 0.0, limit_a});
    return;
  }
}

CycleOutputs ControlCycle::Impl::Outputs(const supervisor::Decision& decision) const noexcept {
  const supervisor::StateRow& row = supervisor::Row(decision.state);
  CycleOutputs out;
  out.current.cycle = frame_cycle;
  out.current.axes = static_cast<std::uint32_t>(rig.axes());
  out.current.control_current_a = probes.Currents({given.control_current_a}).at;
  out.current.bias_current_a = row.energised ? bias.current_a() : 0.0;
  out.current.speed_set_point_rad_per_s = decision.speed_set_point_rad_per_s;
  out.current.acceleration_limit_rad_per_s2 = decision.acceleration_rad_per_s2;
  out.current.amplifiers_enabled = row.energised;
  out.current.drive_enabled = decision.drive_enabled;
  out.reference_m = decision.reference_m;
  out.saturated_axes = given.saturated_axes;
  out.mode = row.mode;
  out.fault = decision.latch.finding.fault;
  out.fault_axis = decision.latch.finding.axis;
  out.fault_value = decision.latch.finding.value;
  out.fault_limit = decision.latch.finding.limit;
  out.command_refused = decision.command_refused;
  if (file) out.acting_law = static_cast<std::uint8_t>(file->stretch());
  out.synchronous_blocks = static_cast<std::uint8_t>(synchronous.blocks());
  for (std::size_t k = 0; k < synchronous.blocks(); ++k) out.synchronous[k] = synchronous.status(k);
  return out;
}

ControlCycle::ControlCycle(const CycleConfig& config)
    : impl_(std::make_unique<Impl>(config, nullptr)) {}
ControlCycle::ControlCycle(const CycleConfig& config, std::unique_ptr<law::OwnLaw> own)
    : impl_(std::make_unique<Impl>(config, Given(std::move(own)))) {}
ControlCycle::~ControlCycle() = default;
ControlCycle::ControlCycle(ControlCycle&&) noexcept = default;
ControlCycle& ControlCycle::operator=(ControlCycle&&) noexcept = default;

const supervisor::Decision& ControlCycle::decision() const noexcept {
  return impl_->supervisor.decision();
}

CycleOutputs ControlCycle::Step(const CycleInputs& in, StageObserver* observer) noexcept {
  const auto ended = [observer](Stage stage) {
    if (observer != nullptr) observer->Ended(stage);
  };
  const supervisor::Request request{in.op.command, in.op.speed_rad_per_s,
                                    in.op.acceleration_rad_per_s2};
  impl_->Read(in);
  const supervisor::Finding finding = impl_->supervisor.Check(impl_->seen, request);
  ended(Stage::kCheck);
  const supervisor::Decision& decision = impl_->supervisor.Decide(impl_->seen, request, finding);
  ended(Stage::kSupervise);
  impl_->RunLaw(in.op, decision);
  impl_->CheckLaw();
  const CycleOutputs out = impl_->Outputs(decision);
  ended(Stage::kLaw);
  return out;
}

}  // namespace levitas::cycle
