// A rig whose probes and coils are wired the other way round: its files have other signs, and the
// diagnosis sees the same rotor.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iomanip>

#include "diagnosis/model/model_run.hpp"
#include "diagnosis/records/load.hpp"
#include "tests/unit/diagnosis/moments.hpp"

namespace levitas::diagnosis {
namespace {

constexpr int kRunRows = 300;

class ReversedRig : public ::testing::Test {
 protected:
  ReversedRig() {
    std::filesystem::create_directories(folder_);
    reversed_.plant.sensor_polarity[1] = reversed_.numbers.sensor_polarity[1] = -1.0;
    reversed_.plant.actuator_polarity[2] = reversed_.numbers.actuator_polarity[2] = -1.0;
    Write("straight.csv", 1.0, 1.0);
    Write("wired.csv", -1.0, -1.0);
  }
  ~ReversedRig() override { std::filesystem::remove_all(folder_); }

  /// The same small motion; `probe` is the sign of de_y, `coils` that of nde_x.
  void Write(const std::string& name, double probe, double coils) const {
    std::ofstream file(folder_ / name);
    file << "time_s,rotor_angle_rad";
    for (const char* kind : {"position", "control_current"}) {
      for (const auto& channel : FlexibleRotor().numbers.channels) {
        file << "," << kind << "_" << channel << (*kind == 'p' ? "_m" : "_a");
      }
    }
    Random random(1);
    file << std::setprecision(17);
    for (int n = 0; n < kRunRows; ++n) {
      file << "\n" << n * 1e-4 << ",0";
      for (int column = 0; column < 8; ++column) {
        const double sign = column == 1 ? probe : column == 6 ? coils : 1.0;
        file << "," << sign * (column < 4 ? 1e-6 : 0.1) * random.Normal();
      }
    }
    file << "\n";
  }

  [[nodiscard]] static std::vector<SamplePoint> Run(const configuration::RigFile& rig,
                                                    const Record& record) {
    const RigView view(rig.numbers, rig.plant);
    const auto gain = std::make_shared<const analysis::ObserverGain>(
        analysis::DesignObserver(view.model->config(), {}));
    return RunModel(view, record, {gain, {{0, gain}}}, {}, {}, 0.0).moments;
  }

  [[nodiscard]] Record Load(const std::string& name, const configuration::RigFile& rig) const {
    return LoadRecord((folder_ / name).string(), rig);
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("levitas_reversed_rig_" + std::to_string(getpid()));
  configuration::RigFile reversed_ = FlexibleRotor();
};

TEST_F(ReversedRig, HasTheSameMotionAndInnovationsAsTheStraightOne) {
  const Record straight = Load("straight.csv", FlexibleRotor());
  const Record wired = Load("wired.csv", reversed_);
  const auto expected = Run(FlexibleRotor(), straight);
  const auto found = Run(reversed_, wired);
  ASSERT_EQ(expected.size(), static_cast<std::size_t>(kRunRows));
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t n = 0; n < found.size(); ++n) {
    EXPECT_EQ(wired.rows[n].sample.position_m, straight.rows[n].sample.position_m);
    EXPECT_EQ(found[n].measured_m, expected[n].measured_m);
    EXPECT_EQ(found[n].command_next_a, expected[n].command_next_a);
    EXPECT_EQ(found[n].innovation_m, expected[n].innovation_m);
  }
}

TEST_F(ReversedRig, IsAnotherMotionWithTheRigFileOfTheStraightOne) {
  const Record straight = Load("straight.csv", FlexibleRotor());
  const Record mistaken = Load("wired.csv", FlexibleRotor());
  const auto expected = Run(FlexibleRotor(), straight);
  const auto found = Run(FlexibleRotor(), mistaken);
  EXPECT_EQ(found.back().measured_m[1], -expected.back().measured_m[1]);
  EXPECT_EQ(found.back().command_next_a[2], -expected.back().command_next_a[2]);
  EXPECT_NE(found.back().innovation_m, expected.back().innovation_m);
}

}  // namespace
}  // namespace levitas::diagnosis
