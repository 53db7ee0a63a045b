#pragma once
// Lines of a text file, plain or compressed by xz (read through `xz -dc`).
//
// Line ends  LF, CRLF and a last line without an end; a UTF-8 byte order mark is dropped.
// Limits     a line of 1 MiB and 64 GiB in all, unpacked: a device or a small file that unpacks to
//            an endless one is refused and never held in memory.
// Failure    BadInput: not there, not readable, too long, xz not installed or its data damaged.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace levitas::session {

class LineSource {
 public:
  /// Of a row of any number of channels, and of a day at 10 kHz and more.
  struct Limits {
    std::size_t line{std::size_t{1} << 20};
    std::uint64_t bytes{std::uint64_t{64} << 30};
  };
  explicit LineSource(const std::string& path);
  LineSource(const std::string& path, const Limits& limits);
  ~LineSource();
  LineSource(const LineSource&) = delete;
  LineSource& operator=(const LineSource&) = delete;

  /// False at the end. `line` has no line end and is valid until the next call.
  [[nodiscard]] bool Next(std::string_view& line);
  /// Of the line last given, from 1.
  [[nodiscard]] std::uint64_t line_number() const noexcept { return line_number_; }

 private:
  /// Reads on; false at the end.
  bool Fill();
  void OpenCompressed();
  /// Collects xz's exit; throws when it failed.
  void FinishCompressed();

  std::string path_;
  std::FILE* file_{nullptr};
  int child_{-1};
  Limits limits_;
  std::string buffer_;
  std::size_t begin_{0};    ///< of the next line in it
  std::uint64_t bytes_{0};  ///< read so far, unpacked
  std::uint64_t line_number_{0};
};

}  // namespace levitas::session
