#pragma once
// Causes judged by what they are worth on validation data of the user.
//
// Why        evidence on the fitted records prefers the form that has most freedom there: at one
//            speed a run-out of every probe and order imitates any force bound to the rotation, to
//            the last nat. Only another speed tells them apart.
// Adapted    what the fitted records leave undetermined (unbalance against run-out at one speed)
//            may make any forecast wrong by more than a cause is worth. So each set first adapts
//            its numbers to the validation data within what the fitted ones leave of them, at the
//            price of that prior; what it still gets wrong counts.
//            Gauss-Newton steps with Marquardt's damping, the first of them with a
//            whitening filter of the innovations at each step, as Refiner::Approach does.
// Contender  a set of causes whose evidence comes within `form_share` of the leader's: no force law
//            of the vocabulary is more exact than that.
// Chosen     the contender that foretells the validation data better than the leader, in squared
//            whitened innovations, by more than `gain_deviations` of the scatter of the difference
//            from block to block; of several the best.
// Worth      the gain of the chosen set over the calibrated model in which the numbers that the
//            causes stand for are those of the rig file: a fault that calibration had absorbed is
//            worth what calibration gained by it.
// Refuted    a set that loses there by more than `gain_deviations` of the scatter: it is suspected,
//            not named. So is one that they leave open, though they could show it
//            (validation_doubt.hpp), unless it foretells them better as it was fitted: a wrong
//            calibration can adapt to much. Data that cannot (no test signal, for a delay) neither
//            confirm nor refute it.
// Without    validation data of the user contenders are ties (ranking.hpp), and nothing is doubted.
// Thread     Choose: any; pure. The rest blocks the caller, every processor inside.

#include <optional>
#include <vector>

#include "diagnosis/inference/fit_gain.hpp"

namespace levitas::diagnosis {

/// Which contender replaces the leader, from their gains over it; none: the leader stays.
[[nodiscard]] std::optional<std::size_t> Choose(const std::vector<FitGain>& over_leader,
                                                double deviations);

/// What the fitted records say for causes, and among how many effects they were looked for.
struct FittedEvidence {
  double nat{};
  std::size_t effects{};
};

/// Says in `found.doubt`, with the probability, whether `worth`, the gain of the causes on
/// validation data, refutes them or leaves them open. Nothing without causes.
void DoubtBy(const FitGain& worth, const FittedEvidence& fitted, const Judging& judging,
             CauseSelection& found);

/// Exchanges the leader for a contender that foretells the user's `validation` data better, and
/// says in `found.doubt` when the causes are refuted there. Nothing without such data.
void JudgeOnValidation(RecordLandscape& landscape, const std::vector<Record>& validation,
                       const Judging& judging, CauseSelection& found);

}  // namespace levitas::diagnosis
