#pragma once
// The nominal rig with its tolerances fitted, and nothing else; and what a healthy rig's records
// tell about them.
//
// Method     a fast observer on a part of the records (smooth, coarse), then the slow one on all
//            that is used. At first all that is the rig's build is held to a fifth of its
//            tolerance: an orbit or an effect that is not explained yet drives gains and delays,
//            which make up for one another, tens of tolerances away, where a fit that is free at
//            once stays.
// Healthy    tolerances shrink to what the healthy records leave open, but not below kDaily of
//            themselves: a rig is not the same from one day to the next. This separates what one
//            record cannot: current gain from sensor gain, gap from bias.
// Thread     blocks the caller, two threads inside.

#include <vector>

#include "diagnosis/inference/refine.hpp"

namespace levitas::diagnosis {

inline constexpr std::size_t kWhiteningOrder = 4;
inline constexpr double kDaily = 0.2;  ///< share of its tolerance

/// `gains` are those of observers of this speed for `records`; `all` may be longer.
[[nodiscard]] Refined CalibrateNuisances(const RigView& rig, const Search& search,
                                         const std::vector<Term>& terms,
                                         const std::vector<Record>& all,
                                         const std::vector<Record>& records, const Gains& gains,
                                         const ObserverSpeed& speed, int passes);

/// Sets `usual` and narrows `tolerance` of the nuisances.
void LearnFromHealthy(const RigView& rig, const std::vector<Record>& healthy,
                      std::vector<Term>& terms);

}  // namespace levitas::diagnosis
