#pragma once
// Readings that a recorder has spoilt: coarser steps than the rig's converter makes, plateaus, held
// values. No map of columns mends them.
//
// Quantised  the readings of a column are whole steps apart (all but one in a hundred, from the
//            smallest), and the step is kCoarseSteps times the converter's and larger than the
//            noise.
// Clipped    a column's largest or smallest value stands in at least kPlateau rows and kOverNext
//            times as many as come near it; within the sensor's range, whose own plateau is the
//            rig's. Currents at the rig's limit are no error, and only positions are looked at.
// Held       a column repeats its value in the same row or rows of every n (2 to kMostPeriod),
//            while it moves in the others; or kTimesOthers as often as the other columns of its
//            kind. Frames that repeat in every column now and then are lost ones, of which the
//            diagnosis knows (repeated_frames.hpp).
// Thread     any; pure.

#include "diagnosis/model/rig_view.hpp"
#include "diagnosis/record_errors/columns.hpp"
#include "diagnosis/record_errors/record_error.hpp"

namespace levitas::diagnosis {

void FindQuantised(const RigView& rig, const Columns& columns, RecordErrors& out);
void FindClipped(const RigView& rig, const Columns& columns, RecordErrors& out);
void FindHeld(const RigView& rig, const Columns& columns, RecordErrors& out);

}  // namespace levitas::diagnosis
