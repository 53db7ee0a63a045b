// Writes a record as a laboratory would: the shipped law holds a rotor that is not quite the rig
// file's, under a random binary test current, and every sample becomes a row of the CSV contract.
//
// Usage   record_maker OUT.csv healthy|unbalance|weak_magnet SPEED_RPM ROWS SEED
//         unbalance: all moments tripled; weak_magnet: 70 % of the force at the non-drive end.

#include <fmt/core.h>

#include <array>
#include <fstream>
#include <stdexcept>
#include <string>

#include "common/random.hpp"
#include "common/rotational_speed.hpp"
#include "configuration/rig_file.hpp"
#include "controller/law/axis_law.hpp"
#include "plant_sim/plant/plant.hpp"
#include "tests/support/paths.hpp"

namespace levitas::test {
namespace {

constexpr double kTestCurrentA = 0.05;  // so that the magnets work
constexpr std::uint64_t kSettleCycles = 5'000;

plant::PlantConfig Truth(const std::string& name, plant::PlantConfig rig) {
  if (name == "unbalance") {
    for (auto& mass : rig.unbalance) mass.moment_kg_m *= 3.0;
  } else if (name == "weak_magnet") {
    rig.bearings[1].magnet.force_constant_n_m2_per_a2 *= 0.7;
  } else if (name != "healthy") {
    throw std::invalid_argument("no such rotor: " + name);
  }
  return rig;
}

void WriteNames(std::ofstream& csv, const std::vector<std::string>& channels) {
  csv << "time_s,rotor_angle_rad,speed_rpm";
  for (const char* pattern : {"position_{}_m", "control_current_{}_a", "excitation_{}_a"}) {
    for (const auto& channel : channels) csv << ',' << fmt::format(fmt::runtime(pattern), channel);
  }
  csv << '\n';
}

void Record(const std::string& path, const plant::PlantConfig& truth,
            const configuration::RigFile& rig, double speed_rpm, std::uint64_t rows,
            std::uint64_t seed) {
  const auto controller = configuration::LoadController(
      levitas::test::SourceFolder() + "/config/controllers/flexible_rotor.yaml", rig.numbers);
  const law::LawCoefficients law(controller.law);
  law::LawState state(law);
  plant::Plant plant(truth, seed);
  plant.SetSpeed(RpmToRadPerS(speed_rpm), 0.0);
  Random random(seed + 1);
  std::ofstream csv(path);
  WriteNames(csv, rig.numbers.channels);
  for (std::uint64_t n = 0; n < kSettleCycles + rows; ++n) {
    const SensorFrame frame = plant.Sample();
    AxisArray error_m{}, excitation_a{};
    for (std::size_t i = 0; i < 4; ++i) {
      error_m[i] = -frame.position_m[i];
      excitation_a[i] = random.Uniform() < 0.5 ? kTestCurrentA : -kTestCurrentA;
    }
    plant::PlantCommand command;
    command.bias_current_a = rig.numbers.bias_current_a;
    command.control_current_a =
        law::Step(law, state, error_m, excitation_a, rig.numbers.bias_current_a).control_current_a;
    command.drive_enabled = true;
    command.speed_set_point_rad_per_s = RpmToRadPerS(speed_rpm);
    plant.Advance(command);
    if (n < kSettleCycles) continue;
    csv << fmt::format("{:.4f},{},{}", static_cast<double>(n - kSettleCycles) * 1e-4,
                       frame.angle_rad, RadPerSToRpm(frame.speed_rad_per_s));
    const std::array<const AxisArray*, 3> groups{&frame.position_m, &command.control_current_a,
                                                 &excitation_a};
    for (const AxisArray* values : groups) {
      for (std::size_t i = 0; i < 4; ++i) csv << fmt::format(",{}", (*values)[i]);
    }
    csv << '\n';
  }
  csv.flush();
  if (!csv) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace
}  // namespace levitas::test

int main(int argc, char** argv) {
  try {
    const std::vector<std::string> given(argv + 1, argv + argc);
    const auto rig = levitas::configuration::LoadRig(levitas::test::SourceFolder() +
                                                     "/config/rigs/flexible_rotor.yaml");
    levitas::test::Record(given.at(0), levitas::test::Truth(given.at(1), rig.plant), rig,
                          std::stod(given.at(2)), std::stoull(given.at(3)),
                          std::stoull(given.at(4)));
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "record_maker: {}\n", error.what());
    return 1;
  }
}
