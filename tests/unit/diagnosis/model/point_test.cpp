// Terms at a point: members of a family with the shape that the point says, all others as they are.

#include "diagnosis/model/point.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "plant_sim/effect/catalogue.hpp"
#include "tests/unit/diagnosis/moments.hpp"

namespace levitas::diagnosis {
namespace {

constexpr double kOtherSlew = 2345.0;  // [A/s] between two members

class PointTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::size_t Slew() const {
    const auto slew = std::find_if(table_.begin(), table_.end(), [](const Term& term) {
      return term.effect == effect::Id::kAmplifierSlew;
    });
    return static_cast<std::size_t>(slew - table_.begin());
  }
  /// Where one slew limit is another one.
  [[nodiscard]] Point Moved() const {
    Point point = file_;
    point.shapes[Slew()] = {kOtherSlew};
    return point;
  }

  const std::vector<Term> table_ = AllTerms(TheRig(), Tolerances{}, 50e-6);
  const Point file_ = PointAt(table_, std::vector<double>(table_.size(), 0.0));
};

TEST_F(PointTest, HasTheShapesOfTheTableAndNoneForATermOfNoFamily) {
  ASSERT_EQ(file_.shapes.size(), table_.size());
  for (std::size_t i = 0; i < table_.size(); ++i) {
    EXPECT_EQ(file_.shapes[i], table_[i].family.shape);
    EXPECT_EQ(file_.shapes[i].empty(), !table_[i].family.member);
  }
}

TEST_F(PointTest, IsAnotherOneWhereAParameterOrAShapeIs) {
  EXPECT_EQ(file_, PointAt(table_, file_.theta));
  EXPECT_NE(file_, Moved());
  Point other = file_;
  other.theta.front() = 1.0;
  EXPECT_NE(file_, other);
}

TEST_F(PointTest, OfTheTablesShapesCopiesNothing) {
  EXPECT_EQ(&TermsAt(table_, file_).terms(), &table_);
}

TEST_F(PointTest, PutsTheMemberOfAnotherShapeInItsPlaceAndLeavesTheTable) {
  const TermsAt at(table_, Moved());
  ASSERT_EQ(at.terms().size(), table_.size());
  for (std::size_t i = 0; i < table_.size(); ++i) {
    const std::string& name = at.terms()[i].location.name;
    EXPECT_EQ(name, i == Slew() ? "2345 A/s" : table_[i].location.name);
    EXPECT_EQ(TermAt(table_, Moved(), i).location.name, name);
  }
  EXPECT_EQ(table_[Slew()].family.shape, file_.shapes[Slew()]);
}

}  // namespace
}  // namespace levitas::diagnosis
