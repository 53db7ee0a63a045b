#pragma once
// A text written to a file that appears under its name only when it is whole.
//
// Failure  that of common/output_file.hpp; nothing is left behind.

#include <string>

namespace levitas::cli {

void WriteTextFile(const std::string& path, const std::string& text);

}  // namespace levitas::cli
