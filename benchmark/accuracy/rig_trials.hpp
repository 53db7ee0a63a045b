#pragma once
// Trial settings of one rig: hidden effects, their sizes, excitation, and deviations of a healthy
// rig.
//
// Sizes     DrawEffect's are those of the flexible rotor; here stand the factors on them that make
//           an effect clear on another rig (25 nat and more in its records).
// Thread    any; pure.

#include <vector>

#include "benchmark/accuracy/campaign.hpp"
#include "benchmark/accuracy/perturbed_rig.hpp"
#include "configuration/rig_file.hpp"

namespace levitas::accuracy {

struct SizeOnRig {
  effect::Id id;
  double factor;
};

struct RigTrials {
  std::vector<SizeOnRig> effects;  ///< that are hidden, in turn
  CampaignPlan campaign;
  double spinning_from_rpm{2400.0}, spinning_to_rpm{3600.0};  ///< drawn between
  double runup_share{1.0};                                    ///< of a trial's usual length
  Mismatch mismatch;

  /// Factor on DrawEffect's size; 1 for an effect that is not in the list.
  [[nodiscard]] double Factor(effect::Id id) const noexcept;
};

/// By the name of the rig; those of the flexible rotor for a rig that has none of its own.
[[nodiscard]] RigTrials TrialsOf(const configuration::RigFile& rig);

}  // namespace levitas::accuracy
