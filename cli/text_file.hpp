#pragma once
// A text written to a file that appears under its name only when it is whole.
//
// Failure  that of common/output_file.hpp; nothing is left behind.

#include <string>

#include "common/output_file.hpp"

namespace levitas::cli {

/// See common/output_file.hpp of what becomes of an earlier one.
void WriteTextFile(const std::string& path, const std::string& text,
                   Earlier earlier = Earlier::kKept);

}  // namespace levitas::cli
