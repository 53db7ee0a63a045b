#pragma once
// Candidates in order: every effect at its best place, who comes near the first, what is explained.
//
// Thread  any; pure.

#include <string>
#include <vector>

#include "diagnosis/inference/diagnose.hpp"

namespace levitas::diagnosis {

/// Every effect at its best place on top of the base, best first; what would have to be negative
/// is left out.
[[nodiscard]] std::vector<Candidate> Screen(const Evidence& base,
                                            const std::vector<Hypothesis>& hypotheses);

/// The same of known gains, one of every hypothesis; what is not finite is left out.
[[nodiscard]] std::vector<Candidate> BestOfEachEffect(const std::vector<Hypothesis>& hypotheses,
                                                      const std::vector<double>& gains);

void SortByScore(std::vector<Candidate>& candidates);

/// Effects that come within `tie_nat` of the first cause, or before it; and those fitted on the
/// nonlinear model that come within `form_share` of its evidence, as no law is more exact. Not
/// those that validation data refute. None for a cause that gains less than `tie_nat`: it is named
/// for where calibration went (moved_calibration.hpp), which no other effect takes back.
[[nodiscard]] std::vector<effect::Id> Ties(const std::vector<Candidate>& candidates,
                                           const std::vector<Hypothesis>& causes, double tie_nat,
                                           double form_share);

/// Share of the excess over the noise, all lines and channels, that the causes take away.
[[nodiscard]] double Explained(const Residual& before, const Residual& after);

/// [nat] what a second model gains over a first one on validation data.
[[nodiscard]] double HeldGain(const std::vector<Trajectory>& first,
                              const std::vector<Trajectory>& second, const Whitener& whitener);

/// Those whose form leaves nothing to be known better: a hum is a sine of a known frequency. What
/// is left beside the others may be their own law, of which form_share of their evidence speaks.
[[nodiscard]] std::vector<Hypothesis> OfExactForm(const std::vector<Hypothesis>& causes);

[[nodiscard]] std::vector<Hypothesis> With(std::vector<Hypothesis> causes, const Hypothesis& cause);
/// All but one.
[[nodiscard]] std::vector<Hypothesis> Without(const std::vector<Hypothesis>& causes,
                                              std::size_t at);

}  // namespace levitas::diagnosis
