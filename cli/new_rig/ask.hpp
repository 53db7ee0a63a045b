#pragma once
// A number asked of a person on a terminal, until it is one.
//
// Failure  a usage Problem when the input ends, or after three answers that are no number in range.
// Thread   any.

#include <cstdio>
#include <string>

namespace levitas::cli {

struct Question {
  const char* option{};  ///< that answers it without being asked: "--mass-kg"
  const char* text{};    ///< "mass of all that turns [kg]"
  double low{}, high{};
};

/// Why a text is no number within the question's range; empty: it is one, in `value`.
[[nodiscard]] std::string WhyNoNumber(const Question& question, const std::string& text,
                                      double& value);

/// Asks on `out`, reads a line of `in`.
[[nodiscard]] double Ask(const Question& question, std::FILE* in, std::FILE* out);

}  // namespace levitas::cli
