#pragma once
// What a command prints on standard output, for as long as an object of this class lives: the C
// stream `stdout` is then one of ours, and every print of every command goes through it.
//
// Safe     control characters are written as \x1b (rt/say.hpp: Printable): a file name,
//          a tag or a session of others cannot steer the terminal. Line breaks and tabs stay, so a
//          foreign name in a table of ours still needs rt::OneLine.
// Checked  the first refusal of the kernel is kept: a full disk is told by Finish, once, at the
//          end of the program. A reader that has gone (EPIPE, as with `| head`) is no failure.
// Not      what is written to /dev/stdout by its name as a file (--csv /dev/stdout): those bytes
//          are data. Standard error: rt/say.hpp.
// Thread   one object in the program, made and ended in main before other threads and after them.
// Failure  none is thrown; without the memory for the stream, `stdout` stays as it was.

#include <cstdio>
#include <string>

namespace levitas::cli {

class StandardOutput {
 public:
  StandardOutput();
  /// Finish.
  ~StandardOutput();
  StandardOutput(const StandardOutput&) = delete;
  StandardOutput& operator=(const StandardOutput&) = delete;

  /// From now on the text goes to standard error: standard output is for data (--json -).
  void GiveWayToData() noexcept;

  /// Writes what is left and gives `stdout` back. What the kernel said when it refused something;
  /// empty: everything was taken. Called again it says the same.
  const std::string& Finish() noexcept;

  /// How the stream's writer is called back by the C library.
  std::size_t Take(const char* bytes, std::size_t size) noexcept;

 private:
  void Put(const std::string& shown) noexcept;

  std::FILE* before_;
  std::FILE* stream_{};
  int descriptor_;
  std::string cut_;  ///< the beginning of a character of UTF-8 whose rest is still to come
  std::string refused_;
  bool gone_{};  ///< nothing is taken any more
};

}  // namespace levitas::cli
