#include "configuration/law_notes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace levitas::configuration {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

law::LawConfig LawOf(bool discrete, std::vector<std::pair<double, double>> poles) {
  law::LawConfig law;
  law.state_space.emplace();
  law.state_space->axes = 1;
  law.state_space->discrete = discrete;
  for (const auto& [real, imaginary] : poles) {
    law::ModalBlock block;
    block.pole_real = real;
    block.pole_imaginary = imaginary;
    block.first_input[0] = block.first_output[0] = 1.0;
    law.state_space->blocks.push_back(block);
  }
  return law;
}

TEST(LawNotes, NamesAnUnstableBlockWithItsPole) {
  EXPECT_THAT(LawNotes(LawOf(true, {{0.5, 0.0}, {0.9, 0.5}})),
              ElementsAre("block 2 of the law is unstable by itself (pole z = 0.9 +- 0.5j): only "
                          "the loop holds it"));
  EXPECT_THAT(LawNotes(LawOf(false, {{3.0, 0.0}})),
              ElementsAre("block 1 of the law is unstable by itself (pole s = 3 1/s): only the "
                          "loop holds it"));
}

TEST(LawNotes, CallsAPoleAtOneAnIntegratorAndOneOnTheCircleUnstable) {
  EXPECT_THAT(LawNotes(LawOf(true, {{1.0, 0.0}, {0.5, 0.0}})),
              ElementsAre("1 block of the law integrates"));
  EXPECT_THAT(LawNotes(LawOf(false, {{0.0, 0.0}, {-2.0, 5.0}})),
              ElementsAre("1 block of the law integrates"));
  EXPECT_EQ(LawNotes(LawOf(true, {{-1.0, 0.0}})).size(), 1U);
}

TEST(LawNotes, SaysNothingOfALawThatDecays) {
  EXPECT_THAT(LawNotes(LawOf(true, {{0.999, 0.0}, {0.6, 0.7}})), IsEmpty());
  EXPECT_THAT(LawNotes(law::LawConfig{}), IsEmpty());
}

}  // namespace
}  // namespace levitas::configuration
