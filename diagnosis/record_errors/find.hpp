#pragma once
// Errors of a record itself, looked for before anything is said of the rig.
//
// Order      times, unit of positions (all else needs them in metres), readings, rotation, columns,
//            rate.
// Cost       about a second for a record of two seconds with four axes.
// Thread     any; pure. Failure: none; a record too short for a check passes it.
// Not done   a record that cannot be read at all; candump and sessions have no columns to exchange,
//            but the same errors by wrong wiring: they are looked for too.

#include <vector>

#include "diagnosis/model/model_run.hpp"
#include "diagnosis/model/rig_view.hpp"
#include "diagnosis/record_errors/record_error.hpp"

namespace levitas::diagnosis {

/// `times_s`: of all rows of its file, where it has them.
[[nodiscard]] RecordErrors FindRecordErrors(const RigView& rig, const Record& record,
                                            const std::vector<double>& times_s = {});

/// The rows as they are with the mends in force.
[[nodiscard]] Record Mended(const RigView& rig, const Record& record, const RecordErrors& found);

}  // namespace levitas::diagnosis
