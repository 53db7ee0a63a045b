#include "session/log/trip_budget.hpp"

#include <algorithm>
#include <filesystem>
#include <regex>

#include "common/enums.hpp"

namespace levitas::session {
namespace {

namespace fs = std::filesystem;

bool IsFault(const std::string& name) {
  for (std::size_t i = 0; i < kFaultCount; ++i) {
    if (Name(static_cast<Fault>(i)) == name) return true;
  }
  return false;
}

fs::path TripFolder(const std::string& folder) { return folder.empty() ? "." : folder; }

/// False for what is no regular file.
bool RegularSize(const fs::path& file, std::uintmax_t& bytes) {
  std::error_code none;
  if (fs::symlink_status(file, none).type() != fs::file_type::regular) return false;
  bytes = fs::file_size(file, none);
  return !none;
}

}  // namespace

bool IsTripFileName(const std::string& name) {
  static const std::regex kPattern(
      R"(trip-(\d{8}T\d{6}\.\d{3})Z-([a-z_]+?)(?:-(\d{1,9}))?\.lcmlog)");
  std::smatch parts;
  return std::regex_match(name, parts, kPattern) && IsFault(parts[2]);
}

std::vector<std::string> KeepWithin(const TripBudget& budget, const std::string& folder,
                                    std::vector<std::string>& written) {
  std::vector<std::string> removed;
  std::vector<std::string> kept;  // newest first
  std::uintmax_t bytes = 0;
  bool over = false;  // what is older than the first that is too much goes, too
  for (auto name = written.rbegin(); name != written.rend(); ++name) {
    std::uintmax_t size = 0;
    const fs::path file = TripFolder(folder) / *name;
    if (!RegularSize(file, size)) continue;
    over = over || kept.size() >= budget.files || bytes + size > budget.bytes;
    std::error_code none;
    if (over && name != written.rbegin() && fs::remove(file, none)) {
      removed.push_back(*name);
      continue;
    }
    kept.push_back(*name);
    bytes += size;
  }
  written.assign(kept.rbegin(), kept.rend());
  return removed;
}

OlderTrips OlderTripFiles(const std::string& folder, const std::vector<std::string>& written) {
  OlderTrips older;
  std::error_code none;
  for (fs::directory_iterator at(TripFolder(folder), none), end; at != end; at.increment(none)) {
    const std::string name = at->path().filename().string();
    std::uintmax_t size = 0;
    if (!IsTripFileName(name) || !RegularSize(at->path(), size)) continue;
    if (std::ranges::find(written, name) != written.end()) continue;
    ++older.files;
    older.bytes += size;
  }
  return older;
}

}  // namespace levitas::session
