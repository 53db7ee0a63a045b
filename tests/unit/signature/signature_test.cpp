// The generated document of the effects, and that every effect has a picture that shows it.
#include "report/signature/signature.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "plant_sim/plant/plant_model.hpp"
#include "tests/support/paths.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::signature {
namespace {

const plant::PlantParameters& Rig() {
  static const plant::PlantParameters rig = [] {
    auto config = test::FlexibleRotor();
    config.period_ns = 100'000;
    return plant::Reduce(config);
  }();
  return rig;
}

TEST(EffectsDocument, IsTheOneInDocs) {
  std::ifstream file(test::SourceFolder() + "/docs/effects.md");
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), EffectsDocument())
      << "write it anew: amb effects --document docs/effects.md";
}

TEST(EffectsDocument, NamesEveryEffectWithItsPicture) {
  const std::string text = EffectsDocument();
  for (const effect::Row& row : effect::Catalogue()) {
    EXPECT_NE(text.find("## `" + std::string(row.name) + "`"), std::string::npos) << row.name;
    if (row.place == effect::Place::kGear) continue;
    const std::string picture = "pictures/effects/" + std::string(row.name) + ".svg";
    EXPECT_NE(text.find(picture), std::string::npos);
    EXPECT_TRUE(std::ifstream(test::SourceFolder() + "/docs/" + picture).good()) << picture;
  }
}

TEST(Pictures, ShowEveryEffectBesideTheNominalRig) {
  for (const effect::Row& row : effect::Catalogue()) {
    if (row.place == effect::Place::kGear) continue;
    const svg::Figure figure = Picture(Rig(), ClearOn(Rig(), row.id));
    ASSERT_EQ(figure.panels.size(), 2U) << row.name;
    const auto& series = figure.panels[0].series;
    ASSERT_GE(series.size(), 2U) << row.name;
    double largest = 0.0;
    double difference = 0.0;
    for (std::size_t i = 0; i < series[0].y.size(); ++i) {
      ASSERT_TRUE(std::isfinite(series[0].y[i]) && std::isfinite(series[1].y[i])) << row.name;
      largest = std::max(largest, std::abs(series[0].y[i]));
      difference = std::max(difference, std::abs(series[0].y[i] - series[1].y[i]));
      if (series.size() == 4) {  // a response: the cross response may be the one that shows
        largest = std::max(largest, std::abs(series[2].y[i]));
        difference = std::max(difference, std::abs(series[2].y[i] - series[3].y[i]));
      }
    }
    // extra_delay is all phase: nothing of it is in the gain.
    if (row.id == effect::Id::kExtraDelay) {
      EXPECT_LT(difference, 1e-9 * largest);
    } else {
      EXPECT_GT(difference, 1e-3 * largest) << row.name << " does not show";
    }
  }
}

}  // namespace
}  // namespace levitas::signature
