#include "common/enums.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include "tests/support/paths.hpp"

namespace levitas {
namespace {

template <class Enum>
void ExpectDistinctNames(std::uint8_t count) {
  std::set<std::string_view> names;
  for (std::uint8_t i = 0; i < count; ++i) names.insert(Name(static_cast<Enum>(i)));
  EXPECT_EQ(names.size(), count);
  EXPECT_FALSE(names.contains("invalid"));
  EXPECT_EQ(Name(static_cast<Enum>(count)), "invalid");
}

TEST(Enums, EveryValueHasItsOwnNameAndOnlyThose) {
  ExpectDistinctNames<Mode>(kModeCount);
  ExpectDistinctNames<Fault>(kFaultCount);
  ExpectDistinctNames<OperatorCommand>(kOperatorCommandCount);
}

// "1 lift 2 spin ..." of a field's comment in a message file: what other programs go by.
template <class Enum>
void ExpectDocumentedNumbers(const std::string& file, const std::string& field, int count) {
  std::ifstream in(levitas::test::SourceFolder() + "/lcmtypes/" + file);
  std::string line;
  int found = 0;
  while (std::getline(in, line)) {
    if (line.find("int8_t " + field + ";") == std::string::npos) continue;
    std::istringstream words(line.substr(line.find("[enum]") + 6));
    int number = 0;
    for (std::string name; words >> number >> name; ++found) {
      EXPECT_EQ(Name(static_cast<Enum>(number)), name) << file;
    }
  }
  EXPECT_EQ(found, count) << file << " " << field;
}

TEST(Enums, HaveTheNumbersThatTheMessageFilesTellOtherPrograms) {
  ExpectDocumentedNumbers<Mode>("controller_state_t.lcm", "mode", kModeCount);
  ExpectDocumentedNumbers<OperatorCommand>("operator_command_t.lcm", "command",
                                           kOperatorCommandCount - 1);  // 0 is no command
}

}  // namespace
}  // namespace levitas
