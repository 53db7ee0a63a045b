#include "benchmark/gears/quiet_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "benchmark/gears/spinning_rig.hpp"
#include "common/problem.hpp"
#include "common/rotational_speed.hpp"
#include "design/notch/notch_design.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "plant_sim/plant/shaft_loads.hpp"

namespace levitas::gears {
namespace {

constexpr double kSettleS = 4.0;
constexpr double kListenS = 1.0;
constexpr double kWindow = 0.03;  ///< of the speed: blocks act so far beside it
constexpr int kHarmonics = 3;

/// Root of the mean square about the mean, of several signals added up.
class Rms {
 public:
  explicit Rms(std::size_t signals) : sum_(signals, 0.0), square_(signals, 0.0) {}
  void Add(std::size_t signal, double value) {
    sum_[signal] += value;
    square_[signal] += value * value;
  }
  [[nodiscard]] double Of(std::size_t first, std::size_t count, double samples) const {
    double square = 0.0;
    for (std::size_t i = first; i < first + count; ++i) {
      const double mean = sum_[i] / samples;
      square += std::max(0.0, square_[i] / samples - mean * mean);
    }
    return std::sqrt(square);
  }

 private:
  std::vector<double> sum_, square_;
};

/// `step` advances the plant by a period.
Quiet Measure(const configuration::RigFile& rig, const plant::Plant& plant,
              const std::function<void()>& step) {
  const plant::ShaftLoads loads(plant.model());
  const std::size_t axes = rig.numbers.axes();
  const std::size_t shafts = rig.plant.shafts.size();
  Rms displacement(axes);
  Rms housing(2 * shafts);
  Rms torque(loads.twisted().size());
  const long periods = PeriodsOf(rig, kListenS);
  for (long n = 0; n < periods; ++n) {
    step();
    const AxisArray position_m = plant.SensorOutput();
    for (std::size_t i = 0; i < axes; ++i) displacement.Add(i, position_m[i]);
    const auto force = loads.Housing(plant);
    for (std::size_t s = 0; s < shafts; ++s) {
      housing.Add(2 * s, force[s].x);
      housing.Add(2 * s + 1, force[s].y);
    }
    const auto torques = loads.Torques(plant);
    for (std::size_t t = 0; t < torques.size(); ++t) torque.Add(t, torques[t]);
  }
  const auto samples = static_cast<double>(periods);
  Quiet quiet;
  quiet.displacement_m = displacement.Of(0, axes, samples) / std::sqrt(static_cast<double>(axes));
  for (std::size_t s = 0; s < shafts; ++s) quiet.housing_n.push_back(housing.Of(2 * s, 2, samples));
  for (std::size_t t = 0; t < loads.twisted().size(); ++t) {
    quiet.torque_n_m.push_back(torque.Of(t, 1, samples));
  }
  return quiet;
}

Quiet WithoutCurrent(const configuration::RigFile& rig, double speed_rad_per_s) {
  plant::Plant plant(rig.plant, 1);
  plant.SetSpeed(speed_rad_per_s, 0.0);
  plant::PlantCommand command;
  command.drive_enabled = true;
  command.speed_set_point_rad_per_s = speed_rad_per_s;
  command.acceleration_limit_rad_per_s2 = rig.plant.drive.max_acceleration_rad_per_s2;
  const auto step = [&] { plant.Advance(command); };
  for (long n = PeriodsOf(rig, kSettleS); n > 0; --n) step();
  return Measure(rig, plant, step);
}

struct Run {
  Quiet quiet;
  std::vector<bool> acted;  ///< each block, to the end
};

Run WithCycle(const configuration::RigFile& rig, const cycle::CycleConfig& config,
              double speed_rad_per_s) {
  SpinningRig spinning(rig, config);
  spinning.SpinAt(speed_rad_per_s, kSettleS);
  Run run;
  run.quiet = Measure(rig, spinning.plant(), [&] { spinning.Step(); });
  const cycle::CycleOutputs& out = spinning.out();
  for (std::size_t k = 0; k < config.synchronous.blocks.size(); ++k) {
    run.acted.push_back(out.synchronous[k].state == synchronous::BlockState::kActing);
  }
  if (out.fault != Fault::kNone) run.quiet.trouble = Name(out.fault);
  return run;
}

/// Both shafts' own, then the teeth's, in rising order.
std::vector<double> OrdersOf(const configuration::RigFile& rig) {
  const gear::GearPair& pair = rig.plant.gears.front();
  std::vector<double> orders{
      1.0, static_cast<double>(pair.driving.teeth) / static_cast<double>(pair.driven.teeth)};
  for (int k = 1; k <= kHarmonics; ++k) orders.push_back(k * pair.driving.teeth);
  std::ranges::sort(orders);
  orders.erase(std::unique(orders.begin(), orders.end()), orders.end());
  return orders;
}

cycle::CycleConfig With(const configuration::RigFile& rig,
                        const configuration::ControllerFile& controller,
                        const std::vector<double>& orders, synchronous::Target target,
                        double speed_rad_per_s) {
  cycle::CycleConfig config{rig.numbers, controller.law, controller.supervisor, {}};
  for (const double order : orders) {
    design::NotchRequest request;
    request.block.name = "order";
    request.block.order = order;
    request.block.target = target;
    request.block.time_constant_s = 0.3;
    request.block.from_rad_per_s = (1.0 - kWindow) * speed_rad_per_s;
    request.block.to_rad_per_s = (1.0 + kWindow) * speed_rad_per_s;
    request.block.hysteresis_rad_per_s = 0.5 * kWindow * speed_rad_per_s;
    request.block.largest_current_a = std::min(
        rig.numbers.bias_current_a, rig.numbers.max_coil_current_a - rig.numbers.bias_current_a);
    config.synchronous.blocks.push_back(design::WithInverse(rig, controller.law, request));
  }
  return config;
}

Quiet WithBlocks(const configuration::RigFile& rig, const configuration::ControllerFile& controller,
                 synchronous::Target target, double speed_rad_per_s) {
  std::vector<double> orders = OrdersOf(rig);
  while (true) {
    Run run =
        WithCycle(rig, With(rig, controller, orders, target, speed_rad_per_s), speed_rad_per_s);
    run.quiet.orders = orders;
    const bool all = std::ranges::all_of(run.acted, std::identity{});
    if ((all && run.quiet.trouble.empty()) || orders.empty()) return std::move(run.quiet);
    orders.pop_back();
  }
}

}  // namespace

void RefuseWithoutGears(const configuration::RigFile& rig) {
  if (!rig.plant.gears.empty()) return;
  throw BadInput(rig.numbers.name + ": the rig has no gears; see geared_rotor_12dof");
}

QuietMesh Listen(const configuration::RigFile& rig, const configuration::ControllerFile& controller,
                 double speed_rad_per_s) {
  RefuseWithoutGears(rig);
  RefuseBeyondDrive(rig, speed_rad_per_s);
  QuietMesh mesh;
  mesh.speed_rad_per_s = speed_rad_per_s;
  mesh.twisted = plant::ShaftLoads(plant::PlantModel(rig.plant)).twisted();
  mesh.off = WithoutCurrent(rig, speed_rad_per_s);
  mesh.law =
      WithCycle(rig, {rig.numbers, controller.law, controller.supervisor, {}}, speed_rad_per_s)
          .quiet;
  mesh.still = WithBlocks(rig, controller, synchronous::Target::kVibration, speed_rad_per_s);
  mesh.soft = WithBlocks(rig, controller, synchronous::Target::kCurrent, speed_rad_per_s);
  return mesh;
}

double Decibel(double now, double before) { return 20.0 * std::log10(now / before); }

}  // namespace levitas::gears
