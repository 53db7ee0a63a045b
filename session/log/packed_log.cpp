#include "session/log/packed_log.hpp"

#include <fmt/core.h>
#include <unistd.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <new>
#include <utility>

#include "common/problem.hpp"

namespace levitas::session {
namespace {

constexpr std::array<std::uint8_t, 4> kFrameMagic{0x28, 0xB5, 0x2F, 0xFD};
// What a damaged length of a block can have swallowed: the next frame may begin there.
constexpr std::uint64_t kMostBlockBytes = (std::uint64_t{128} << 10) + 3;
constexpr std::size_t kPackedInputBytes = std::size_t{128} << 10;
constexpr std::uint64_t kAlwaysAllowed = std::uint64_t{64} << 20;
// However many lengths lie, a file is read so often and not once more for each of them.
constexpr std::uint64_t kMostReadings = 16;

bool IsFrameMagic(const std::uint8_t* bytes) noexcept {
  return std::memcmp(bytes, kFrameMagic.data(), kFrameMagic.size()) == 0;
}

struct FreeZstd {
  void operator()(ZSTD_CCtx* context) const noexcept { ZSTD_freeCCtx(context); }
  void operator()(ZSTD_DCtx* context) const noexcept { ZSTD_freeDCtx(context); }
};

}  // namespace

bool PackedName(std::string_view path) noexcept { return path.ends_with(".zst"); }

bool BeginsPacked(std::span<const std::uint8_t> start) noexcept {
  if (start.size() < kFrameMagic.size()) return false;
  const bool skipped =
      (start[0] & 0xF0U) == 0x50U && start[1] == 0x2A && start[2] == 0x4D && start[3] == 0x18;
  return skipped || IsFrameMagic(start.data());
}

struct Packer::Impl {
  explicit Impl(int level) : context(ZSTD_createCCtx()) {
    if (!context) throw std::bad_alloc();
    ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, level);
    ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  }

  void Run(std::span<const std::uint8_t> events, ZSTD_EndDirective until,
           std::vector<std::uint8_t>& out) {
    ZSTD_inBuffer in{events.data(), events.size(), 0};
    std::size_t filled = 0;
    for (std::size_t left = 1; left != 0;) {
      out.resize(filled + ZSTD_CStreamOutSize());
      ZSTD_outBuffer to{out.data() + filled, out.size() - filled, 0};
      left = ZSTD_compressStream2(context.get(), &to, &in, until);
      // Nothing else can fail: the parameters are ours and the output has room.
      if (ZSTD_isError(left) != 0) throw std::bad_alloc();
      filled += to.pos;
    }
    out.resize(filled);
  }

  std::unique_ptr<ZSTD_CCtx, FreeZstd> context;
  std::size_t in_frame{0};
};

Packer::Packer(int level) : impl_(std::make_unique<Impl>(level)) {}
Packer::~Packer() = default;

void Packer::Pack(std::span<const std::uint8_t> events, std::vector<std::uint8_t>& out) {
  out.clear();
  if (events.empty()) return;
  impl_->in_frame += events.size();
  const bool full = impl_->in_frame >= kFrameBytes;
  impl_->Run(events, full ? ZSTD_e_end : ZSTD_e_flush, out);
  if (full) impl_->in_frame = 0;
}

void Packer::End(std::vector<std::uint8_t>& out) {
  out.clear();
  if (impl_->in_frame == 0) return;
  impl_->in_frame = 0;
  impl_->Run({}, ZSTD_e_end, out);
}

struct PackedReader::Impl {
  Impl(int descriptor, std::uint64_t file_bytes, std::string file_path)
      : fd(descriptor),
        bytes(file_bytes),
        path(std::move(file_path)),
        context(ZSTD_createDCtx()),
        input(kPackedInputBytes) {
    if (!context) throw std::bad_alloc();
  }

  /// The window holds what stands at `at` and behind it; false at the end of the file.
  bool Fill() {
    if (at < window_from + window_bytes && at >= window_from) return true;
    window_from = at;
    window_bytes = 0;
    if (at >= bytes) return false;
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(input.size(), bytes - at));
    while (window_bytes < wanted) {
      const ssize_t got = ::pread(fd, input.data() + window_bytes, wanted - window_bytes,
                                  static_cast<off_t>(at + window_bytes));
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) {
        throw BadInput(fmt::format("{}: reading at byte {} failed: {}", path, at + window_bytes,
                                   std::strerror(errno)));
      }
      if (got == 0) break;
      window_bytes += static_cast<std::size_t>(got);
    }
    return window_bytes > 0;
  }

  std::size_t Read(std::span<std::uint8_t> to) {
    std::size_t filled = 0;
    while (filled < to.size()) {
      const bool more = Fill();
      const auto start = static_cast<std::size_t>(at - window_from);
      ZSTD_inBuffer in{input.data() + start, more ? window_bytes - start : 0, 0};
      ZSTD_outBuffer out{to.data() + filled, to.size() - filled, 0};
      const std::size_t left = ZSTD_decompressStream(context.get(), &out, &in);
      at += in.pos;
      filled += out.pos;
      Count(out.pos);
      if (ZSTD_isError(left) != 0) {
        LeaveFrame();
        continue;
      }
      if (in.pos > 0) inside = true;
      if (left == 0 && inside) {
        inside = false;
        frame_from = at;
      }
      if (!more && out.pos == 0) break;
    }
    return filled;
  }

  void Count(std::size_t unpacked) {
    given += unpacked;
    if (given <= kMostRatio * bytes + kAlwaysAllowed) return;
    throw BadInput(fmt::format(
        "{}: not a session: its {} bytes unpack to more than {}, and no session packs so well",
        path, bytes, kMostRatio * bytes));
  }

  /// Behind damage: to the next place where a frame begins, or to the end of the file.
  void LeaveFrame() {
    if (bad_frames++ == 0) first_bad = given;
    ZSTD_DCtx_reset(context.get(), ZSTD_reset_session_only);
    inside = false;
    const std::uint64_t back = std::max(frame_from + 1, at - std::min(at, kMostBlockBytes));
    if (again <= kMostReadings * bytes && back < at) {
      again += at - back;
      at = back;
    }
    // Of a frame whose header it does not understand zstd takes not one byte.
    at = std::max(at, frame_from + 1);
    for (; Fill(); ++at) {
      const auto start = static_cast<std::size_t>(at - window_from);
      const void* first = std::memchr(input.data() + start, kFrameMagic[0], window_bytes - start);
      if (first == nullptr) {
        at = window_from + window_bytes - 1;
        continue;
      }
      at = window_from +
           static_cast<std::uint64_t>(static_cast<const std::uint8_t*>(first) - input.data());
      if (MagicHere()) break;
    }
    frame_from = at;
  }

  bool MagicHere() {
    if (window_from + window_bytes - at < kFrameMagic.size()) {
      window_bytes = 0;  // the word may straddle two windows
      if (!Fill()) return false;
    }
    const auto start = static_cast<std::size_t>(at - window_from);
    return window_bytes - start >= kFrameMagic.size() && IsFrameMagic(input.data() + start);
  }

  void Rewind() {
    ZSTD_DCtx_reset(context.get(), ZSTD_reset_session_only);
    at = frame_from = 0;
    given = bad_frames = first_bad = again = 0;
    inside = false;
  }

  int fd;
  std::uint64_t bytes;
  std::string path;
  std::unique_ptr<ZSTD_DCtx, FreeZstd> context;
  std::vector<std::uint8_t> input;
  std::uint64_t window_from{0};
  std::size_t window_bytes{0};
  std::uint64_t at{0};          ///< of the file: the next byte that zstd has not taken
  std::uint64_t frame_from{0};  ///< where the frame that is being read begins
  std::uint64_t given{0};       ///< bytes unpacked, those of damaged frames too
  std::uint64_t bad_frames{0};
  std::uint64_t first_bad{0};
  std::uint64_t again{0};  ///< bytes read more than once
  bool inside{false};      ///< a frame has begun and not ended
};

PackedReader::PackedReader(int fd, std::uint64_t bytes, std::string path)
    : impl_(std::make_unique<Impl>(fd, bytes, std::move(path))) {}
PackedReader::~PackedReader() = default;

std::size_t PackedReader::Read(std::span<std::uint8_t> to) { return impl_->Read(to); }
void PackedReader::Rewind() { impl_->Rewind(); }
std::uint64_t PackedReader::bad_frames() const noexcept { return impl_->bad_frames; }
std::uint64_t PackedReader::first_bad_offset() const noexcept { return impl_->first_bad; }
bool PackedReader::cut_off() const noexcept { return impl_->inside && impl_->at >= impl_->bytes; }

}  // namespace levitas::session
