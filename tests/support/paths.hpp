#pragma once
// Where the tests find the sources, their data and the programs. Functions of one small library
// rather than compile definitions, so that the compiler's cache serves every clone.

#include <string>

namespace levitas::test {

[[nodiscard]] const std::string& SourceFolder();   ///< root of the repository
[[nodiscard]] const std::string& DataFolder();     ///< tests/data
[[nodiscard]] const std::string& ProgramFolder();  ///< amb, amb-controller, amb-plant

}  // namespace levitas::test
