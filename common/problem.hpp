#pragma once
// A problem told to a person: where, what was found, what is allowed, what to do.
// Thrown outside the control cycle only; programs turn it into one message and an exit status.

#include <stdexcept>
#include <string>

namespace levitas {

/// Exit statuses of every command (contract with users' scripts).
enum class ExitStatus : int {
  kDone = 0,
  kOther = 1,
  kUsage = 2,
  kBadInput = 3,
  kTripped = 4,
  kNotMet = 5  ///< what --require asked
};

class Problem : public std::runtime_error {
 public:
  Problem(ExitStatus status, const std::string& text) : std::runtime_error(text), status_(status) {}
  [[nodiscard]] ExitStatus status() const noexcept { return status_; }

 private:
  ExitStatus status_;
};

/// A file that cannot be used as it is (exit status 3).
class BadInput : public Problem {
 public:
  explicit BadInput(const std::string& text) : Problem(ExitStatus::kBadInput, text) {}
};

}  // namespace levitas
