#pragma once
// Calibration: fit of the nuisance parameters within their tolerances, without causes; and the
// narrowing of the tolerances by records of the healthy rig.
//
// Method     a fast observer on a part of the records (smooth, coarse), then the slow one on all
//            used records. At first the parameters of the rig's build are held to a fifth of
//            their tolerances: an unexplained orbit or effect would drive gains and delays, which
//            compensate one another, tens of tolerances away, into a local minimum that a fit free
//            from the start does not leave.
// Modes      whose damping or frequency ended off the file are looked for along a grid of
//            frequencies (frequency_scan.hpp): one fit more from there; the better of two stays.
// Lost       where it ends a hundred standard deviations from the records, it begins again from
//            those of the standing rotor alone, which do not lead a mode along its whirl; the
//            better of the two ends stays.
// Healthy    tolerances shrink to the root sum of squares of the posterior of the healthy records
//            and kDaily of themselves, since a rig changes from day to day. This separates
//            parameters that one record cannot: current gain from sensor gain, gap from bias.
// Failure    BadInput for healthy records that the model cannot follow.
// Thread     blocks the caller, every processor inside.

#include <vector>

#include "diagnosis/inference/refine.hpp"

namespace levitas::diagnosis {

/// Past innovations from which the whitening filter foretells the next one. The observer's noise is
/// a share of ki i0, not that of this rig: with strong magnets and quiet probes it follows readings
/// too closely, and the innovations stay coloured over tens of samples. A likelihood that takes
/// them as white (or whitened by a few) prefers any parameter that imitates another observer.
inline constexpr std::size_t kWhiteningOrder = 40;
inline constexpr double kDaily = 0.2;  ///< share of its tolerance

/// Parameters of construction (gains, delays, modes, mass) with a fifth of their tolerances; those
/// of state (unbalance, offset, load) as they are.
[[nodiscard]] std::vector<Term> HeldToFile(std::vector<Term> terms);

/// The same search with terms of HeldToFile, which must outlive it.
[[nodiscard]] Search SearchHeldBy(const std::vector<Term>& held, const Search& search);

/// `gains` are those of observers of this speed for `records`; `all` may be longer.
[[nodiscard]] Refined CalibrateNuisances(const RigView& rig, const Search& search,
                                         const std::vector<Term>& terms,
                                         const std::vector<Record>& all,
                                         const std::vector<Record>& records, const Gains& gains,
                                         const ObserverSpeed& speed, int passes);

/// The terms, with the `healthy_mean` and the narrower `tolerance` of nuisances that records say.
[[nodiscard]] std::vector<Term> LearnFromHealthy(const RigView& rig,
                                                 const std::vector<Record>& healthy,
                                                 const Judging& judging,
                                                 const std::vector<Term>& terms);

}  // namespace levitas::diagnosis
