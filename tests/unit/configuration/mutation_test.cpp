// Damaged files: each of 2000 seeded mutations of the shipped files either parses or is refused as
// bad input; what parses can be written and read back.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "common/problem.hpp"
#include "common/random.hpp"
#include "configuration/rig_file.hpp"

namespace levitas::configuration {
namespace {

std::string Text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::size_t Below(Random& random, std::size_t limit) {
  return static_cast<std::size_t>(random.Uniform() * static_cast<double>(limit));
}

/// One to four of: a byte changed, a piece removed, doubled or moved, YAML's own signs put in.
std::string Mutated(std::string text, Random& random) {
  constexpr std::string_view kSigns = "[]{}:,-#&*!|>'\"%@`\n\t ?0123456789.eE_\0\x80\xff";
  const std::size_t changes = 1 + Below(random, 4);
  for (std::size_t i = 0; i < changes && !text.empty(); ++i) {
    const std::size_t at = Below(random, text.size());
    const std::size_t length = 1 + Below(random, 40);
    switch (Below(random, 5)) {
      case 0:
        text[at] = static_cast<char>(random.Bits() & 0xFFU);
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(at, length));
        break;
      case 3:
        text.insert(Below(random, text.size()), text.substr(at, length));
        break;
      default:
        text.insert(at, 1, kSigns[Below(random, kSigns.size())]);
    }
  }
  return text;
}

template <class Parse>
void ExpectParsedOrRefused(const std::string& whole, std::uint64_t seed, int rounds,
                           Parse parse_and_write) {
  Random random(seed);
  int parsed = 0;
  for (int i = 0; i < rounds; ++i) {
    const std::string text = Mutated(whole, random);
    try {
      const std::string written = parse_and_write(text);
      EXPECT_EQ(parse_and_write(written), written) << "round " << i;
      ++parsed;
    } catch (const BadInput& problem) {
      EXPECT_NE(std::string(problem.what()).find("f:"), std::string::npos) << problem.what();
    } catch (const std::exception& other) {
      FAIL() << "round " << i << ": " << other.what() << "\n" << text;
    }
  }
  EXPECT_GT(parsed, 0);       // comments and digits may change
  EXPECT_LT(parsed, rounds);  // the reader is strict
}

TEST(Mutations, OfRigsParseOrAreRefused) {
  const auto rig = [](const std::string& text) { return WriteRig(ParseRig(text, "f")); };
  ExpectParsedOrRefused(Text(FindConfig("flexible_rotor", "rigs")), 20261121, 500, rig);
  ExpectParsedOrRefused(Text(FindConfig("ufu_rig", "rigs")), 20261122, 500, rig);
}

TEST(Mutations, OfAControllerParseOrAreRefused) {
  const RigNumbers rig = LoadRig(FindConfig("flexible_rotor", "rigs")).numbers;
  ExpectParsedOrRefused(Text(FindConfig("flexible_rotor", "controllers")), 20261123, 500,
                        [&](const std::string& text) {
                          return WriteController(ParseController(text, "f", rig), rig);
                        });
}

TEST(Mutations, OfAScenarioParseOrAreRefused) {
  const RigNumbers rig = LoadRig(FindConfig("flexible_rotor", "rigs")).numbers;
  ExpectParsedOrRefused(
      Text(FindConfig("default", "scenarios")), 20261124, 500,
      [&](const std::string& text) { return WriteScenario(ParseScenario(text, "f", rig)); });
}

TEST(Mutations, OfEveryLengthOfTruncationAreRefusedOrParse) {
  const std::string whole = Text(FindConfig("flexible_rotor", "rigs"));
  for (std::size_t length = 0; length < whole.size(); length += 7) {
    try {
      (void)ParseRig(whole.substr(0, length), "f");
    } catch (const BadInput& problem) {
      EXPECT_NE(std::string(problem.what()).find("f:"), std::string::npos) << problem.what();
    }
  }
}

}  // namespace
}  // namespace levitas::configuration
