#pragma once
// Records spoilt on purpose, as loggers and cables do: one error, drawn by seed, in all records of
// a trial; to measure how often errors of a record are named (diagnosis/record_errors/find.hpp).
//
// Kinds      those of RecordErrorKind, one after the other. Columns, sizes and variants by seed:
//            swapped (positions or currents of two axes, or of two bearings), reversed (one column,
//            or both of an axis), unit (one column or all of a kind, 10^3; speed in Hz, rpm or
//            rad/s; angle in degrees), rate (every second row left out, or the times scaled by up
//            to 20 % or drifting), quantised (steps of 2 to 10 times the noise), clipped (0.5 to 10
//            % of the rows), held (one or more of every 2 to 6 rows), delayed (1 to 5 rows), gaps
//            (2 to 200 rows left out at 1 to 6 places, numbers and times closed up).
// Thread     any; no shared state.

#include <cstdint>
#include <string>
#include <vector>

#include "benchmark/accuracy/trial.hpp"
#include "configuration/rig_file.hpp"
#include "diagnosis/model/model_run.hpp"
#include "diagnosis/record_errors/record_error.hpp"

namespace levitas::accuracy {

struct Spoilt {
  diagnosis::RecordErrorKind kind{};
  std::vector<std::string> columns;        ///< as a RecordError has them
  double size{};                           ///< of the mend
  std::vector<diagnosis::Record> records;  ///< with the times that their file would have
};

[[nodiscard]] Spoilt Spoil(const configuration::RigFile& rig,
                           const std::vector<diagnosis::Record>& records,
                           diagnosis::RecordErrorKind kind, std::uint64_t seed);

/// Whether one of the errors is the one that was made, with its columns and size.
[[nodiscard]] bool IsNamed(const Spoilt& made, const diagnosis::RecordErrors& found);

}  // namespace levitas::accuracy
