#pragma once
// What a gain on validation data says of causes that the fitted records prefer.
//
// Gain       of the causes over the calibrated model in squared whitened innovations, on data that
//            neither was fitted to, with the standard deviation of the sum from the scatter of its
//            blocks.
// Confirmed  beyond `deviations` of the scatter; refuted: below that on the other side.
// Open       between the two. Two models whose forecasts are D apart, squared, differ by D in the
//            mean where one of them is right, with a scatter of 2 sqrt(D). So data that scatter by
//            less than 8 `deviations` leave what is right unconfirmed in more than one case of 20,
//            as many as `deviations` of 1.645 stand for: they can hardly show the causes (an
//            unbalance at rest), and are no reason to doubt them.
// Thread     any; pure.

#include <cstddef>

#include "diagnosis/inference/verdict.hpp"

namespace levitas::diagnosis {

/// A gain beyond `deviations` of its scatter.
[[nodiscard]] bool Confirms(double gain, double deviation, double deviations) noexcept;

/// kNothing where the gain confirms the causes, or could not. A gain that is no number (the model
/// diverges) refutes them.
[[nodiscard]] Doubt DoubtOf(double gain, double deviation, double deviations) noexcept;

/// That causes are worth something there: of a normal distribution about the gain; 0 where the gain
/// is no number. Of causes that the data refute.
[[nodiscard]] double ChanceOfGain(double gain, double deviation) noexcept;

/// Of causes that the data leave open: the fitted records' evidence stands, the gain is added to
/// it [nat each]. Prior of a healthy rig: 1/effects for each, as in suspicion.hpp.
[[nodiscard]] double ChanceOfOpen(double fitted_nat, double gain_nat, std::size_t effects) noexcept;

}  // namespace levitas::diagnosis
