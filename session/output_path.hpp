#pragma once
// Looks at the name of a file about to be written before any work is done for it.
//
// Failure   BadInput when it names a folder; a usage Problem when it is the file that is read,
//           which would be lost.
// Not done  no guarantee that writing will succeed: the writer reports that.

#include <string>

namespace levitas::session {

/// `input_path` is empty when no file is read.
void CheckOutputPath(const std::string& output_path, const std::string& input_path);

}  // namespace levitas::session
