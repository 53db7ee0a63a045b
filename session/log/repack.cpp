#include "session/log/repack.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

#include "common/output_file.hpp"
#include "common/problem.hpp"
#include "session/log/log_scanner.hpp"
#include "session/log/packed_log.hpp"

namespace levitas::session {
namespace {

using LogPart = std::span<const std::uint8_t>;
constexpr std::size_t kPieceBytes = std::size_t{256} << 10;

std::string_view AsText(LogPart bytes) {
  const void* first = bytes.data();
  return {static_cast<const char*>(first), bytes.size()};
}

/// Bytes `from` .. `to` of the log, or to its end.
template <class Function>
std::uint64_t CopyLog(LogScanner& log, std::uint64_t from, std::uint64_t to, Function function) {
  while (from < to) {
    const LogPart piece =
        log.Bytes(from, static_cast<std::size_t>(std::min<std::uint64_t>(kPieceBytes, to - from)));
    if (piece.empty()) break;
    function(piece);
    from += piece.size();
  }
  return from;
}

/// Hands a plain log over in pieces: an event, or what stands between events that are whole.
template <class Function>
std::uint64_t CopyByEvents(LogScanner& log, Function function) {
  RawEvent event;
  for (LogScanner::Look look = log.At(event); look != LogScanner::Look::kEnd;
       look = log.At(event)) {
    const std::uint64_t from = log.offset();
    if (look != LogScanner::Look::kEvent) log.SkipToSync();
    const std::uint64_t to = look == LogScanner::Look::kEvent ? event.end : log.offset();
    CopyLog(log, from, to, function);
    log.MoveTo(to);
  }
  return log.offset();
}

void RefuseOtherBytes(const std::string& path, const std::string& packed_path) {
  LogScanner log(path);
  LogScanner packed(packed_path);
  for (std::uint64_t at = 0;;) {
    const LogPart expected = log.Bytes(at, kPieceBytes);
    const LogPart found = packed.Bytes(at, kPieceBytes);
    const std::size_t both = std::min(expected.size(), found.size());
    if (both == 0 && expected.empty() && found.empty()) return;
    if (both == 0 || AsText(expected.first(both)) != AsText(found.first(both))) {
      throw Problem(ExitStatus::kOther,
                    fmt::format("{}: what was packed of it reads back otherwise near byte {}: the "
                                "file changes (is it being recorded?), or the disk is at fault",
                                path, at));
    }
    at += both;
  }
}

/// Gathers pieces to what is worth a block.
class RepackTarget {
 public:
  RepackTarget(OutputFile& file, bool packed) : file_(file) {
    if (packed) packer_ = std::make_unique<Packer>(kArchiveLevel);
  }
  void Take(LogPart piece) {
    if (!packer_) {
      file_.Write(AsText(piece));
      return;
    }
    gathered_.insert(gathered_.end(), piece.begin(), piece.end());
    if (gathered_.size() >= kFrameBytes) Pack();
  }
  void End() {
    if (!packer_) return;
    Pack();
    packer_->End(made_);
    file_.Write(AsText(made_));
  }

 private:
  void Pack() {
    packer_->Pack(gathered_, made_);
    file_.Write(AsText(made_));
    gathered_.clear();
  }

  OutputFile& file_;
  std::unique_ptr<Packer> packer_;
  std::vector<std::uint8_t> gathered_;
  std::vector<std::uint8_t> made_;
};

}  // namespace

RepackReport Repack(const std::string& path, const std::string& out_path) {
  LogScanner log(path);
  RepackReport report;
  report.file_bytes = log.file_bytes();
  const bool pack = PackedName(out_path);
  OutputFile file(out_path);
  RepackTarget out(file, pack);
  const auto take = [&out](LogPart piece) { out.Take(piece); };
  constexpr std::uint64_t kToItsEnd = std::numeric_limits<std::uint64_t>::max();
  report.log_bytes =
      log.packed() != nullptr ? CopyLog(log, 0, kToItsEnd, take) : CopyByEvents(log, take);
  out.End();
  file.Flush();
  if (pack && !file.part().direct()) RefuseOtherBytes(path, file.part().part_path());
  file.Commit();
  std::error_code none;
  const auto size = std::filesystem::file_size(out_path, none);
  report.out_bytes = none ? 0 : size;
  return report;
}

bool IsPacked(const std::string& path) { return LogScanner(path).packed() != nullptr; }

}  // namespace levitas::session
