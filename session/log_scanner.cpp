#include "session/log_scanner.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "common/problem.hpp"
#include "session/log_format.hpp"

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
  size_ = static_cast<std::uint64_t>(status.st_size);
}

LogScanner::~LogScanner() { ::close(fd_); }

std::span<const std::uint8_t> LogScanner::Window(std::uint64_t from, std::size_t count) {
  if (from >= size_) return {};
  const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(count, size_ - from));
  if (from < window_offset_ || from + wanted > window_offset_ + window_bytes_) {
    // Twice what is asked for: whoever goes on behind a length that lied finds the next bytes here,
    // so that a file is read about twice, however many lengths in it lie.
    const std::uint64_t room = std::max<std::uint64_t>(kChunkBytes, 2 * std::uint64_t{wanted});
    window_.resize(static_cast<std::size_t>(std::min(room, size_ - from)));
    window_offset_ = from;
    window_bytes_ = 0;
    while (window_bytes_ < window_.size()) {
      const ssize_t got =
          ::pread(fd_, window_.data() + window_bytes_, window_.size() - window_bytes_,
                  static_cast<off_t>(from + window_bytes_));
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) {
        throw BadInput(fmt::format("{}: reading at byte {} failed: {}", path_, from + window_bytes_,
                                   std::strerror(errno)));
      }
      if (got == 0) break;
      window_bytes_ += static_cast<std::size_t>(got);
    }
  }
  const auto start = static_cast<std::size_t>(from - window_offset_);
  const std::size_t there = window_bytes_ > start ? window_bytes_ - start : 0;
  return {window_.data() + start, std::min(wanted, there)};
}

LogScanner::Look LogScanner::At(RawEvent& event) {
  if (offset_ >= size_) return Look::kEnd;
  const auto head = Window(offset_, kEventHeaderBytes);
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
