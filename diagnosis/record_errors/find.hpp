#pragma once
// Errors of a record itself, looked for before anything is said of the rig.
//
// Order      times, unit of positions (all else needs them in metres), readings, rotation, rows
//            that are left out, columns, rate.
// Cost       about a second for a record of two seconds with four axes.
// Thread     any; pure. Failure: none; a record too short for a check passes it.
// Not done   a record that cannot be read at all; candump and sessions have no columns to exchange,
//            but the same errors by wrong wiring: they are looked for too. Another rig's file: no
//            share that innovations foretell tells it from a healthy rig within its tolerances.

#include <cstdint>
#include <vector>

#include "diagnosis/model/model_run.hpp"
#include "diagnosis/model/rig_view.hpp"
#include "diagnosis/record_errors/record_error.hpp"

namespace levitas::diagnosis {

inline constexpr std::uint64_t kUnknownGap = 1000;  ///< cycles

/// What other records of the rig and recorder show.
struct SeenElsewhere {
  ColumnUses wiring;
  double rows_apart{};  ///< RecordErrors::rows_apart; 0 also where records disagree

  [[nodiscard]] bool operator==(const SeenElsewhere&) const = default;
};

[[nodiscard]] RecordErrors FindRecordErrors(const RigView& rig, const Record& record,
                                            const SeenElsewhere& elsewhere = {});

/// Of records of one rig and recorder, one entry each. Where a record without a test signal cannot
/// tell which of two columns is wrong, the records that have one do; how far rows are apart, one
/// that turns contradicts those at rest.
[[nodiscard]] std::vector<RecordErrors> FindErrorsOfRecords(const RigView& rig,
                                                            const std::vector<Record>& records);

/// The rows as they are with the mends in force. Where rows are left out the cycles jump by
/// kUnknownGap, from which every model starts anew.
[[nodiscard]] Record Mended(const RigView& rig, const Record& record, const RecordErrors& found);

}  // namespace levitas::diagnosis
