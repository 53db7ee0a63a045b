#include "cli/text_file.hpp"

namespace levitas::cli {

void WriteTextFile(const std::string& path, const std::string& text, Earlier earlier) {
  WriteWholeFile(path, text, earlier);
}

}  // namespace levitas::cli
