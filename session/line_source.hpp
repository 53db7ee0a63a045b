#pragma once
// Lines of a text file, plain or compressed by xz (read through `xz -dc`).
//
// Line ends  LF, CRLF and a last line without an end; a UTF-8 byte order mark is dropped.
// Failure    BadInput: not there, not readable, xz not installed or the compressed data damaged.

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace levitas::session {

class LineSource {
 public:
  explicit LineSource(const std::string& path);
  ~LineSource();
  LineSource(const LineSource&) = delete;
  LineSource& operator=(const LineSource&) = delete;

  /// False at the end. `line` has no line end and is valid until the next call.
  [[nodiscard]] bool Next(std::string_view& line);
  /// Of the line last given, from 1.
  [[nodiscard]] std::uint64_t line_number() const noexcept { return line_number_; }

 private:
  void OpenCompressed();
  /// Collects xz's exit; throws when it failed.
  void FinishCompressed();

  std::string path_;
  std::FILE* file_{nullptr};
  int child_{-1};
  char* buffer_{nullptr};  ///< owned by getline
  std::size_t capacity_{0};
  std::uint64_t line_number_{0};
};

}  // namespace levitas::session
