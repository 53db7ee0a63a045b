#pragma once
// amb import --suggest: the map of columns that mends the errors of a record.
//
// From       a map, or without one the columns' names as --guess reads them; and what law and plant
//            say of the rows (diagnosis/record_errors/find.hpp). What no map mends stands in
//            comments.
// Times      that are no whole periods of the rig are left out: the map states the rig's rate.
// Failure    BadInput: as reading the file does. Thread: any; no shared state.

#include <string>
#include <vector>

#include "configuration/rig_file.hpp"
#include "diagnosis/record_errors/record_error.hpp"
#include "session/exchange/column_map.hpp"

namespace levitas::cli {

struct SuggestedMap {
  std::string text;  ///< for --map
  diagnosis::RecordErrors found;
};

/// `map`: what the columns are taken for so far, or nullptr. `import` is the command that takes the
/// suggested one.
[[nodiscard]] SuggestedMap SuggestMap(const std::string& data_path,
                                      const configuration::RigFile& rig,
                                      const session::ColumnMap* map, const std::string& import);

}  // namespace levitas::cli
