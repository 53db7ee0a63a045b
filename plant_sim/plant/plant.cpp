#include "plant_sim/plant/plant.hpp"

#include <algorithm>
#include <cmath>

#include "common/random.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "plant_sim/plant/rest.hpp"
#include "plant_sim/plant/time_step.hpp"

namespace levitas::plant {
namespace {

/// What the amplifiers are asked for, limits already applied.
struct CoilCommand {
  std::array<amplifier::CoilPair, kMaxAxes> coils{};
  bool enabled{};
};

}  // namespace

struct Plant::Impl {
  Impl(std::shared_ptr<const PlantModel> shared, std::uint64_t seed)
      : model(std::move(shared)),
        state(model->layout().size, 0.0),
        work(*model),
        random(seed),
        queue(model->whole_delay() + 2) {
    Energise(true);
    Follow(model->train(), rotation, pose);
  }

  // Coils settled at their design bias, or without current; the delay line holds the same.
  void Energise(bool on) noexcept {
    CoilCommand command;
    command.enabled = on;
    bias_a = {};
    std::size_t axis = 0;
    for (const auto& bearing : model->config().bearings) {
      for (int i = 0; on && i < 2; ++i) {
        bias_a[axis + static_cast<std::size_t>(i)] = bearing.magnet.bias_current_a;
        command.coils[axis + static_cast<std::size_t>(i)] = {0.0, bearing.magnet.bias_current_a};
      }
      axis += 2;
    }
    std::fill(queue.begin(), queue.end(), command);
    std::fill_n(state.begin() + static_cast<std::ptrdiff_t>(model->layout().coil_current),
                model->axes(), 0.0);
  }

  [[nodiscard]] CoilCommand Limited(const PlantCommand& command) const noexcept {
    CoilCommand limited;
    limited.enabled = command.amplifiers_enabled;
    const auto& polarity = model->config().actuator_polarity;
    for (std::size_t axis = 0; axis < model->axes(); ++axis) {
      limited.coils[axis] = amplifier::LimitedCommand(
          model->bearings()[axis / 2].amplifier, command.amplifiers_enabled,
          polarity[axis] * command.control_current_a[axis], command.bias_current_a);
    }
    return limited;
  }

  // Newest command last; queue[0] is the one that is `whole_delay + 1` periods old.
  void Enqueue(const PlantCommand& command) noexcept {
    std::move(queue.begin() + 1, queue.end(), queue.begin());
    queue.back() = Limited(command);
  }

  void Rotate(const PlantCommand& command, double duration_s) noexcept {
    const DriveConfig& drive = model->config().drive;
    if (command.drive_enabled) {
      Drive(rotation, command.speed_set_point_rad_per_s,
            std::min(command.acceleration_limit_rad_per_s2, drive.max_acceleration_rad_per_s2),
            duration_s);
    } else {
      Coast(rotation, drive, duration_s);
    }
  }

  [[nodiscard]] AxisArray SensorPositions() const noexcept {
    AxisArray seen_m{};
    for (std::size_t b = 0; b < model->bearings().size(); ++b) {
      AtPlanes(*model, model->bearings()[b].sensor_shape, state.data(), seen_m[2 * b],
               seen_m[2 * b + 1]);
    }
    return seen_m;
  }

  void FollowCurrents(const StepTable& table, const CoilCommand& command) noexcept {
    double* control = state.data() + model->layout().coil_current;
    for (std::size_t axis = 0; axis < model->axes(); ++axis) {
      amplifier::Follow(table.amplifier[axis / 2], command.coils[axis], control[axis],
                        bias_a[axis]);
    }
  }

  [[nodiscard]] Currents CurrentsNow() const noexcept {
    Currents now{{}, bias_a};
    std::copy_n(state.data() + model->layout().coil_current, model->axes(), now.control_a.data());
    return now;
  }

  void Integrate(const StepTable& table, const CoilCommand& coils,
                 const PlantCommand& command) noexcept {
    const StateLayout& at = model->layout();
    AxisArray seen_m = SensorPositions();
    for (int substep = 0; substep < table.substeps; ++substep) {
      const Currents start = CurrentsNow();
      FollowCurrents(table, coils);
      Rotation before = rotation;
      Rotate(command, table.duration_s);
      before.acceleration_rad_per_s2 = rotation.acceleration_rad_per_s2;
      Spin start_spin = MakeSpin(before, heading);
      if (rotation.angle_rad != before.angle_rad) heading = MakeHeading(rotation);
      Spin end_spin = MakeSpin(rotation, heading);
      TrainPose start_pose;
      if (model->train().shafts > 0) {
        start_pose = pose;
        start_pose.acceleration_rad_per_s2 = rotation.acceleration_rad_per_s2;
        Follow(model->train(), rotation, pose);
        start_spin.train = &start_pose;
        end_spin.train = &pose;
      }
      StepRotor(*model, table, start, CurrentsNow(), start_spin, end_spin, state.data() + at.q_x,
                state.data() + at.v_x, work, report);
      const AxisArray now_m = SensorPositions();
      for (std::size_t a = 0; a < model->axes(); ++a) {
        const sensor::FilterStep& filter = table.sensor[a / 2];
        double& filtered = state[at.sensor + a];
        filtered = filter.decay * filtered + filter.start * seen_m[a] + filter.end * now_m[a];
      }
      seen_m = now_m;
    }
  }

  void SettleSensors() noexcept {
    const AxisArray seen_m = SensorPositions();
    for (std::size_t axis = 0; axis < model->axes(); ++axis) {
      state[model->layout().sensor + axis] =
          model->config().bearings[axis / 2].sensor.gain * seen_m[axis];
    }
  }

  std::shared_ptr<const PlantModel> model;
  std::vector<double> state;
  AxisArray bias_a{};
  Rotation rotation;
  Heading heading;
  TrainPose pose;  ///< of geared shafts
  Workspace work;
  Random random;
  std::vector<CoilCommand> queue;
  ForceReport report;
  std::uint64_t cycle{0};
};

Plant::Plant(const PlantConfig& config, std::uint64_t seed)
    : Plant(std::make_shared<const PlantModel>(config), seed) {}
Plant::Plant(std::shared_ptr<const PlantModel> model, std::uint64_t seed)
    : impl_(std::make_unique<Impl>(std::move(model), seed)) {}
Plant::Plant(const Plant& other) : impl_(std::make_unique<Impl>(*other.impl_)) {}
Plant& Plant::operator=(const Plant& other) {
  if (this != &other) *impl_ = *other.impl_;
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
  frame.axes = static_cast<std::uint32_t>(model.axes());
  // queue[1] is the command that acted until this instant.
  if (!self.queue[1].enabled) frame.rig_status |= kRigAmplifiersOff;
  for (std::size_t axis = 0; axis < model.axes(); ++axis) {
    frame.position_m[axis] =
        model.config().sensor_polarity[axis] *
        sensor::Convert(model.bearings()[axis / 2].converter,
                        self.state[model.layout().sensor + axis], self.random.Normal());
  }
  frame.speed_rad_per_s = self.rotation.speed_rad_per_s;
  frame.angle_rad = self.rotation.angle_rad;
  return frame;
}

AxisArray Plant::SensorOutput() const noexcept {
  AxisArray output{};
  for (std::size_t axis = 0; axis < impl_->model->axes(); ++axis) {
    output[axis] = impl_->model->config().sensor_polarity[axis] *
                   impl_->state[impl_->model->layout().sensor + axis];
  }
  return output;
}

void Plant::Advance(const PlantCommand& command) noexcept {
  Impl& self = *impl_;
  self.Enqueue(command);
  self.report.contact_n = 0.0;
  // Command n - whole - 1 acts until the fraction of the period has passed, then n - whole.
  self.Integrate(self.model->steps()[0], self.queue[0], command);
  self.Integrate(self.model->steps()[1], self.queue[1], command);
  ++self.cycle;
}

void Plant::PlaceAtRest(const AxisArray& actuator_position_m) noexcept {
  Impl& self = *impl_;
  std::fill(self.state.begin(), self.state.end(), 0.0);
  PlaceRigidly(*self.model, actuator_position_m, self.state);
  self.Energise(true);
  self.SettleSensors();
}

void Plant::RestInTouchdown() noexcept {
  Impl& self = *impl_;
  std::fill(self.state.begin(), self.state.end(), 0.0);
  PlaceInTouchdown(*self.model, self.state);
  self.Energise(false);
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
  return position_m;
}

AxisArray Plant::MagnetForce() const noexcept {
  const AxisArray position_m = ActuatorPosition();
  const Currents now = impl_->CurrentsNow();
  AxisArray force_n{};
  for (std::size_t axis = 0; axis < impl_->model->axes(); ++axis) {
    force_n[axis] = magnet::Force(impl_->model->bearings()[axis / 2].magnet, now.bias_a[axis],
                                  now.control_a[axis], position_m[axis]);
  }
  return force_n;
}

}  // namespace levitas::plant
