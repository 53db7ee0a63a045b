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
    // Gains and spectra are drawn on logarithmic axes: a ratio is what the eye sees there.
    const bool ratio = figure.panels[0].y_scale == svg::Scale::kLogarithmic;
    double largest = 0.0;
    double difference = 0.0;
    for (std::size_t pair = 0; pair + 1 < series.size(); pair += 2) {
      for (std::size_t i = 0; i < series[pair].y.size(); ++i) {
        const double a = series[pair].y[i];
        const double b = series[pair + 1].y[i];
        ASSERT_TRUE(std::isfinite(a) && std::isfinite(b)) << row.name;
        largest = std::max(largest, ratio ? 1.0 : std::abs(a));
        // A cross response that is zero without the effect has no ratio.
        const double change = ratio && a > 0.0 && b > 0.0 ? std::log(a / b) : a - b;
        difference = std::max(difference, std::abs(change));
      }
    }
    if (row.id == effect::Id::kExtraDelay) {
      EXPECT_LT(difference, 1e-9) << "a delay is all phase, nothing of it is in the gain";
    } else {
      EXPECT_GT(difference, 0.03 * largest) << row.name << " does not show";
    }
  }
}

}  // namespace
}  // namespace levitas::signature
