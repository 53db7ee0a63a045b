#pragma once
// What is more likely than not, though nothing is decisive.
//
// Evidence   every effect of the vocabulary has the prior 1/N of `nothing is hidden`, N effects:
//            P = sum of e^s/N over the effects within decisive_nat of the leader and with half of
//            its evidence, over 1 + the same sum over all. Suspected above 1/2: one of 34 effects
//            that explains chance as well as 3 nat is not. The leader's s counts what its fit is
//            worth on the validation data of the record, too.
// Number     a calibrated number that the data determine (to half its tolerance) and that lies so
//            many tolerances from the file that chance would bring one of all such numbers there in
//            `chance` of healthy rigs only (normal tolerances, Bonferroni).
// Thread     the first three: any; pure. SuspectCause blocks the caller, every processor inside.

#include <optional>
#include <vector>

#include "diagnosis/inference/record_landscape.hpp"

namespace levitas::diagnosis {

/// Probability from which on a cause is suspected.
inline constexpr double kLikely = 0.5;

/// Probability that the leader, or what the data do not separate from it, is there. `candidates`
/// best first.
[[nodiscard]] double ProbabilityOfLeader(const std::vector<Candidate>& candidates, double tie_nat);

/// Probability that one of `numbers` normal deviates lies further than `deviations` from zero.
[[nodiscard]] double ChanceOfOne(double deviations, std::size_t numbers);

struct MovedNumber {
  std::size_t term{};
  double tolerances{};  ///< from the file
  double chance{};      ///< that a healthy rig has one like it
};

/// The determined number with an effect that is furthest from the file; none where none is
/// determined. `fit` has the deviations that the data leave.
[[nodiscard]] std::optional<MovedNumber> FurthestNumber(const std::vector<Term>& terms,
                                                        const Fit& fit,
                                                        const std::vector<double>& theta);

/// Without a cause: takes the leading candidate, or the effect of a moved number, as the suspected
/// cause, fits it, and says so in `found.doubt`.
void SuspectCause(const RecordLandscape& landscape, const Judging& judging, CauseSelection& found);

}  // namespace levitas::diagnosis
