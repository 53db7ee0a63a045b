#include "cli/study/manual/manual.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

namespace levitas::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// A command line with one of each kind of word.
struct Line {
  CLI::App app{"Levitates", "amb"};
  std::string pace{"lockstep"};
  std::string file;
  std::string hidden;
  int modes{};
  int turns{};
  bool deep{};

  Line() {
    CLI::App* run = app.add_subcommand("run", "Run | judge");
    run->add_option("SESSION", file, "What to read")->required();
    run->add_option("--pace", pace, "How fast")
        ->check(CLI::IsMember({"lockstep", "realtime"}))
        ->capture_default_str();
    run->add_option("--modes", modes, "How many")->check(CLI::Range(1, 20));
    run->add_option("--turns", turns, "Which way")
        ->transform(CLI::Transformer(std::map<std::string, int>{{"left", -1}, {"right", 1}}));
    run->add_flag("--deep", deep, ".starts with a point");
    run->add_option("--hidden", hidden, "Nobody's business")->group("");
    run->footer("  amb run x.lcm");
    run->add_subcommand("inner", "Below");
  }
};

TEST(CommandTree, HoldsCommandsOptionsValuesAndDefaults) {
  const Line line;
  const CommandText root = TreeOf(line.app);
  ASSERT_EQ(root.commands.size(), 1U);
  const CommandText& run = root.commands[0];
  EXPECT_EQ(run.path, "amb run");
  EXPECT_EQ(run.examples, "  amb run x.lcm");
  ASSERT_EQ(run.commands.size(), 1U);
  EXPECT_EQ(run.commands[0].path, "amb run inner");
  const auto find = [&](const std::string& name) {
    const auto at = std::find_if(run.options.begin(), run.options.end(),
                                 [&](const OptionText& option) { return option.name == name; });
    return at == run.options.end() ? OptionText{} : *at;
  };
  EXPECT_TRUE(find("SESSION").positional);
  EXPECT_TRUE(find("SESSION").required);
  EXPECT_THAT(find("--pace").allowed, ElementsAre("lockstep", "realtime"));
  EXPECT_THAT(find("--turns").allowed, ElementsAre("left", "right"));
  EXPECT_EQ(find("--turns").value, "{left,right}");
  EXPECT_EQ(find("--pace").preset, "lockstep");
  EXPECT_TRUE(find("--pace").takes_value);
  EXPECT_FALSE(find("--deep").takes_value);
  EXPECT_EQ(find("--modes").value, "INT");
  EXPECT_EQ(find("--modes").meaning, "How many (1 to 20)");
  EXPECT_EQ(find("--hidden").name, "");
}

TEST(Markdown, EscapesWhatWouldEndACellAndNamesDefaults) {
  const Line line;
  const std::string page = Markdown(TreeOf(line.app), {});
  EXPECT_THAT(page, HasSubstr("| `amb run` | Run \\| judge |"));
  EXPECT_THAT(page, HasSubstr("| `--pace {lockstep,realtime}` | How fast (default lockstep) |"));
  EXPECT_THAT(page, HasSubstr("| `SESSION` | What to read (needed) |"));
  EXPECT_THAT(page, HasSubstr("## amb run inner"));
  EXPECT_THAT(page, Not(HasSubstr("hidden")));
}

TEST(ManPage, EscapesWhatTroffWouldTakeForItsOwn) {
  const Line line;
  const std::string page = ManPage(TreeOf(line.app), "1.2.3");
  EXPECT_THAT(page, testing::StartsWith(".TH AMB 1 \"\" \"levitas 1.2.3\""));
  EXPECT_THAT(page, HasSubstr("\\fB\\-\\-deep\\fR"));
  EXPECT_THAT(page, HasSubstr("\n\\&.starts with a point"));
}

TEST(BashCompletion, KnowsWordsOfEachCommandAndValuesOfOptions) {
  const Line line;
  const std::string script = BashCompletion(TreeOf(line.app), {});
  EXPECT_THAT(script, HasSubstr("['amb']='run -h --help'"));
  EXPECT_THAT(script, HasSubstr("['amb run --pace']='lockstep realtime'"));
  EXPECT_THAT(script, Not(HasSubstr("amb run --deep']")));
}

}  // namespace
}  // namespace levitas::cli
