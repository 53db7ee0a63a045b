#include "cli/commands/compress_sessions.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <filesystem>

#include "common/problem.hpp"
#include "rt/say.hpp"
#include "session/log/repack.hpp"
#include "session/log/session_reader.hpp"
#include "session_index/catalogue.hpp"

namespace levitas::cli {
namespace {

namespace fs = std::filesystem;

std::string KnownPath(const std::string& path) {
  return fs::absolute(path).lexically_normal().string();
}

void RefuseExisting(const std::string& path, const std::string& packed) {
  if (!fs::exists(fs::symlink_status(packed))) return;
  throw BadInput(fmt::format("{}: {} is there already and is not replaced; remove one of the two",
                             path, packed));
}

/// The entry moves with its tags; what is not in the catalogue is not entered.
void MoveEntry(session_index::Catalogue& catalogue, const Compressed& done, bool keep) {
  const std::vector<session_index::Entry> all = catalogue.Find({});
  const auto found = std::ranges::find(all, KnownPath(done.from), &session_index::Entry::path);
  if (found == all.end()) return;
  session_index::Entry entry = *found;
  entry.path = KnownPath(done.session);
  entry.size_byte = done.after_byte;
  catalogue.Put(entry);
  if (!keep) catalogue.Forget(KnownPath(done.from));
}

Compressed CompressOne(const std::string& path, bool keep) {
  const std::string packed = path + ".zst";
  static_cast<void>(session::SessionReader(path));  // a session, or refused with the reason
  RefuseExisting(path, packed);
  const auto changed = fs::last_write_time(path);
  const session::RepackReport report = session::Repack(path, packed);
  if (fs::last_write_time(path) != changed || fs::file_size(path) != report.file_bytes) {
    fs::remove(packed);
    throw BadInput(path +
                   ": changes while it is packed, so it is being recorded; it stays as it is");
  }
  fs::permissions(packed, fs::status(path).permissions());
  fs::last_write_time(packed, changed);
  if (!keep) fs::remove(path);
  return {packed, path, report.file_bytes, report.out_bytes};
}

}  // namespace

std::vector<Compressed> CompressSessions(const CompressOptions& options, std::string& refused) {
  std::vector<Compressed> all;
  std::optional<session_index::Catalogue> catalogue;
  if (options.catalogue) catalogue.emplace(*options.catalogue);
  for (const std::string& path : options.files) {
    try {
      if (session::IsPacked(path)) {
        fmt::print("{}: is packed already\n", rt::OneLine(path));
        continue;
      }
      const Compressed done = CompressOne(path, options.keep);
      if (catalogue) MoveEntry(*catalogue, done, options.keep);
      fmt::print("{}: {:.1f} MB instead of {:.1f} MB\n", rt::OneLine(done.session),
                 static_cast<double>(done.after_byte) * 1e-6,
                 static_cast<double>(done.before_byte) * 1e-6);
      all.push_back(done);
    } catch (const BadInput& problem) {
      refused += (refused.empty() ? "" : "\n") + std::string(problem.what());
    }
  }
  return all;
}

}  // namespace levitas::cli
