#pragma once
// How well a model predicts records it may not have seen, and what an extension gains.
//
// Fit        100 (1 - |y - prediction|/|y - mean|) of the one-step prediction with the slow
//            observer, mean over channels.
// Ceiling    the fit whose innovations are the sensors' noise alone.
// Gain       share of what the nominal model leaves and the ceiling would not, in squared
//            innovations: (nominal - extended)/(nominal - ceiling). A fit percentage hides a
//            well-proven small effect; this does not.
// To gain    what the nominal model leaves beyond the noise, as a share of the noise: where it is
//            next to nothing, a share of it means nothing.
// Interval   5 to 95 % of a block bootstrap over blocks of 0.05 s (Kuensch 1989), written seed.
// Thread     any.

#include <cstdint>
#include <vector>

#include "diagnosis/model/model_run.hpp"

namespace levitas::diagnosis {

/// A share with its interval.
struct Share {
  double value{}, low{}, high{};
};

struct Gain {
  double nominal_percent{}, calibrated_percent{}, extended_percent{}, ceiling_percent{};
  Share achieved;            ///< of the achievable, nominal to extended
  Share beyond_calibration;  ///< of what the calibrated model leaves, gained by the causes
  Share to_gain;             ///< squared innovations of the nominal model over the noise's, minus 1
  double calibrated_over_noise{}, extended_over_noise{};  ///< squared innovations
  std::vector<double> channel_nominal_percent, channel_extended_percent;
  std::vector<Share> channel;  ///< of the achievable, nominal to extended
};

/// Below it a share of the achievable gain means nothing: chance alone makes this much.
inline constexpr double kLeastToGain = 0.02;
[[nodiscard]] inline bool SomethingToGain(const Gain& gain) {
  return gain.to_gain.low > kLeastToGain;
}

/// Three models on the same records.
struct ModelRuns {
  std::vector<Trajectory> nominal, calibrated, extended;
};

/// Which samples are measured on.
enum class Part : std::uint8_t { kFitted, kValidation };

/// `noise_rms_m` per axis.
[[nodiscard]] Gain MeasureGain(const RigView& rig, const ModelRuns& runs,
                               const std::vector<double>& noise_rms_m, Part part);

}  // namespace levitas::diagnosis
