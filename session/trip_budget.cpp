#include "session/trip_budget.hpp"

#include <algorithm>
#include <filesystem>
#include <regex>
#include <tuple>

#include "common/enums.hpp"

namespace levitas::session {
namespace {

namespace fs = std::filesystem;

const std::regex& Pattern() {
  static const std::regex kPattern(
      R"(trip-(\d{8}T\d{6}\.\d{3})Z-([a-z_]+?)(?:-(\d{1,9}))?\.lcmlog)");
  return kPattern;
}

bool IsFault(const std::string& name) {
  for (std::size_t i = 0; i < kFaultCount; ++i) {
    if (Name(static_cast<Fault>(i)) == name) return true;
  }
  return false;
}

struct TripFile {
  std::string name;
  std::string time;
  int copy{};
  std::uintmax_t bytes{};
};

bool Read(const std::string& name, TripFile& file) {
  std::smatch parts;
  if (!std::regex_match(name, parts, Pattern()) || !IsFault(parts[2])) return false;
  file = {name, parts[1], parts[3].matched ? std::stoi(parts[3]) : 1, 0};
  return true;
}

}  // namespace

bool IsTripFileName(const std::string& name) {
  TripFile file;
  return Read(name, file);
}

std::vector<std::string> KeepWithin(const TripBudget& budget, const std::string& folder,
                                    const std::string& newest) {
  std::vector<TripFile> all;
  std::error_code none;
  const fs::path where = folder.empty() ? "." : folder;
  for (fs::directory_iterator at(where, none), end; at != end; at.increment(none)) {
    TripFile file;
    if (!Read(at->path().filename().string(), file)) continue;
    if (at->symlink_status(none).type() != fs::file_type::regular) continue;
    file.bytes = at->file_size(none);
    if (!none) all.push_back(file);
  }
  std::sort(all.begin(), all.end(), [](const TripFile& a, const TripFile& b) {
    return std::tie(a.time, a.copy) > std::tie(b.time, b.copy);
  });
  std::vector<std::string> removed;
  std::size_t files = 0;
  std::uintmax_t bytes = 0;
  bool over = false;  // what is older than the first that is too much goes, too
  for (const TripFile& file : all) {
    over = over || files >= budget.files || bytes + file.bytes > budget.bytes;
    const bool kept = !over || file.name == fs::path(newest).filename().string() ||
                      !fs::remove(where / file.name, none);
    if (!kept) {
      removed.push_back(file.name);
      continue;
    }
    ++files;
    bytes += file.bytes;
  }
  return removed;
}

}  // namespace levitas::session
