#include "benchmark/accuracy/trial.hpp"

#include <algorithm>
#include <utility>

#include "benchmark/accuracy/hidden_gear_effect.hpp"
#include "benchmark/accuracy/perturbed_rig.hpp"
#include "common/problem.hpp"
#include "plant_sim/effect/catalogue.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::accuracy {
namespace {

using effect::Id;

constexpr int kOtherRig = 4;  ///< attempts
constexpr int kMostRigs = 8;  ///< drawn for one that is lifted without a hidden effect

class Maker {
 public:
  Maker(const TestRig& bench, const TrialPlan& plan)
      : bench_(bench), plan_(plan), nominal_(plant::Reduce(bench.rig.plant)), random_(plan.seed) {
    campaign_ = bench.trials.campaign;
    campaign_.seed = random_.Bits();
    campaign_.bits_per_axis = plan.bits_per_axis;
    const RigTrials& on = bench.trials;
    campaign_.runup_s = plan.runup_s * on.runup_share;
    campaign_.spinning_rpm =
        on.spinning_from_rpm + (on.spinning_to_rpm - on.spinning_from_rpm) * random_.Uniform();
    rig_seed_ = random_.Bits();
    effect_seed_ = random_.Bits();
    controller_ = random_.Bits() % bench.controllers.size();
  }

  /// Nothing when the rig does not levitate.
  std::optional<Trial> Make() {
    Trial trial;
    double size = plan_.size;
    Campaign campaign;
    if (!FindRig()) return std::nullopt;
    for (int attempt = 0; attempt < 8; ++attempt, size *= 0.6) {
      // A loop of little margin may not hold every rig that is off by its tolerances: another one.
      // Nor do they hold evidence for every hidden effect besides the main one.
      if (attempt >= kOtherRig) {
        rig_seed_ = random_.Bits();
        if (!FindRig()) return std::nullopt;
        beside_ *= 0.6;
      }
      trial.ground_truth.size = size;
      if (Run(size, campaign, trial.ground_truth)) break;
    }
    if (!campaign.stable) return std::nullopt;
    trial.records = std::move(campaign.records);
    trial.ground_truth.outside = plan_.outside;
    trial.rig = bench_.rig;
    if (plan_.in_file) {
      trial.rig.plant.effects = Draw(trial.ground_truth.size);
      for (const auto& entry : trial.rig.plant.effects) {
        trial.ground_truth.in_file.push_back(entry.id);
      }
      return trial;
    }
    trial.ground_truth.effects = plan_.hidden;
    return trial;
  }

 private:
  [[nodiscard]] std::vector<effect::EffectConfig> Draw(double size) {
    Random random(effect_seed_);
    std::vector<effect::EffectConfig> entries;
    for (std::size_t i = 0; i < plan_.hidden.size(); ++i) {
      const double share = bench_.trials.Factor(plan_.hidden[i]);
      const double drawn_size = share * (i == 0 ? size : beside_);
      const bool of_teeth =
          effect::At(plan_.hidden[i]).place == effect::Place::kGear ||
          (plan_.hidden[i] == Id::kMisalignment && !nominal_.config.gears.empty());
      const auto drawn = of_teeth ? DrawGearEffect(plan_.hidden[i], drawn_size, nominal_, random)
                                  : DrawEffect(plan_.hidden[i], drawn_size, nominal_, random);
      entries.insert(entries.end(), drawn.begin(), drawn.end());
    }
    return entries;
  }

  [[nodiscard]] plant::PlantParameters RigWith(
      const std::vector<effect::EffectConfig>& hidden) const {
    Random random(rig_seed_);
    return PerturbedRig(bench_.rig.plant, bench_.trials.mismatch, hidden, random);
  }

  /// One that is not lifted for what it is off by would be none that `amb run` records, and a
  /// smaller effect would not help. (A law without an integrator hangs beside the centre.)
  bool FindRig() {
    for (int i = 0; i < kMostRigs; ++i) {
      if (Lifts(RigWith({}), bench_.Cycle(controller_), campaign_.seed)) return true;
      rig_seed_ = random_.Bits();
    }
    return false;
  }

  bool Run(double size, Campaign& out, GroundTruth& ground_truth) {
    auto hidden = Draw(size);
    ground_truth.hidden = hidden;
    CampaignPlan plan = campaign_;
    for (const auto& entry : hidden) {
      if (entry.id != Id::kDroppedSamples) continue;
      plan.loss = {entry.values[0], static_cast<std::size_t>(entry.values[1]),
                   effect_seed_ % 2 == 0, effect_seed_ + 1};
    }
    // Frames are lost on the way to the controller; the plant loses none besides, of which no
    // record would know.
    std::erase_if(hidden, [](const auto& entry) { return entry.id == Id::kDroppedSamples; });
    const auto truth = RigWith(hidden);
    out = Record(truth, bench_.Cycle(controller_), plan, plan_.outside, size, effect_seed_);
    ground_truth.truth = truth;
    return out.stable;
  }

  const TestRig& bench_;
  const TrialPlan& plan_;
  plant::PlantParameters nominal_;
  Random random_;
  CampaignPlan campaign_;
  std::uint64_t rig_seed_{}, effect_seed_{};
  std::size_t controller_{};
  double beside_{plan_.side_size};
};

}  // namespace

cycle::CycleConfig TestRig::Cycle(std::size_t controller) const {
  const configuration::ControllerFile& file = controllers.at(controller);
  return {rig.numbers, file.law, file.supervisor, file.synchronous, file.bias};
}

Size SizeOf(double available_nat) noexcept {
  if (available_nat >= 25.0) return Size::kClear;
  if (available_nat >= 10.0) return Size::kModerate;
  return available_nat >= 5.0 ? Size::kFaint : Size::kBelow;
}

Size SizeDrawn(double drawn) noexcept {
  // Half way, in ratio, between the sizes that a bench draws.
  constexpr double kToClear = 0.707;
  constexpr double kToModerate = 0.354;
  if (drawn >= kToClear) return Size::kClear;
  return drawn >= kToModerate ? Size::kModerate : Size::kFaint;
}

const char* Name(Size size) noexcept {
  switch (size) {
    case Size::kClear:
      return "clear";
    case Size::kModerate:
      return "moderate";
    case Size::kFaint:
      return "faint";
    case Size::kBelow:
      break;
  }
  return "below";
}

std::optional<Trial> TryTrial(const TestRig& bench, const TrialPlan& plan) {
  return Maker(bench, plan).Make();
}

Trial MakeTrial(const TestRig& bench, const TrialPlan& plan) {
  std::optional<Trial> trial = TryTrial(bench, plan);
  if (!trial) throw BadInput("the rig under trial does not levitate");
  return *std::move(trial);
}

TestRig LoadTestRig(const std::string& rig, const std::vector<std::string>& controllers) {
  TestRig bench{configuration::LoadRig(configuration::FindConfig(rig, "rigs")), {}, {}};
  bench.trials = TrialsOf(bench.rig);
  std::vector<std::string> names = controllers;
  if (names.empty()) names.push_back(bench.rig.run.controller);
  for (const std::string& name : names) {
    bench.controllers.push_back(configuration::LoadController(
        configuration::FindConfig(name, "controllers"), bench.rig.numbers));
  }
  return bench;
}

}  // namespace levitas::accuracy
