#include "cli/text_file.hpp"

#include <filesystem>
#include <fstream>

#include "common/problem.hpp"
#include "session/output_path.hpp"

namespace levitas::cli {
namespace {

[[noreturn]] void Refuse(const std::string& path) {
  throw BadInput(path + ": cannot be written; check that the folder exists, is yours and has room");
}

}  // namespace

void WriteTextFile(const std::string& path, const std::string& text) {
  session::PartFile part(path);
  std::ofstream file(part.part_path(), std::ios::binary);
  file << text;
  file.close();
  if (!file) Refuse(path);
  try {
    part.Commit();
  } catch (const std::filesystem::filesystem_error&) {  // the name is a folder's
    Refuse(path);
  }
}

}  // namespace levitas::cli
