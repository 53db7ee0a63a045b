// The generated document of the effects, and that every effect has a picture that shows it.
#include "report/signature/signature.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <fstream>
#include <map>
#include <sstream>

#include "configuration/rig_file.hpp"
#include "plant_sim/plant/applied_effects/clear_entry.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "report/signature/orders.hpp"
#include "tests/support/geared_rigs.hpp"
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

/// One with gears for effects of teeth.
const plant::PlantParameters& RigFor(const effect::Row& row) {
  static const plant::PlantParameters geared = plant::Reduce(test::GearedRotor4());
  return row.place == effect::Place::kGear ? geared : Rig();
}

/// The picture of an effect on the rig for it, drawn once: some need a second, many times that
/// under a sanitizer.
const svg::Figure& PictureOf(const effect::Row& row) {
  static std::map<effect::Id, svg::Figure> drawn;
  const auto found = drawn.find(row.id);
  if (found != drawn.end()) return found->second;
  const plant::PlantParameters& rig = RigFor(row);
  return drawn.emplace(row.id, Picture(rig, plant::ClearOn(rig, row.id))).first->second;
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
    if (!effect::IsEntry(row)) continue;
    const std::string picture = "pictures/effects/" + std::string(row.name) + ".svg";
    EXPECT_NE(text.find(picture), std::string::npos);
    EXPECT_TRUE(std::ifstream(test::SourceFolder() + "/docs/" + picture).good()) << picture;
  }
}

TEST(EffectsDocument, HasAnEntryOfEveryEffectThatItsRigTakes) {
  std::istringstream lines(EffectsDocument());
  std::size_t entries = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("    - {id: ")) continue;
    const std::string id = line.substr(11, line.find_first_of(",}", 11) - 11);
    const effect::Row* const row = effect::Find(id);
    ASSERT_NE(row, nullptr) << id;
    ++entries;
    const bool geared = row->place == effect::Place::kGear;
    const std::string path =
        configuration::FindConfig(geared ? "geared_rotor_4dof" : "flexible_rotor", "rigs");
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf() << "\neffects:\n" << line << "\n";
    const configuration::RigFile rig = configuration::ParseRig(text.str(), path);
    ASSERT_EQ(rig.plant.effects.size(), 1U) << line;
    EXPECT_EQ(rig.plant.effects.front().id, row->id) << line;
  }
  EXPECT_EQ(entries, effect::EntryRows().size());
}

/// "force, N"; an order is a number of its own.
bool IsNamedWithUnit(const std::string& label) {
  if (label.rfind("order of ", 0) == 0) return true;
  const std::size_t comma = label.find(", ");
  return comma != std::string::npos && comma > 0 && comma + 2 < label.size();
}

TEST(Pictures, ShowEveryEffectBesideTheNominalRig) {
  for (const effect::Row& row : effect::EntryRows()) {
    const svg::Figure& figure = PictureOf(row);
    ASSERT_GE(figure.panels.size(), 2U) << row.name;
    for (const svg::Panel& panel : figure.panels) {
      EXPECT_TRUE(IsNamedWithUnit(panel.x_label)) << row.name << ": " << panel.x_label;
      EXPECT_TRUE(IsNamedWithUnit(panel.y_label)) << row.name << ": " << panel.y_label;
    }
    const auto& series = figure.panels[0].series;
    ASSERT_GE(series.size(), 2U) << row.name;
    // Gains and spectra are drawn on logarithmic axes: a ratio is what the eye sees there.
    const bool ratio = figure.panels[0].y_scale == svg::Scale::kLogarithmic;
    double largest = 0.0;
    double difference = 0.0;
    const std::size_t half = series.size() / 2;  // nominal curves first, then the effect's
    for (std::size_t pair = 0; pair < half; ++pair) {
      for (std::size_t i = 0; i < series[pair].y.size(); ++i) {
        const double a = series[pair].y[i];
        const double b = series[pair + half].y[i];
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

TEST(Pictures, ShowTheNominalCurveBelowAndBroaderThanTheEffects) {
  for (const effect::Row& row : effect::EntryRows()) {
    const auto& series = PictureOf(row).panels[0].series;
    for (std::size_t i = 0; i < series.size() / 2; ++i) {
      EXPECT_TRUE(series[i].name.starts_with("nominal")) << row.name;
      EXPECT_GT(series[i].width, 2.0 * series[i + series.size() / 2].width) << row.name;
    }
  }
}

TEST(Pictures, SayTheSizeOfTheEffectInTheUnitsOfARigFile) {
  const auto title = [](effect::Id id) { return Picture(Rig(), plant::ClearOn(Rig(), id)).title; };
  EXPECT_EQ(title(effect::Id::kSensorGain), "sensor_gain: ratio 1.1");
  EXPECT_EQ(title(effect::Id::kSensorOffset), "sensor_offset: offset 20 µm");
  // A fifth of the rig's 5000 Hz.
  EXPECT_EQ(title(effect::Id::kSensorBandwidth),
            "sensor_bandwidth: bandwidth 1000 Hz (the rig has 5000 Hz)");
}

// The second panel is about the change alone: it must not be a line at zero. The third one of a
// response is its phase, in which alone a delay shows.
TEST(Pictures, ShowWhatTheEffectChangesByItself) {
  for (const effect::Row& row : effect::EntryRows()) {
    const svg::Figure& figure = PictureOf(row);
    const bool response = row.facts.shows_in == effect::Shows::kResponse;
    const std::size_t added = row.facts.shows_in == effect::Shows::kGearMesh ? 2 : 1;
    double largest = 0.0;
    for (std::size_t panel = added; panel <= (response ? added + 1 : added); ++panel) {
      for (const svg::Series& series : figure.panels.at(panel).series) {
        for (const double y : series.y) largest = std::max(largest, std::abs(y));
      }
    }
    // 0.5 dB or degrees are seen; of spectra a hundredth of a micrometre is above their floor.
    EXPECT_GT(largest, response ? 0.5 : 0.01) << row.name;
  }
}

TEST(Pictures, OfTeethAreRefusedForARigWithoutGears) {
  EXPECT_THROW(static_cast<void>(GearPanels({Rig(), Rig()})), std::invalid_argument);
}

// A line of amplitude 3 um turning backward at order 2, over four turns.
TEST(OrderSpectrum, ShowsALineAtItsOrderWithItsAmplitude) {
  std::vector<std::complex<double>> orbit;
  for (int n = 0; n < 400; ++n) {
    orbit.push_back(std::polar(3e-6, -2.0 * 2.0 * 3.141592653589793 * n / 100.0));
  }
  const svg::Series series = OrderSpectrum(orbit, {4, 3}, "line", 0);
  ASSERT_EQ(series.x.size(), 25U);
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    EXPECT_NEAR(series.y[i], series.x[i] == -2.0 ? 3.0 : 0.0, 1e-6) << series.x[i];
  }
}

}  // namespace
}  // namespace levitas::signature
