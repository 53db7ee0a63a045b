#include "cli/run/disk_room.hpp"

#include <sys/statvfs.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace levitas::cli {
namespace {

// Less than a program writes at once: the last write may have failed although a little is left.
constexpr unsigned long long kTooLittle = 256U << 10U;

bool Full(const std::string& folder) {
  struct statvfs facts {};
  if (statvfs(folder.c_str(), &facts) != 0) return false;
  return static_cast<unsigned long long>(facts.f_bavail) * facts.f_frsize < kTooLittle;
}

std::string FolderOf(const std::string& path) {
  std::error_code none;
  if (std::filesystem::is_directory(path, none)) return path;
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

}  // namespace

std::string NoRoom(const std::vector<std::string>& paths) {
  std::vector<std::string> full;
  for (const std::string& path : paths) {
    const std::string folder = FolderOf(path);
    const bool known = std::find(full.begin(), full.end(), folder) != full.end();
    if (!known && Full(folder)) full.push_back(folder);
  }
  std::string text;
  for (const std::string& folder : full) text += (text.empty() ? "" : ", ") + folder;
  return text.empty() ? "" : "no space is left in " + text;
}

std::string RecordingStopped(const std::string& controller_log) {
  constexpr std::string_view kWords = ": recording stopped: ";
  std::ifstream log(controller_log);
  std::string line;
  while (std::getline(log, line)) {
    const std::size_t at = line.find(kWords);
    if (at == std::string::npos) continue;
    return line.substr(at + 2, line.find(". ", at) - at - 2);
  }
  return {};
}

std::vector<std::string> TripFolderNotes(const std::string& controller_log) {
  constexpr std::string_view kWords = ": trip folder: ";
  std::vector<std::string> notes;
  std::ifstream log(controller_log);
  for (std::string line; std::getline(log, line);) {
    const std::size_t at = line.find(kWords);
    if (at != std::string::npos) notes.push_back(line.substr(at + 2));
  }
  return notes;
}

}  // namespace levitas::cli
