#include "plant_sim/plant/plant.hpp"

#include <algorithm>
#include <cmath>

#include "plant_sim/plant/applied_effects/effect_forces.hpp"
#include "plant_sim/plant/applied_effects/effect_signals.hpp"
#include "plant_sim/plant/plant_impl.hpp"
#include "plant_sim/plant/rest.hpp"

namespace levitas::plant {

Plant::Plant(const PlantConfig& config, std::uint64_t seed)
    : Plant(std::make_shared<const PlantModel>(config), seed) {}
Plant::Plant(std::shared_ptr<const PlantModel> model, std::uint64_t seed)
    : impl_(std::make_unique<Impl>(std::move(model), seed)) {}
Plant::Plant(const Plant& other) : impl_(std::make_unique<Impl>(*other.impl_)) {
  impl_->Separate();
}
Plant& Plant::operator=(const Plant& other) {
  if (this == &other) return *this;
  *impl_ = *other.impl_;
  impl_->Separate();
  return *this;
}
Plant::Plant(Plant&&) noexcept = default;
Plant& Plant::operator=(Plant&&) noexcept = default;
Plant::~Plant() = default;

SensorFrame Plant::Sample() noexcept {
  Impl& self = *impl_;
  const PlantModel& model = *self.model;
  SensorFrame frame;
  frame.cycle = self.cycle;
  frame.sample_time_ns = static_cast<std::int64_t>(self.cycle) * model.config().period_ns;
  frame.axes = static_cast<std::uint32_t>(model.channels());
  if (!self.LatestActing().enabled) frame.rig_status |= kRigAmplifiersOff;
  AxisArray output_m = self.Outputs();
  if (model.effects().jitter_s > 0.0) self.Jitter(output_m);
  BearingFrame read_m;
  for (std::size_t axis = 0; axis < model.channels(); ++axis) {
    read_m.at[axis] = self.Read(axis, output_m[axis]);
  }
  frame.position_m = self.probes.Readings(read_m).at;
  frame.speed_rad_per_s = self.rotation.speed_rad_per_s;
  frame.angle_rad = self.rotation.angle_rad;
  return frame;
}

AxisArray Plant::SensorOutput() const noexcept {
  return impl_->probes.Readings({impl_->Outputs()}).at;
}

void Plant::Advance(const PlantCommand& command) noexcept {
  Impl& self = *impl_;
  if (self.scheduled) self.FollowSchedule();
  self.Enqueue(command);
  self.report.contact_n = 0.0;
  // Command n - whole - 1 acts until the fraction of the period has passed, then n - whole.
  self.Integrate(self.model->steps()[0], self.Acting(0), command);
  self.Integrate(self.model->steps()[1], self.Acting(1), command);
  ++self.cycle;
}

void Plant::PlaceAtRest(const AxisArray& actuator_position_m) noexcept {
  Impl& self = *impl_;
  std::fill(self.state.begin(), self.state.end(), 0.0);
  PlaceRigidly(*self.model, actuator_position_m, self.state);
  self.Energise(true);
  self.SettleMemory();
  self.SettleSensors();
}

void Plant::RestInTouchdown() noexcept {
  Impl& self = *impl_;
  std::fill(self.state.begin(), self.state.end(), 0.0);
  PlaceInTouchdown(*self.model, self.state);
  self.Energise(false);
  self.SettleMemory();
  self.SettleSensors();
}

void Plant::SetSpeed(double speed_rad_per_s, double angle_rad) noexcept {
  impl_->rotation = {speed_rad_per_s, Wrapped(angle_rad), 0.0};
  impl_->heading = MakeHeading(impl_->rotation);
  Follow(impl_->model->train(), impl_->rotation, impl_->pose);
}

const StateLayout& Plant::layout() const noexcept { return impl_->model->layout(); }
std::span<const double> Plant::state() const noexcept { return impl_->state; }
std::span<double> Plant::mutable_state() noexcept { return impl_->state; }
double Plant::speed_rad_per_s() const noexcept { return impl_->rotation.speed_rad_per_s; }
double Plant::angle_rad() const noexcept { return impl_->rotation.angle_rad; }
std::uint64_t Plant::cycle() const noexcept { return impl_->cycle; }
double Plant::ContactForce() const noexcept { return impl_->report.contact_n; }
const PlantModel& Plant::model() const noexcept { return *impl_->model; }
const std::shared_ptr<const PlantModel>& Plant::shared_model() const noexcept {
  return impl_->model;
}

bool Plant::finite() const noexcept {
  return std::all_of(impl_->state.begin(), impl_->state.end(),
                     [](double value) { return std::isfinite(value); });
}

AxisArray Plant::ActuatorPosition() const noexcept {
  AxisArray position_m{};
  for (std::size_t b = 0; b < impl_->model->bearings().size(); ++b) {
    AtPlanes(*impl_->model, impl_->model->bearings()[b].actuator_shape, impl_->state.data(),
             position_m[2 * b], position_m[2 * b + 1]);
  }
  if (impl_->model->effects().housings) {
    Housings housings;
    impl_->LoadHousings(housings);
    for (std::size_t axis = 0; axis < impl_->model->axes(); ++axis) {
      position_m[axis] -= housings.position_m[axis];
    }
  }
  return position_m;
}

AxisArray Plant::MagnetForce() const noexcept {
  const AxisArray position_m = ActuatorPosition();
  const PlantModel& model = *impl_->model;
  const EffectModel& effects = model.effects();
  Currents now = impl_->CurrentsNow();
  if (effects.memory) {
    now.control_a = Magnetising(effects, {now.control_a, SeenByMagnets(effects, position_m)},
                                impl_->state.data());
  }
  AxisArray force_n{};
  for (std::size_t axis = 0; axis < model.axes(); axis += 2) {
    const BearingModel& bearing = model.bearings()[axis / 2];
    if (effects.magnets) {
      const PlaneForce force = MagnetWithEffects(bearing, effects.bearings[axis / 2], now, axis,
                                                 position_m[axis], position_m[axis + 1]);
      force_n[axis] = force.x_n;
      force_n[axis + 1] = force.y_n;
      continue;
    }
    for (const std::size_t a : {axis, axis + 1}) {
      force_n[a] = magnet::Force(bearing.magnet, now.bias_a[a], now.control_a[a], position_m[a]);
    }
  }
  return force_n;
}

void Plant::AllowEffectChanges() { impl_->AllowChanges(); }

bool Plant::SetEffectStrength(std::size_t index, double strength) noexcept {
  Impl& self = *impl_;
  if (!self.own || index >= self.strengths.size() || !(strength >= 0.0 && strength <= 1.0)) {
    return false;
  }
  self.follows_schedule[index] = false;
  if (strength == self.strengths[index]) return true;
  self.strengths[index] = strength;
  self.own->SetStrengths(self.strengths);
  return true;
}

void Plant::AllowTorques() { impl_->outside.assign(impl_->model->train().twists, 0.0); }

bool Plant::SetTorque(std::size_t index, double torque_n_m) noexcept {
  Impl& self = *impl_;
  const std::vector<TwistInertia>& inertias = self.model->train().inertias;
  if (self.outside.empty() || index >= inertias.size() || !std::isfinite(torque_n_m)) return false;
  self.torque_n_m[index] = torque_n_m;
  std::fill(self.outside.begin(), self.outside.end(), 0.0);
  for (std::size_t k = 0; k < inertias.size(); ++k) {
    for (std::size_t i = 0; i < self.outside.size(); ++i) {
      self.outside[i] += inertias[k].twist[i] * self.torque_n_m[k];
    }
  }
  return true;
}

}  // namespace levitas::plant
