#pragma once
// Ctrl-C as a request to end a long search with what it has found.
//
// First    SIGINT while the guard lives is noted, and nothing else.
// Second   ends the program, as SIGTERM does the first time.
// Thread   one guard at a time, in the main thread; Asked() in any.

#include <csignal>

namespace levitas::cli {

class EarlyStop {
 public:
  EarlyStop();
  ~EarlyStop();
  EarlyStop(const EarlyStop&) = delete;
  EarlyStop& operator=(const EarlyStop&) = delete;
  EarlyStop(EarlyStop&&) = delete;
  EarlyStop& operator=(EarlyStop&&) = delete;

  [[nodiscard]] static bool Asked() noexcept;

 private:
  struct sigaction previous_ {};
};

}  // namespace levitas::cli
