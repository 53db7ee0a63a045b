#pragma once
// Looks at the name of a file about to be written before any work is done for it.
//
// Failure   BadInput when it names a folder, or its folder is missing or not writable; a usage
//           Problem when it is the file that is read, which would be lost.
// Not done  no guarantee that writing will succeed: the writer reports that.

#include <string>

namespace levitas::session {

/// `input_path` is empty when no file is read; an empty `output_path` is never wrong.
void CheckOutputPath(const std::string& output_path, const std::string& input_path);

/// A recording that is there already is not truncated without being asked: a usage Problem unless
/// `overwrite`. An empty file, and what is no regular file, holds no recording.
void CheckNoRecording(const std::string& path, bool overwrite);

}  // namespace levitas::session
