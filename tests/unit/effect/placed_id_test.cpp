// The ids by place against the catalogue, and against what is none.

#include "plant_sim/effect/placed_id.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "plant_sim/effect/catalogue.hpp"

namespace levitas::effect {
namespace {

TEST(PlacedId, IsTheSameIdAtThePlaceOfItsRow) {
  for (const Row& row : Catalogue()) {
    EXPECT_EQ(PlaceOf(row.id), row.place) << row.name;
    EXPECT_EQ(std::visit([](auto id) { return IdOf(id); }, Placed(row.id)), row.id) << row.name;
  }
}

TEST(PlacedId, RefusesWhatIsNoEffect) {
  EXPECT_THROW(static_cast<void>(Placed(static_cast<Id>(200))), std::logic_error);
}

}  // namespace
}  // namespace levitas::effect
