#pragma once
// What a program tells people on standard error, without ever being held up or ended by it.
//
// Path      Say copies the text into a bounded queue; a thread of its own writes it with write(2),
//           in pieces of whole lines of at most PIPE_BUF bytes. Whoever reads may be slow (a
//           stopped terminal, a pager), gone (a closed pipe) or full (a disk): the caller goes on.
// Lost      lines that found the queue full, that the file refused, or that exceed the budget of a
//           log are counted, and the count is said as soon as text is taken again.
// Budget    a regular file takes kLogBytes from one program, and the last report on top of it.
// Safe      control characters are written as \x1b, so that a text from the network can neither
//           steer a terminal nor, since a line break is followed by an indent in what callers pass
//           on, pretend to be a line of ours.
// End       Flush waits as long as text is taken, for at most kEndWait in all, and for at most
//           kStallWait when nobody takes it. A writer that hangs in the kernel ends with the
//           process.
// Thread    any but the loop's: it locks for the length of a copy and may allocate.
// Failure   none: never throws, never ends the program (also not by SIGPIPE or SIGXFSZ).

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace levitas::rt {

class Speaker {
 public:
  static constexpr std::size_t kRoomBytes = std::size_t{128} << 10;
  static constexpr std::size_t kLongestLine = 3000;  ///< the rest of a line is cut, and said to be
  static constexpr std::uint64_t kLogBytes = std::uint64_t{16} << 20;
  static constexpr std::chrono::milliseconds kStallWait{200};
  static constexpr std::chrono::milliseconds kEndWait{5000};

  enum class Kind : std::uint8_t {
    kLines,   ///< whole lines; the last line break is added where it lacks
    kPart,    ///< as it is, "\r" included: a line that is drawn again and again
    kReport,  ///< as kLines, and passes also when the log's budget is used up
  };

  /// Does not own `file`. The writing thread starts with the first text.
  explicit Speaker(int file, std::uint64_t log_bytes = kLogBytes);
  /// Flush.
  ~Speaker();
  Speaker(const Speaker&) = delete;
  Speaker& operator=(const Speaker&) = delete;

  void Post(std::string_view text, Kind kind = Kind::kLines) noexcept;
  /// True: everything has been handed to the kernel.
  bool Flush() noexcept;
  /// Lines so far.
  [[nodiscard]] std::uint64_t lost() const noexcept;

 private:
  struct State;
  std::shared_ptr<State> state_;  ///< shared with the writer, which may outlive this object
};

/// The text with control characters as \x1b; line breaks and tabs stay, and so does sound UTF-8.
[[nodiscard]] std::string Printable(std::string_view text);
/// As Printable, with an indent after each line break: what others wrote, within a line of ours.
[[nodiscard]] std::string Quoted(std::string_view text);
/// As Printable, with line breaks and tabs as \x0a and \x09 too: a name or a tag of others, which
/// then can be no row of its own in a table of ours.
[[nodiscard]] std::string OneLine(std::string_view text);

/// To standard error.
void Say(std::string_view text, Speaker::Kind kind = Speaker::Kind::kLines) noexcept;
/// Before the end of the program: false when somebody does not take what is left.
bool FlushSaid() noexcept;

/// Opens /dev/null for each of standard input, output and error that is closed: else the next file
/// or socket would get its number, and texts would go there. First thing in main.
void OpenStandardFiles() noexcept;

}  // namespace levitas::rt
