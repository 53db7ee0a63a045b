#pragma once
// The inside of a Plant: its state and one period of it. Private to plant.cpp and plant_impl.cpp;
// what it means is said in plant.hpp.
// Thread     that of the plant. After construction nothing here allocates but AllowChanges and
//            Separate.

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "common/probe_map.hpp"
#include "common/random.hpp"
#include "plant_sim/effect/strength.hpp"
#include "plant_sim/plant/plant.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "plant_sim/plant/time_step.hpp"

namespace levitas::plant {

/// What the amplifiers are asked for, limits already applied.
struct CoilCommand {
  std::array<amplifier::CoilPair, kMaxAxes> coils{};
  bool enabled{};
};

// Chance of the effects (jitter, losses) comes from a generator of its own: switching one on leaves
// the sensors' noise as it was.
inline constexpr std::uint64_t kEffectSeed = 0x6566666563747321ULL;

inline std::size_t MostWhole(double delay_samples) {
  return static_cast<std::size_t>(std::ceil(delay_samples));
}

struct Plant::Impl {
  Impl(std::shared_ptr<const PlantModel> shared, std::uint64_t seed)
      : model(std::move(shared)),
        probes(model->config().sensor_polarity, model->config().actuator_polarity, model->axes()),
        state(model->layout().size, 0.0),
        work(*model),
        random(seed),
        chance(seed ^ kEffectSeed),
        queue(MostWhole(model->most_delay_samples()) + 2) {
    for (const effect::EffectConfig& entry : model->config().effects) {
      strengths.push_back(effect::StrengthAt(entry, 0.0));
      scheduled = scheduled || entry.timed();
    }
    follows_schedule.assign(strengths.size(), true);
    if (scheduled) AllowChanges();
    Energise(true);
    Follow(model->train(), rotation, pose);
    torque_n_m.assign(model->train().inertias.size(), 0.0);
  }

  Impl(const Impl& other) = default;
  Impl& operator=(const Impl& other) = default;

  // A model of this plant alone, so that a strength can change without touching other plants.
  void AllowChanges();

  // After copying: the copy must not share the model that its original changes.
  void Separate();

  void FollowSchedule() noexcept;

  [[nodiscard]] double PeriodSeconds() const noexcept {
    return static_cast<double>(model->config().period_ns) * 1e-9;
  }

  // Coils settled at their design bias, or without current; the delay line holds the same.
  void Energise(bool on) noexcept;

  [[nodiscard]] CoilCommand Limited(const PlantCommand& command) const noexcept;

  // Newest command last. A frame that was lost brings none: the last one is held.
  void Enqueue(const PlantCommand& command) noexcept {
    std::move(queue.begin() + 1, queue.end(), queue.begin());
    if (!FrameLost()) queue.back() = Limited(command);
  }

  // The command that acts before (0) and after (1) the delayed change within a period.
  [[nodiscard]] const CoilCommand& Acting(std::size_t part) const noexcept {
    return queue[queue.size() - 2 - model->whole_delay() + part];
  }

  // The command that acted until the present instant.
  [[nodiscard]] const CoilCommand& LatestActing() const noexcept {
    return queue[queue.size() - 1 - model->whole_delay()];
  }

  [[nodiscard]] bool FrameLost() noexcept;

  void Rotate(const PlantCommand& command, double duration_s) noexcept;

  [[nodiscard]] AxisArray SensorPositions() const noexcept;

  // Filters of all axes over one substep, in which the displacement runs linearly.
  void FollowDisplacements(const StepTable& table, const AxisArray& seen_m,
                           const AxisArray& now_m) noexcept;

  void FollowCurrents(const StepTable& table, const CoilCommand& command) noexcept;

  // A coil on a voltage: each by its own inductance, which the gap decides.
  void FollowVoltage(std::size_t axis, double duration_s, const CoilCommand& command,
                     double& control_a) noexcept;

  [[nodiscard]] Currents CurrentsNow() const noexcept;

  void Integrate(const StepTable& table, const CoilCommand& coils,
                 const PlantCommand& command) noexcept;

  // Displacement in the axes of the magnets, after an even motion of `ahead_s`.
  [[nodiscard]] AxisArray PositionInMagnets(double ahead_s) const noexcept;

  // From the currents in the coils to those that make flux, at both ends of a substep.
  void Remember(const StepTable& table, Currents& start, Currents& end) noexcept;

  void LoadHousings(Housings& housings) const noexcept;

  void StoreHousings(const Housings& housings) noexcept;

  // Eddy currents and sensor filters that have seen the present place for long.
  void SettleMemory() noexcept;
  void SettleSensors() noexcept;

  // Sensor outputs without noise, polarity not yet applied.
  [[nodiscard]] AxisArray Outputs() const noexcept;

  // The converter of an axis; its noise is that of the effects, if any.
  [[nodiscard]] double Read(std::size_t axis, double output_m) noexcept;

  // A sample taken `late_s` after its instant: s' = 2 pi f (g p - s).
  void Jitter(AxisArray& output_m) noexcept;

  std::shared_ptr<const PlantModel> model;
  ProbeMap probes;
  std::shared_ptr<PlantModel> own;  ///< the same, when it may change
  std::vector<double> strengths;    ///< of the effects, now
  std::vector<bool> follows_schedule;
  bool scheduled{};
  std::vector<double> state;
  AxisArray bias_a{};
  Rotation rotation;
  Heading heading;
  TrainPose pose;                  ///< of geared shafts
  std::vector<double> torque_n_m;  ///< from outside, on each inertia of the train
  std::vector<double> outside;     ///< what they are to the torsional modes; empty: no torque yet
  Workspace work;
  Random random;
  Random chance;
  int burst_left{};
  AxisArray colour{};
  std::vector<CoilCommand> queue;
  ForceReport report;
  std::uint64_t cycle{0};
};

}  // namespace levitas::plant
