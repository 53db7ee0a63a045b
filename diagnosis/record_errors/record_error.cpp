#include "diagnosis/record_errors/record_error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

namespace levitas::diagnosis {
const char* Name(RecordErrorKind kind) noexcept {
  constexpr std::array kNames{"swapped", "reversed", "unit",    "rate", "quantised",
                              "clipped", "held",     "delayed", "gaps"};
  return kNames.at(static_cast<std::size_t>(kind));
}

std::vector<std::string> RecordErrorSentences(const std::vector<RecordErrors>& found) {
  std::vector<std::pair<std::string, std::vector<std::string>>> said;
  for (const RecordErrors& record : found) {
    for (const RecordError& error : record.errors) {
      const std::string text = fmt::format("{}. To mend it: {}.", error.sentence, error.mend);
      const auto same =
          std::ranges::find_if(said, [&](const auto& entry) { return entry.first == text; });
      if (same == said.end()) {
        said.push_back({text, {record.record}});
      } else {
        same->second.push_back(record.record);
      }
    }
  }
  std::vector<std::string> sentences;
  for (const auto& [text, records] : said) {
    sentences.push_back(fmt::format("Error of the record {}: {}", fmt::join(records, ", "), text));
  }
  return sentences;
}

}  // namespace levitas::diagnosis
