#include "diagnosis/record_errors/record_error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace levitas::diagnosis {
namespace {

struct Said {
  const char* heading{};
  std::string text;
  std::vector<std::string> records;
};

}  // namespace

const char* Name(RecordErrorKind kind) noexcept {
  constexpr std::array kNames{"swapped", "reversed", "unit",    "rate", "quantised",
                              "clipped", "held",     "delayed", "gaps", "other_rig"};
  return kNames.at(static_cast<std::size_t>(kind));
}

const char* AfterRecordErrors(const std::vector<RecordErrors>& found) noexcept {
  const bool remarks_only = std::ranges::all_of(found, [](const RecordErrors& record) {
    return std::ranges::all_of(record.errors,
                               [](const RecordError& error) { return IsRemark(error.kind); });
  });
  return remarks_only ? "What follows takes the rig file for the right one."
                      : "What follows is of the records as mended, where that can be done here; "
                        "mend the files first.";
}

std::vector<std::string> RecordErrorSentences(const std::vector<RecordErrors>& found) {
  std::vector<Said> all;
  for (const RecordErrors& record : found) {
    for (const RecordError& error : record.errors) {
      const bool remark = IsRemark(error.kind);
      const std::string text =
          fmt::format("{}. {}: {}.", error.sentence, remark ? "If so" : "To mend it", error.mend);
      const auto same = std::ranges::find(all, text, &Said::text);
      if (same == all.end()) {
        all.push_back({remark ? "Doubt about" : "Error of", text, {record.record}});
      } else {
        same->records.push_back(record.record);
      }
    }
  }
  std::vector<std::string> sentences;
  for (const Said& said : all) {
    sentences.push_back(fmt::format("{} the record {}: {}", said.heading,
                                    fmt::join(said.records, ", "), said.text));
  }
  return sentences;
}

}  // namespace levitas::diagnosis
