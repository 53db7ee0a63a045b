#pragma once
// Calibration that left what a healthy rig may be off by: tried as a cause, with the effect that
// the parameter belongs to.
//
// Why       tolerances of a few per cent let calibration absorb a fault of four of them, and the
//           evidence for naming it is small by construction: at four tolerances the prior of a
//           fault and that of a healthy rig foretell the same data nearly as well (a current gain
//           12 % low at a tolerance of 3 %: 4 nat). What a rig file calls its tolerance says more:
//           beyond `moved_tolerances` of them a rig is not the one that the file describes.
// Beyond    |theta - healthy mean| - 1.64 posterior deviations > moved_tolerances x tolerance: the
//           data, not the prior, must say so.
// Named     the best hypothesis of its effect that moves it, when evidence prefers it at all
//           (0 nat), and the data alone refuse the file's number by decisive_nat and, beside other
//           causes, by form_share of what they explain: a strong cause whose form is not known
//           exactly leaves numbers of others far out. A hum's is known.
// Not here  shapes of modes, which are no effect of the vocabulary.
// Thread    blocks the caller, every processor inside.

#include <vector>

#include "diagnosis/inference/record_landscape.hpp"

namespace levitas::diagnosis {

/// [tolerances] that a nuisance is surely away from its healthy mean; below 0 where it need not be.
[[nodiscard]] double SurelyAway(const Term& term, const Fit& fit, const std::vector<double>& theta,
                                std::size_t index);

/// Nuisances beyond, none of which a cause moves; the furthest in tolerances first.
[[nodiscard]] std::vector<std::size_t> MovedBeyond(const std::vector<Term>& terms, const Fit& fit,
                                                   const std::vector<double>& theta,
                                                   const std::vector<Hypothesis>& causes,
                                                   double tolerances);

/// Without causes, from the index on, that evidence does not ask for beside those after them: a
/// number that moved on the way to another one is back in its tolerance once that has a name.
void DropNeedless(const RecordLandscape& landscape, const SelectionRules& rules, std::size_t from,
                  CauseSelection& found);

/// Adds such causes to those found, up to SelectionRules::most_causes in all.
void NameMovedCalibration(const RecordLandscape& landscape, const SelectionRules& rules,
                          CauseSelection& found);

}  // namespace levitas::diagnosis
