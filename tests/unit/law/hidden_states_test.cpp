// Growing states that nothing shows, against laws whose answer is plain.

#include "controller/law/hidden_states.hpp"

#include <gtest/gtest.h>

namespace levitas::law {
namespace {

ModalBlock Block(double re, double im, double input, double output) {
  ModalBlock block;
  block.pole_real = re;
  block.pole_imaginary = im;
  block.first_input = {input, 0.5 * input};
  block.first_output = {output, -2.0 * output};
  return block;
}

StateSpaceConfig Law(std::vector<ModalBlock> blocks, bool discrete = false) {
  StateSpaceConfig law;
  law.axes = 2;
  law.discrete = discrete;
  law.blocks = std::move(blocks);
  return law;
}

TEST(GrowingBlocks, AreThoseOnOrBeyondTheBoundaryOfStability) {
  const auto found =
      GrowingBlocks(Law({Block(-1.0, 0.0, 1, 1), Block(0.0, 0.0, 1, 1), Block(2.0, 300.0, 1, 1)}));
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].block, 1U);
  EXPECT_EQ(found[1].block, 2U);
  const auto in_z = GrowingBlocks(
      Law({Block(0.8, 0.59, 1, 1), Block(0.8, 0.6, 1, 1), Block(-1.0, 0.0, 1, 1)}, true));
  ASSERT_EQ(in_z.size(), 2U);  // 0.8^2 + 0.6^2 = 1
  EXPECT_EQ(in_z[0].block, 1U);
}

TEST(GrowingBlocks, AreHiddenWithoutOutputsOrInputs) {
  const auto found =
      GrowingBlocks(Law({Block(500.0, 0.0, 1, 0), Block(500.0, 9.0, 0, 1), Block(1.0, 0.0, 1, 1)}));
  ASSERT_EQ(found.size(), 3U);
  EXPECT_FALSE(found[0].seen);
  EXPECT_TRUE(found[0].reached);
  EXPECT_TRUE(found[1].seen);
  EXPECT_FALSE(found[1].reached);
  EXPECT_TRUE(found[2].seen && found[2].reached);
}

// Two states of one pole that the outputs show only as a sum: their difference is hidden.
TEST(GrowingBlocks, OfOnePoleAreHiddenWhenTheirColumnsPointTheSameWay) {
  const auto same = GrowingBlocks(Law({Block(3.0, 0.0, 1, 1), Block(3.0, 0.0, 1, -4)}));
  ASSERT_EQ(same.size(), 2U);
  EXPECT_TRUE(same[0].seen);
  EXPECT_FALSE(same[1].seen);
  ModalBlock other = Block(3.0, 0.0, 1, 1);
  other.first_output = {1.0, 1.0};
  other.first_input = {1.0, -1.0};
  const auto apart = GrowingBlocks(Law({Block(3.0, 0.0, 1, 1), other}));
  EXPECT_TRUE(apart[1].seen);
  EXPECT_TRUE(apart[1].reached);
}

// Of a pair, (1, j) times anything complex is the same direction: turned by a quarter it hides too.
TEST(GrowingBlocks, OfOnePairAreComparedAsComplexColumns) {
  const ModalBlock first = Block(3.0, 50.0, 1, 1);
  ModalBlock turned = first;
  std::swap(turned.first_output, turned.second_output);
  ModalBlock mixed = first;
  mixed.second_output = {1.0, 1.0};
  EXPECT_FALSE(GrowingBlocks(Law({first, turned}))[1].seen);
  EXPECT_TRUE(GrowingBlocks(Law({first, mixed}))[1].seen);
}

}  // namespace
}  // namespace levitas::law
