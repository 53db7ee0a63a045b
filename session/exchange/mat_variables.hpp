#pragma once
// The variables of a MAT file as libmatio gives them, each one's size judged before it is read.
//
// Not done   no protection against libmatio itself: mat_file.hpp reads in a process of its own.
// Failure    BadInput naming the variable. Thread: any.

#include <string>
#include <vector>

#include "session/exchange/mat_file.hpp"

namespace levitas::session {

/// All vectors and matrices by name, or the rows (or columns) of `matrix` when the file has it.
MatTable ReadMatInThisProcess(const std::string& path, const std::string& matrix,
                              const std::vector<std::string>& matrix_rows);

}  // namespace levitas::session
