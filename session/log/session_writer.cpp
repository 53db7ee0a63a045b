#include "session/log/session_writer.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <utility>

#include "common/output_file.hpp"
#include "lcmtypes/torsion/torsion_codec.hpp"
#include "session/log/log_format.hpp"
#include "session/log/packed_log.hpp"
#include "session/log/record_codec.hpp"

namespace levitas::session {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{256} << 10;
// A copy of the header is written again after this many records (10 s at 10 kHz) and at the end: a
// session whose first block is damaged is then still readable.
constexpr std::uint64_t kRecordsPerHeaderCopy = 100'000;

int DescriptorOf(const PartFile& file) {
  const int own = ::fcntl(file.descriptor(), F_DUPFD_CLOEXEC, 0);
  if (own < 0) CannotWrite(file.path(), errno);
  return own;
}

// In short steps, so that time in which this process does not run does not count: the reader may
// not have run either.
bool AwaitRoom(int fd, std::chrono::milliseconds patience) {
  constexpr std::chrono::milliseconds kStep{50};
  for (auto left = patience; left.count() > 0; left -= kStep) {
    pollfd room{.fd = fd, .events = POLLOUT, .revents = 0};
    if (::poll(&room, 1, static_cast<int>(std::min(left, kStep).count())) > 0) return true;
  }
  return false;
}

std::string Why(int error) {
  return error == EAGAIN ? "the reader of this pipe takes nothing any more" : std::strerror(error);
}

}  // namespace

struct SessionWriter::Impl {
  Impl(int descriptor, std::string file_path, const SessionHeader& header,
       std::chrono::milliseconds patience_with_readers)
      : path(std::move(file_path)),
        patience(patience_with_readers),
        codec(header.channels.size()),
        period_ns(header.period_ns),
        start_utc_ns(header.start_utc_ns),
        fd(descriptor) {
    buffer.reserve(kBufferBytes + kMaxDataBytes / 16);
    if (PackedName(path)) packer.emplace(kRecordingLevel);
    EncodeHeader(header, header_bytes);
    Append(kHeaderChannel, header_bytes, start_utc_ns / 1000);
  }

  ~Impl() {
    if (fd >= 0) ::close(fd);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void Append(std::string_view channel, const Bytes& data, std::int64_t time_us) {
    const std::size_t size = kEventHeaderBytes + channel.size() + data.size();
    const std::size_t at = buffer.size();
    buffer.resize(at + size);
    std::uint8_t* to = buffer.data() + at;
    PutEventHeader(to, {.number = number++,
                        .time_us = time_us,
                        .channel_bytes = static_cast<std::int32_t>(channel.size()),
                        .data_bytes = static_cast<std::int32_t>(data.size())});
    std::memcpy(to + kEventHeaderBytes, channel.data(), channel.size());
    std::memcpy(to + kEventHeaderBytes + channel.size(), data.data(), data.size());
    if (buffer.size() >= kBufferBytes) Flush();
  }

  void Flush() {
    if (packer) {
      packer->Pack(buffer, packed);
      buffer.clear();
      WriteOut(packed);
    } else {
      WriteOut(buffer);
    }
  }

  void End() {
    Flush();
    if (!packer) return;
    packer->End(packed);
    WriteOut(packed);
  }

  void WriteOut(Bytes& bytes) {
    std::size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t wrote = ::write(fd, bytes.data() + done, bytes.size() - done);
      if (wrote < 0 && errno == EINTR) continue;
      if (wrote < 0 && errno == EAGAIN) {
        if (AwaitRoom(fd, patience)) continue;
        errno = EAGAIN;
      }
      if (wrote <= 0) {
        const int error = errno;
        bytes.clear();  // so that the destructor does not try, and fail, again
        throw WriteFailed(path, error);
      }
      done += static_cast<std::size_t>(wrote);
    }
    bytes.clear();
  }

  /// Time of a record in the log, so that players keep the recorded pace: the controller's own
  /// count of periods, those it missed included. Unlike the rig's stamp it survives a rig restart.
  std::int64_t TimeUs(const cycle::CycleRecord& record) {
    if (!first_cycle_known) {
      first_cycle = record.in.cycle;
      first_cycle_known = true;
    } else {
      missed += record.in.missed_deadlines;
    }
    const auto periods = static_cast<std::int64_t>(record.in.cycle - first_cycle + missed);
    last_time_us = (start_utc_ns + periods * period_ns) / 1000;
    return last_time_us;
  }

  std::string path;
  std::chrono::milliseconds patience;
  RecordCodec codec;
  TorsionCodec torsion_codec;
  std::int64_t period_ns;
  std::int64_t start_utc_ns;
  int fd{-1};
  Bytes buffer;
  std::optional<Packer> packer;
  Bytes packed;
  Bytes scratch;
  Bytes header_bytes;
  std::int64_t number{0};
  std::uint64_t records{0};
  std::uint64_t first_cycle{0};
  std::uint64_t missed{0};
  bool first_cycle_known{false};
  bool closed{false};
  std::int64_t last_time_us{start_utc_ns / 1000};
};

WriteFailed::WriteFailed(const std::string& path, int error)
    : Problem(ExitStatus::kOther,
              fmt::format("{}: recording stopped: {}. What was written before is readable.", path,
                          Why(error))),
      error_(error) {}

SessionWriter::SessionWriter(const std::string& path, const SessionHeader& header,
                             Standing standing, std::chrono::milliseconds patience)
    : impl_(std::make_unique<Impl>(OpenUnderItsName(path, standing), path, header, patience)) {
  impl_->Flush();
}

SessionWriter::SessionWriter(const PartFile& file, const SessionHeader& header)
    : impl_(std::make_unique<Impl>(DescriptorOf(file), file.path(), header, kPatience)) {
  impl_->Flush();
}

SessionWriter::~SessionWriter() {
  try {
    Close();
  } catch (const std::exception&) {
    // A destructor cannot report; Close before it is how a caller learns of a full disk.
  }
}

void SessionWriter::Write(const cycle::CycleRecord& record) {
  impl_->codec.Encode(record, impl_->scratch);
  impl_->Append(kCycleChannel, impl_->scratch, impl_->TimeUs(record));
  if (++impl_->records % kRecordsPerHeaderCopy == 0) {
    impl_->Append(kHeaderChannel, impl_->header_bytes, impl_->last_time_us);
  }
}

void SessionWriter::Write(const Event& event) {
  EncodeEvent(event, impl_->scratch);
  impl_->Append(kEventChannel, impl_->scratch, impl_->last_time_us);
}

void SessionWriter::Write(const TorsionBatch& batch) {
  impl_->scratch.resize(TorsionCodec::LargestSize());
  impl_->scratch.resize(impl_->torsion_codec.Encode(batch, impl_->scratch));
  impl_->Append(kTorsionChannel, impl_->scratch, impl_->last_time_us);
}

void SessionWriter::Flush() { impl_->Flush(); }

void SessionWriter::Close() {
  if (impl_->records > 0 && !impl_->closed) {
    impl_->Append(kHeaderChannel, impl_->header_bytes, impl_->last_time_us);
  }
  impl_->closed = true;
  impl_->End();
}

}  // namespace levitas::session
