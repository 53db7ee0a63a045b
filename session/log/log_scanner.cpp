#include "session/log/log_scanner.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <limits>

#include "common/problem.hpp"
#include "session/log/log_format.hpp"
#include "session/log/packed_log.hpp"

namespace levitas::session {
namespace {

constexpr std::size_t kChunkBytes = std::size_t{1} << 20;

constexpr std::array<std::uint8_t, 4> SyncBytes() {
  std::array<std::uint8_t, 4> bytes{};
  PutBigEndian(bytes.data(), kSyncWord);
  return bytes;
}
constexpr auto kSyncBytes = SyncBytes();

bool LengthsBelievable(const EventHeader& header) noexcept {
  return header.channel_bytes > 0 &&
         header.channel_bytes <= static_cast<std::int32_t>(kMaxChannelBytes) &&
         header.data_bytes >= 0 && header.data_bytes <= static_cast<std::int32_t>(kMaxDataBytes);
}

}  // namespace

LogScanner::LogScanner(const std::string& path) : path_(path) {
  fd_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat status {};
  const bool known = fd_ >= 0 && ::fstat(fd_, &status) == 0;
  const int error = errno;
  if (!known || !S_ISREG(status.st_mode)) {
    if (fd_ >= 0) ::close(fd_);
    throw BadInput(fmt::format("{}: cannot be read as a session: {}", path,
                               known ? "it is not a file" : std::strerror(error)));
  }
  file_bytes_ = size_ = static_cast<std::uint64_t>(status.st_size);
  std::array<std::uint8_t, 4> start{};
  const std::size_t there = ReadAt(0, start);
  if (BeginsPacked({start.data(), there}) || (PackedName(path) && there > 0)) {
    packed_ = std::make_unique<PackedReader>(fd_, file_bytes_, path_);
    size_ = std::numeric_limits<std::uint64_t>::max();
  }
}

LogScanner::~LogScanner() { ::close(fd_); }

std::size_t LogScanner::ReadAt(std::uint64_t at, std::span<std::uint8_t> to) {
  std::size_t filled = 0;
  while (filled < to.size()) {
    const ssize_t got =
        ::pread(fd_, to.data() + filled, to.size() - filled, static_cast<off_t>(at + filled));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) {
      throw BadInput(fmt::format("{}: reading at byte {} failed: {}", path_, at + filled,
                                 std::strerror(errno)));
    }
    if (got == 0) break;
    filled += static_cast<std::size_t>(got);
  }
  return filled;
}

void LogScanner::LoadPlain(std::uint64_t from, std::size_t room) {
  window_.resize(room);
  window_offset_ = from;
  window_bytes_ = ReadAt(from, window_);
}

// What is unpacked comes once and in order: what the window has of it is kept.
void LogScanner::LoadPacked(std::uint64_t from, std::size_t room) {
  if (from < window_offset_) {
    packed_->Rewind();
    window_offset_ = 0;
    window_bytes_ = 0;
  }
  const auto left =
      static_cast<std::size_t>(std::min<std::uint64_t>(from - window_offset_, window_bytes_));
  const auto kept = std::span(window_).subspan(left, window_bytes_ - left);
  std::copy(kept.begin(), kept.end(), window_.begin());
  window_offset_ += left;
  window_bytes_ -= left;
  window_.resize(std::max(room, window_bytes_));
  while (window_offset_ < from) {
    const std::uint64_t over = from - window_offset_;
    const std::size_t passed = packed_->Read(
        std::span(window_).first(static_cast<std::size_t>(std::min<std::uint64_t>(over, room))));
    window_offset_ += passed;
    if (passed == 0) break;
  }
  window_bytes_ += packed_->Read(std::span(window_).subspan(window_bytes_));
  if (window_bytes_ < window_.size()) size_ = window_offset_ + window_bytes_;
}

std::span<const std::uint8_t> LogScanner::Window(std::uint64_t from, std::size_t count) {
  if (from >= size_) return {};
  const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(count, size_ - from));
  if (from < window_offset_ || from + wanted > window_offset_ + window_bytes_) {
    // Twice what is asked for: whoever goes on behind a length that lied finds the next bytes here,
    // so that a file is read about twice, however many lengths in it lie.
    const std::uint64_t most = std::max<std::uint64_t>(kChunkBytes, 2 * std::uint64_t{wanted});
    const auto room = static_cast<std::size_t>(std::min(most, size_ - from));
    if (packed_) {
      LoadPacked(from, room);
    } else {
      LoadPlain(from, room);
    }
  }
  if (from > window_offset_ + window_bytes_) return {};
  const auto start = static_cast<std::size_t>(from - window_offset_);
  return {window_.data() + start, std::min(wanted, window_bytes_ - start)};
}

LogScanner::Look LogScanner::At(RawEvent& event) {
  const auto head = Window(offset_, kEventHeaderBytes);
  if (head.empty()) return Look::kEnd;
  if (head.size() < kEventHeaderBytes) {
    const std::size_t compared = std::min(head.size(), kSyncBytes.size());
    const bool starts = std::memcmp(head.data(), kSyncBytes.data(), compared) == 0;
    return starts ? Look::kCutOff : Look::kNotEvent;
  }
  const EventHeader header = GetEventHeader(head.data());
  if (header.sync != kSyncWord || !LengthsBelievable(header)) return Look::kNotEvent;
  const auto channel_bytes = static_cast<std::size_t>(header.channel_bytes);
  const auto data_bytes = static_cast<std::size_t>(header.data_bytes);
  const std::size_t bytes = kEventHeaderBytes + channel_bytes + data_bytes;
  const auto whole = Window(offset_, bytes);
  if (whole.size() < bytes) return Look::kCutOff;
  const auto body = whole.subspan(kEventHeaderBytes);
  event.offset = offset_;
  event.end = offset_ + bytes;
  event.time_us = header.time_us;
  const void* name = body.data();
  event.channel = {static_cast<const char*>(name), channel_bytes};
  event.data = body.subspan(channel_bytes);
  return Look::kEvent;
}

bool LogScanner::SkipToSync() {
  ++offset_;
  while (offset_ < size_) {
    const auto window = Window(offset_, kChunkBytes / 4);
    if (window.size() < kSyncBytes.size()) break;
    const void* found =
        ::memmem(window.data(), window.size(), kSyncBytes.data(), kSyncBytes.size());
    if (found != nullptr) {
      offset_ +=
          static_cast<std::uint64_t>(static_cast<const std::uint8_t*>(found) - window.data());
      return true;
    }
    offset_ += window.size() - (kSyncBytes.size() - 1);  // the word may straddle two windows
  }
  offset_ = size_;
  return false;
}

}  // namespace levitas::session
