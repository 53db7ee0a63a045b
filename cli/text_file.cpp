#include "cli/text_file.hpp"

#include "common/output_file.hpp"

namespace levitas::cli {

void WriteTextFile(const std::string& path, const std::string& text) { WriteWholeFile(path, text); }

}  // namespace levitas::cli
