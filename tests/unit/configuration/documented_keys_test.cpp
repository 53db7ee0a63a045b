// What is written is documented, and what is documented can be: keys, ranges and defaults of
// docs/configuration.md against files as the writer writes them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "configuration/text/documenter.hpp"
#include "tests/unit/configuration/full_samples.hpp"
#include "tests/unit/configuration/samples.hpp"

namespace levitas::configuration::test {
namespace {

struct Row {
  std::string key, unit, allowed, fallback, meaning;
};

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// The rows of all tables of five columns; a line with another number of cells is a failure.
std::vector<Row> Rows() {
  std::vector<Row> rows;
  bool in_table = false;
  for (const std::string& line : Lines(ConfigurationDocument())) {
    if (line.starts_with("| key |")) in_table = true;
    if (!line.starts_with("|")) in_table = false;
    if (!in_table || !line.starts_with("| `")) continue;
    std::vector<std::string> cells;
    std::istringstream stream(line.substr(1));
    for (std::string cell; std::getline(stream, cell, '|');) {
      const auto first = cell.find_first_not_of(' ');
      const auto last = cell.find_last_not_of(' ');
      cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
    }
    EXPECT_EQ(cells.size(), 5U) << line;
    if (cells.size() != 5) continue;
    rows.push_back(
        {cells[0].substr(1, cells[0].size() - 2), cells[1], cells[2], cells[3], cells[4]});
  }
  return rows;
}

TEST(DocumentedKeys, HaveARangeThatIsOneAndADefaultInsideIt) {
  const std::regex range("(\\S+) to (\\S+?)(, whole)?");
  std::size_t ranges = 0;
  std::size_t defaults = 0;
  for (const Row& row : Rows()) {
    EXPECT_FALSE(row.meaning.empty()) << row.key;
    EXPECT_FALSE(row.fallback.empty()) << row.key;
    std::smatch bounds;
    if (!std::regex_match(row.allowed, bounds, range)) continue;
    ++ranges;
    const double low = std::atof(bounds[1].str().c_str());
    const double high = std::atof(bounds[2].str().c_str());
    EXPECT_LT(low, high) << row.key;
    if (row.fallback == "required") continue;
    ++defaults;
    const double fallback = std::atof(row.fallback.c_str());
    EXPECT_GE(fallback, low) << row.key;
    EXPECT_LE(fallback, high) << row.key;
  }
  EXPECT_GT(ranges, 50U);  // or the expressions above match nothing
  EXPECT_GT(defaults, 10U);
}

TEST(DocumentedKeys, EndInTheUnitOfTheirColumn) {
  for (const Row& row : Rows()) {
    if (row.unit.empty()) continue;
    if (row.unit == "samples") {  // a count, no unit of a dimension
      EXPECT_TRUE(row.key.ends_with("_samples")) << row.key;
      continue;
    }
    const auto units = AllUnits();
    const bool fits = std::any_of(units.begin(), units.end(), [&](const Unit& unit) {
      return unit.symbol == row.unit && row.key.ends_with(KeyOf("", unit));
    });
    EXPECT_TRUE(fits) << row.key << " in " << row.unit;
  }
}

/// Every key of a written file, with its line.
std::map<std::string, std::string> WrittenKeys(const std::string& text) {
  std::map<std::string, std::string> keys;
  const std::regex key(" *(- )?([a-z0-9_]+):.*");
  for (const std::string& line : Lines(text)) {
    std::smatch match;
    EXPECT_TRUE(std::regex_match(line, match, key)) << line;
    if (!match.empty()) keys.emplace(match[2], line);
  }
  return keys;
}

TEST(WrittenFiles, HoldNoKeyThatIsNotDocumented) {
  const RigFile rig = FullRig();
  std::set<std::string> documented{"kind", "name"};
  for (const Row& row : Rows()) documented.insert(row.key);
  for (const std::string& bearing : rig.numbers.bearings) documented.insert(bearing);
  for (const std::string& channel : rig.numbers.channels) documented.insert(channel);
  for (const std::string& text :
       {WriteRig(rig), WriteController(FullController(rig.numbers), rig.numbers),
        WriteScenario(FullScenario(rig.numbers)), WriteScenario(EventfulScenario(rig.numbers)),
        WriteRig(ModalRig())}) {
    for (const auto& [key, line] : WrittenKeys(text)) {
      EXPECT_TRUE(documented.contains(key)) << line;
    }
  }
}

TEST(WrittenFiles, AreIndentedByTwoAndHoldNoTabsOrTrailingBlanks) {
  const RigFile rig = FullRig();
  for (const std::string& text :
       {WriteRig(rig), WriteController(FullController(rig.numbers), rig.numbers),
        WriteScenario(FullScenario(rig.numbers))}) {
    EXPECT_TRUE(text.ends_with("\n"));
    std::size_t before = 0;
    for (const std::string& line : Lines(text)) {
      ASSERT_FALSE(line.empty());
      EXPECT_EQ(line.find_first_not_of(' ') % 2, 0U) << line;
      EXPECT_EQ(line.find('\t'), std::string::npos) << line;
      EXPECT_NE(line.back(), ' ') << line;
      // One level more at most from line to line, two with the dash of a list: else the text means
      // something else.
      const std::size_t depth = line.find_first_not_of(" -") / 2;
      const std::size_t most = line.find("- ") == std::string::npos ? 1 : 2;
      EXPECT_LE(depth, before + most) << line;
      before = depth;
    }
  }
}

}  // namespace
}  // namespace levitas::configuration::test
