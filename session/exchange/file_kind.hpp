#pragma once
// What kind of file somebody else's data are in, by its first bytes, whatever its name: what cannot
// be read is refused with the step that makes a CSV file of it.
//
// Known     Excel (.xlsx, .xls), OpenDocument, TDMS and index, MCAP, Parquet, HDF5, MATLAB, MDF,
//           ROS bags, SQLite, gzip, zip, bzip2, zstd, xz, UTF-16, JSON, and our own sessions.
// Thread    any.
// Failure   BadInput: the kind, the step that helps and the command that takes its result.

#include <string>
#include <string_view>

namespace levitas::session {

/// Refuses a file whose first bytes are not those of text, or of xz behind the ending .xz. A file
/// that cannot be read is left to whoever reads it.
void RefuseOtherKind(const std::string& path);

/// The sentence for a file of this path that begins with these bytes; empty: it may be text.
[[nodiscard]] std::string OtherKind(const std::string& path, std::string_view start);

}  // namespace levitas::session
