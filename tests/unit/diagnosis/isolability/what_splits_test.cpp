// When an experiment leaves a fault better off: all pairs of what was foretold before and after.

#include "diagnosis/isolability/what_splits.hpp"

#include <gtest/gtest.h>

namespace levitas::diagnosis {
namespace {

Prediction IsolatedAs(Isolation isolation, std::size_t ties = 0) {
  Prediction p;
  p.isolation = isolation;
  p.ties.assign(ties, effect::Id::kUnbalance);
  return p;
}

TEST(Splits, WhatBecomesVisibleIsBetterOffAndWhatIsHiddenNeverIs) {
  const Prediction hidden = IsolatedAs(Isolation::kNotVisible);
  for (const Isolation other : {Isolation::kFound, Isolation::kTied, Isolation::kTakenFor}) {
    EXPECT_TRUE(Splits(hidden, IsolatedAs(other, 3)));
    EXPECT_FALSE(Splits(IsolatedAs(other, 3), hidden));
  }
  EXPECT_FALSE(Splits(hidden, hidden));
}

TEST(Splits, ATieIsBetterOffWithFewerOfItsKindOrAloneOnly) {
  const Prediction tied = IsolatedAs(Isolation::kTied, 2);
  EXPECT_TRUE(Splits(tied, IsolatedAs(Isolation::kTied, 1)));
  EXPECT_TRUE(Splits(tied, IsolatedAs(Isolation::kFound)));
  EXPECT_FALSE(Splits(tied, IsolatedAs(Isolation::kTied, 2)));
  EXPECT_FALSE(Splits(tied, IsolatedAs(Isolation::kTied, 3)));
  EXPECT_FALSE(Splits(tied, IsolatedAs(Isolation::kTakenFor, 1)));
}

TEST(Splits, WhatWasTakenForAnotherIsBetterOffOnceItIsNamedItself) {
  const Prediction taken = IsolatedAs(Isolation::kTakenFor, 1);
  EXPECT_TRUE(Splits(taken, IsolatedAs(Isolation::kTied, 4)));
  EXPECT_TRUE(Splits(taken, IsolatedAs(Isolation::kFound)));
  EXPECT_FALSE(Splits(IsolatedAs(Isolation::kTakenFor, 2), taken)) << "still another is named";
}

TEST(Splits, WhatIsNamedAloneCannotBeBetterOff) {
  const Prediction found = IsolatedAs(Isolation::kFound);
  for (const Isolation after : {Isolation::kFound, Isolation::kTied, Isolation::kTakenFor}) {
    EXPECT_FALSE(Splits(found, IsolatedAs(after)));
  }
}

}  // namespace
}  // namespace levitas::diagnosis
