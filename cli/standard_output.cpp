#include "cli/standard_output.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>

#include "rt/say.hpp"

namespace levitas::cli {
namespace {

ssize_t TakeBytes(void* to, const char* bytes, std::size_t size) {
  return static_cast<ssize_t>(static_cast<StandardOutput*>(to)->Take(bytes, size));
}

/// How many bytes at the end may be the beginning of one character of UTF-8 (RFC 3629, section 3).
std::size_t CutBytes(std::string_view text) {
  constexpr std::size_t kLongest = 4;
  for (std::size_t back = 1; back <= std::min(kLongest - 1, text.size()); ++back) {
    const auto byte = static_cast<unsigned char>(text[text.size() - back]);
    if ((byte & 0xc0U) == 0x80U) continue;  // within a character
    const std::size_t whole = byte >= 0xf0 ? 4 : byte >= 0xe0 ? 3 : byte >= 0xc2 ? 2 : 1;
    return whole > back ? back : 0;
  }
  return 0;
}

}  // namespace

StandardOutput::StandardOutput() : before_(stdout), descriptor_(STDOUT_FILENO) {
  const cookie_io_functions_t calls{
      .read = nullptr, .write = TakeBytes, .seek = nullptr, .close = nullptr};
  stream_ = ::fopencookie(this, "w", calls);
  if (stream_ == nullptr) return;
  std::setvbuf(stream_, nullptr, ::isatty(STDOUT_FILENO) == 1 ? _IOLBF : _IOFBF, BUFSIZ);
  stdout = stream_;
}

StandardOutput::~StandardOutput() { Finish(); }

void StandardOutput::GiveWayToData() noexcept {
  std::fflush(stdout);
  descriptor_ = STDERR_FILENO;
}

const std::string& StandardOutput::Finish() noexcept {
  if (stream_ != nullptr) {
    // NOLINTNEXTLINE(cppcoreguidelines-owning-memory): this class owns it
    std::fclose(stream_);
    if (!cut_.empty()) Put(rt::Printable(cut_));
    stream_ = nullptr;
    stdout = before_;
  }
  return refused_;
}

std::size_t StandardOutput::Take(const char* bytes, std::size_t size) noexcept {
  try {
    std::string text = cut_;
    text.append(bytes, size);
    const std::size_t cut = CutBytes(text);
    cut_ = text.substr(text.size() - cut);
    text.erase(text.size() - cut);
    Put(rt::Printable(text));
  } catch (const std::exception&) {
    refused_ = "not enough memory";
  }
  return size;  // Finish tells of what was refused: the C library would only try again
}

void StandardOutput::Put(const std::string& shown) noexcept {
  for (std::size_t done = 0; done < shown.size() && !gone_;) {
    const ssize_t wrote = ::write(descriptor_, shown.data() + done, shown.size() - done);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote > 0) {
      done += static_cast<std::size_t>(wrote);
      continue;
    }
    pollfd wait{.fd = descriptor_, .events = POLLOUT, .revents = 0};
    if (wrote < 0 && errno == EAGAIN && ::poll(&wait, 1, -1) > 0) continue;  // a pipe's other end
    gone_ = true;
    if (errno != EPIPE) refused_ = std::strerror(wrote < 0 ? errno : ENOSPC);
  }
}

}  // namespace levitas::cli
