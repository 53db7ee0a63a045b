#pragma once
// An error of the record itself: its columns, units, rate or readings are not what the file says.
//
// Columns    named as in a CSV file, without unit: "position_de_x", "control_current_nde_y",
//            "speed", "rotor_angle", "time".
// Size       by kind: factor of a unit or rate, rows of a delay, metres of a step or plateau, share
//            of rows that are held, number of gaps; 0 where there is none.
// Statistic  by how much less is left when it is mended: of the observer's innovations (swapped,
//            reversed, unit of currents), of the law (delayed), else what its file says.
// Mend       what to change, as a sentence. `by_map`: a map of columns does it.
// Thread     plain data.

#include <cstdint>
#include <string>
#include <vector>

#include "diagnosis/record_errors/column_use.hpp"

namespace levitas::diagnosis {

enum class RecordErrorKind : std::uint8_t {
  kSwapped,
  kReversed,
  kUnit,
  kRate,
  kQuantised,
  kClipped,
  kHeld,
  kDelayed,
  kGaps
};

/// "swapped", "reversed", ...: as in diagnosis.json.
[[nodiscard]] const char* Name(RecordErrorKind kind) noexcept;

struct RecordError {
  RecordErrorKind kind{};
  std::vector<std::string> columns;
  double size{};
  double statistic{};  ///< how many times better the data fit once mended, > 1
  std::string sentence, mend;
  bool by_map{};
};

/// What was found in one record, and what its columns have to be taken for.
struct RecordErrors {
  std::string record;  ///< name
  std::vector<RecordError> errors;
  ColumnUses uses;
  ColumnUses wiring;         ///< part of `uses`: without the units of positions
  bool has_test_signal{};    ///< a wiring that it shows is certain
  double speed_factor{1.0};  ///< of the speed column; of the angle's where there is none
  double angle_factor{1.0};
  double time_factor{1.0};          ///< of the times, steady
  double rows_apart{};              ///< [periods of the rig] that rotation shows; 0: it shows none
  bool drifts{};                    ///< no factor mends the times
  std::vector<std::uint64_t> gaps;  ///< cycles of rows before which others are left out
};

/// What follows the sentences in an answer.
inline constexpr const char* kAsMended =
    "What follows is of the records as mended, where that can be done here; mend the files first.";

/// One sentence for each error, records with the same one together: what is wrong in which columns,
/// and what to change. Empty: no errors.
[[nodiscard]] std::vector<std::string> RecordErrorSentences(const std::vector<RecordErrors>& found);

}  // namespace levitas::diagnosis
