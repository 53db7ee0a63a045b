#include "cli/study/laws_of_records.hpp"

#include <algorithm>
#include <optional>

#include "cli/study/free_run.hpp"
#include "common/problem.hpp"

namespace levitas::cli {
namespace {

struct Found {
  LawOfRecord of;
  std::string text;  ///< complete: tells laws of one name apart
};

std::optional<Found> FindFor(const std::string& record, const configuration::RigFile& rig) {
  try {
    auto law = LawIfKnown(record, "", rig);
    if (!law && !rig.run.controller.empty()) {
      law = LawIfKnown(record, rig.run.controller, rig);
      if (law) law->name += ", which the rig file names";
    }
    if (!law) return std::nullopt;
    configuration::ControllerFile file;
    file.law = law->law;
    return Found{*law, configuration::WriteController(file, rig.numbers)};
  } catch (const BadInput&) {  // a law that does not fit this rig is no reason to refuse a record
    return std::nullopt;
  }
}

}  // namespace

diagnosis::KnownLaws LawsOfRecords(const std::vector<std::string>& records,
                                   const configuration::RigFile& rig) {
  diagnosis::KnownLaws known;
  std::vector<std::string> texts;
  for (const std::string& record : records) {
    const auto found = FindFor(record, rig);
    if (!found) {
      known.without.push_back(record);
      continue;
    }
    const std::string text = found->of.name + '\n' + found->text;
    const auto same = std::find(texts.begin(), texts.end(), text);
    const auto at = static_cast<std::size_t>(same - texts.begin());
    if (same == texts.end()) {
      texts.push_back(text);
      known.laws.push_back({.name = found->of.name, .law = found->of.law, .records = {}});
    }
    known.laws[at].records.push_back(record);
  }
  return known;
}

}  // namespace levitas::cli
