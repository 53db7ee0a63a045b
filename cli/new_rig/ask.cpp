#include "cli/new_rig/ask.hpp"

#include <fmt/core.h>

#include <array>
#include <charconv>

#include "common/problem.hpp"

namespace levitas::cli {

std::string WhyNoNumber(const Question& question, const std::string& text, double& value) {
  const auto first = text.find_first_not_of(" \t+");
  const auto last = text.find_last_not_of(" \t\r\n");
  const bool any = first != std::string::npos && last != std::string::npos && last >= first;
  const std::string word = any ? text.substr(first, last + 1 - first) : std::string{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  const bool read = error == std::errc{} && end == word.data() + word.size() && !word.empty();
  if (read && value >= question.low && value <= question.high) return {};
  return fmt::format("found '{}', allowed: {:g} to {:g}", word, question.low, question.high);
}

double Ask(const Question& question, std::FILE* in, std::FILE* out) {
  constexpr int kMostAnswers = 3;
  for (int answer = 0; answer < kMostAnswers; ++answer) {
    fmt::print(out, "{}: ", question.text);
    std::fflush(out);
    std::array<char, 200> line{};
    if (std::fgets(line.data(), static_cast<int>(line.size()), in) == nullptr) break;
    double value = 0.0;
    const std::string why = WhyNoNumber(question, line.data(), value);
    if (why.empty()) return value;
    fmt::print(out, "  {}\n", why);
  }
  throw Problem(ExitStatus::kUsage,
                fmt::format("no {}; give it with {}", question.text, question.option));
}

}  // namespace levitas::cli
