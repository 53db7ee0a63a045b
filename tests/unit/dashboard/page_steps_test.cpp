// The page offers the commands that the mode table takes, and no others.

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "common/enums.hpp"
#include "controller/supervisor/mode_table.hpp"
#include "dashboard/page_files.hpp"

namespace levitas::dashboard {
namespace {

using Commands = std::map<std::string, std::set<std::string>>;

/// "  mode: ["command", ...]," of the page's own table.
Commands OfThePage() {
  const std::string text(FindPageFile("/steps.js")->content);
  const std::size_t begin = text.find("const ALLOWED = {");
  const std::string table = text.substr(begin, text.find("};", begin) - begin);
  const std::regex row(R"re((\w+): \[([^\]]*)\])re");
  const std::regex word(R"re(\w+)re");
  Commands commands;
  for (std::sregex_iterator it(table.begin(), table.end(), row), end; it != end; ++it) {
    std::set<std::string>& offered = commands[(*it)[1]];
    const std::string list = (*it)[2];
    for (std::sregex_iterator one(list.begin(), list.end(), word); one != end; ++one) {
      offered.insert(one->str());
    }
  }
  return commands;
}

Commands OfTheModeTable() {
  using supervisor::Event;
  const std::map<Event, const char*> names{{Event::kCommandLift, "lift"},
                                           {Event::kCommandSpin, "spin"},
                                           {Event::kCommandCoastDown, "coast_down"},
                                           {Event::kCommandLand, "land"},
                                           {Event::kCommandReset, "reset"}};
  Commands commands;
  for (const auto& state : supervisor::kStates) {
    std::set<std::string>& taken = commands[std::string(Name(state.mode))];
    for (const auto& edge : supervisor::kEdges) {
      const auto name = names.find(edge.event);
      if (edge.from == state.state && name != names.end()) taken.insert(name->second);
    }
  }
  return commands;
}

TEST(PageSteps, OfferWhatTheModeTableTakes) {
  EXPECT_EQ(OfThePage().size(), 8U);  // modes: the search itself works
  EXPECT_EQ(OfThePage(), OfTheModeTable());
}

TEST(PageSteps, NameANextStepForEveryMode) {
  const std::string text(FindPageFile("/steps.js")->content);
  const std::string next = text.substr(text.find("const NEXT = {"));
  for (const auto& [mode, commands] : OfTheModeTable()) {
    EXPECT_NE(next.find("\n  " + mode + ": \""), std::string::npos) << mode;
  }
}

}  // namespace
}  // namespace levitas::dashboard
