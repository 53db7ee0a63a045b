#pragma once
// The whitening filter without the first cause in it.
//
// Why     the filter is made of what calibration leaves, and a strong cause that is in there is
//         taken for coloured noise. In a closed loop a filter that the noise does not have biases
//         what is fitted behind it: noise of the past moves the rotor, so filtered noise and
//         filtered sensitivities are correlated (Ljung, System Identification, 2nd ed., chapter
//         13, direct approach: the noise model must be right). A mains hum of 1.5 um came out as
//         2.7 um, with a current gain of 1.56 beside it that no magnet had.
// Who     a search that ends with its first cause. One that goes on linearises, and whitens, anew
//         for every further cause.
// Thread  blocks the caller, every processor inside.

#include "diagnosis/inference/cause_selection.hpp"
#include "diagnosis/inference/observed_landscape.hpp"

namespace levitas::diagnosis {

/// Linearises at the causes found and fits them again, first unfiltered, where the present filter
/// takes anything away; what was refitted behind it is forgotten. False: there is nothing in it.
bool WhitenAnew(ObservedLandscape& landscape, const SelectionRules& rules, CauseSelection& found);

}  // namespace levitas::diagnosis
