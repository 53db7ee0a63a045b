#pragma once
// Rows that are left out while cycles and times run on, as a recorder does whose buffer was full
// and a file that was put together of pieces.
//
// Law        a controller computes its currents: of a record without gaps, each follows from the
//            positions, currents and test signals of the rows up to it, whatever is wrong with the
//            rig. Least squares, axis by axis and, where that does not do, over all columns: a
//            law between axes. Rows that do not fit are left out and the rest is fitted again.
// Gap        a row from which on the currents of half the axes (two at least) are off by kBroken
//            times the usual, and not for longer than the law remembers. Only where few rows are
//            so.
// Limits     the current of an axis at its limit follows no law: within the law's memory of that
//            only the other axes are judged, or none where the law is one between axes.
// Not found  where the law is not known (left kKnown of the currents), where more than half of the
//            axes are at a limit, beside missing or repeated frames; how many rows are missing.
// Rows       the law from the columns, the gaps from all levitated rows of the record.
// Cost       0.2 s for two seconds of four axes. Thread: any; pure.

#include <cstdint>

#include "diagnosis/model/model_run.hpp"
#include "diagnosis/model/rig_view.hpp"
#include "diagnosis/record_errors/record_error.hpp"

namespace levitas::diagnosis {

/// Adds the error and the cycles of the rows that follow a gap. `first_cycle`: of the file, from
/// which places are told.
void FindGaps(const RigView& rig, const Record& record, std::uint64_t first_cycle,
              RecordErrors& out);

}  // namespace levitas::diagnosis
