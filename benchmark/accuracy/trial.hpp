#pragma once
// One Monte-Carlo trial of the diagnosis: a rig with a hidden effect, its measured data, and the
// ground truth, kept apart from them.
//
// Seed       decides everything: deviations of the rig, effects, sizes, places, speed, controller,
//            noise. An effect under which the rig does not stay levitated is drawn smaller.
// Lost       frames of `dropped_samples` never come to the controller (campaign.hpp, FrameLoss).
// Thread     any; two inside.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "benchmark/accuracy/campaign.hpp"
#include "benchmark/accuracy/hidden_effect.hpp"
#include "benchmark/accuracy/rig_trials.hpp"
#include "configuration/rig_file.hpp"
#include "controller/cycle/control_cycle.hpp"

namespace levitas::accuracy {

/// The rig under trial: nominal description and the controllers it may be levitated with.
struct TestRig {
  configuration::RigFile rig;
  std::vector<configuration::ControllerFile> controllers;
  RigTrials trials;

  /// What `amb run` makes of the rig file and this controller.
  [[nodiscard]] cycle::CycleConfig Cycle(std::size_t controller) const;
};

struct TrialPlan {
  std::uint64_t seed{};
  std::vector<effect::Id> hidden;  ///< the first is the main one
  double size{1.0};                ///< of the main effect; 1 = what DrawEffect calls clear
  double side_size{1.0};           ///< of the others
  Unmodelled outside{Unmodelled::kNothing};
  bool in_file{};           ///< the diagnosis is given a rig file that holds the effects
  int bits_per_axis{2047};  ///< length of the test signal
  double runup_s{2.0};
};

/// Sizes by the evidence for the effect in the records [nat]: from 25, from 10, from 5 (decisive),
/// and effects that records of this length cannot show.
enum class Size : std::uint8_t { kBelow, kFaint, kModerate, kClear };
[[nodiscard]] Size SizeOf(double available_nat) noexcept;
/// By what was drawn, where the evidence is not known: 1 is clear, 0.5 moderate, 0.25 faint.
/// Nothing is drawn to be below all.
[[nodiscard]] Size SizeDrawn(double drawn) noexcept;
[[nodiscard]] const char* Name(Size size) noexcept;

/// Ground truth. Never handed to the diagnosis.
struct GroundTruth {
  std::vector<effect::Id> effects;  ///< none when the rig file holds them
  std::vector<effect::Id> in_file;
  Unmodelled outside{Unmodelled::kNothing};
  plant::PlantParameters truth;
  std::vector<effect::EffectConfig> hidden;  ///< as drawn; part of `truth`
  double size{};                             ///< after making it smaller for stability
};

struct Trial {
  configuration::RigFile rig;  ///< nominal, what the diagnosis is given
  std::vector<diagnosis::Record> records;
  GroundTruth ground_truth;
};

/// Nothing when the rig does not levitate, whatever is drawn anew.
[[nodiscard]] std::optional<Trial> TryTrial(const TestRig& bench, const TrialPlan& plan);

/// The same; BadInput when it does not levitate.
[[nodiscard]] Trial MakeTrial(const TestRig& bench, const TrialPlan& plan);

/// Loads a rig and these controllers; without any, the one that the rig file names.
[[nodiscard]] TestRig LoadTestRig(const std::string& rig,
                                  const std::vector<std::string>& controllers);

}  // namespace levitas::accuracy
