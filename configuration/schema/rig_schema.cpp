// Table of a rig file.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "configuration/schema/schema.hpp"
#include "plant_sim/sensor/characteristic.hpp"

namespace levitas::configuration {
namespace {

using namespace unit;

constexpr std::size_t kMaxBearings = kMaxAxes / 2;

void DescribePolarity(Visitor& v, std::string_view key, std::string_view meaning, double& value) {
  int sign = value < 0.0 ? -1 : 1;
  v.Integer({key, -1, 1, 1, meaning}, sign);
  v.RefuseIf(sign == 0, key, "found 0, allowed -1 or 1");
  value = sign;
}

void DescribeCharacteristic(Visitor& v, plant::SensorConfig& sensor) {
  constexpr double kFarthestUm = 20000.0;
  v.List({"characteristic", 0, 200,
          "measured curve of the probe, ascending, one point at the centre; none: a straight line"},
         sensor.characteristic, [&](sensor::ProbePoint& point, std::size_t) {
           v.Number({"displacement", kMicrometre, -kFarthestUm, kFarthestUm, kRequired,
                     "where the rotor is along the axis"},
                    point.displacement_m);
           v.Number({"reading", kMicrometre, -kFarthestUm, kFarthestUm, kRequired,
                     "what the probe says there, before its gain and filter"},
                    point.reading_m);
         });
  // Fields that were refused are NaN and have been reported.
  if (std::ranges::any_of(sensor.characteristic, [](const sensor::ProbePoint& point) {
        return std::isnan(point.displacement_m) || std::isnan(point.reading_m);
      })) {
    return;
  }
  std::string problem;
  try {
    sensor::CheckCharacteristic("curve of the probe", sensor.characteristic);
  } catch (const std::invalid_argument& refused) {
    problem = refused.what();
  }
  v.RefuseIf(!problem.empty(), "characteristic", problem);
}

void Describe(Visitor& v, plant::SensorConfig& sensor) {
  constexpr std::array<std::string_view, 2> kFilters{"first_order", "butterworth_2"};
  auto filter = static_cast<std::size_t>(sensor.filter);
  v.Choice({"filter", kFilters, "first_order", "what precedes the converter"}, filter);
  sensor.filter = static_cast<plant::SensorFilter>(filter);
  v.Number({"bandwidth", kHertz, 10, 1e6, kRequired, "-3 dB of that filter"}, sensor.bandwidth_hz);
  v.Number({"noise_rms", kMicrometre, 0, 1000, kRequired, "white noise of one sample"},
           sensor.noise_rms_m);
  v.Integer({"adc_bits", 0, 24, 0, "resolution of the converter over its range; 0 for none"},
            sensor.adc_bits);
  v.Number({"range", kMicrometre, 1, 20000, kRequired, "the converter covers plus or minus this"},
           sensor.range_m);
  v.Number({"gain", kOne, 0.1, 10, 1, "reading per displacement; 1 for a sensor as calibrated"},
           sensor.gain);
  DescribeCharacteristic(v, sensor);
}

void Describe(Visitor& v, plant::TouchdownConfig& touchdown) {
  v.Number({"clearance", kMicrometre, 1, 20000, kRequired, "radial clearance"},
           touchdown.clearance_m);
  v.Number({"stiffness", kStiffness, 1e4, 1e10, 2e7,
            "of the contact, radial; the default is of a soft-mounted ball bearing"},
           touchdown.stiffness_n_per_m);
  v.Number({"damping", kDamping, 0, 1e6, 2000,
            "of the contact, radial; the default is of a rubber mount"},
           touchdown.damping_n_s_per_m);
  v.Number({"friction", kOne, 0, 1, 0.05,
            "Coulomb coefficient of the sliding contact; the default is of an inner race that "
            "spins up within a turn"},
           touchdown.friction);
  v.Number({"journal_radius", kMillimetre, 0.1, 2000, 15, "where the shaft slides"},
           touchdown.journal_radius_m);
}

// The axes of a bearing, and what they are called.
void DescribeAxes(Visitor& v, RigNumbers& numbers, plant::BearingConfig& bearing,
                  std::size_t index) {
  constexpr std::array<std::string_view, 2> kNames{"name_x", "namex"};
  constexpr std::array<std::string_view, 2> kAxes{"xy", "x"};
  const std::size_t x = 2 * index;
  std::size_t joined = numbers.channels.size() > x && numbers.channels[x] == bearing.name + "x";
  v.Choice({"axis_names", kNames, "name_x", "what its axes are called: de_x or dex"}, joined);
  std::size_t x_only = bearing.x_only ? 1 : 0;
  v.Choice({"axes", kAxes, "xy", "x: no coils and no probe in y, where a guide holds the rotor"},
           x_only);
  bearing.x_only = x_only == 1;
  const std::string stem = bearing.name + (joined == 1 ? "" : "_");
  numbers.channels.resize(std::max(numbers.channels.size(), x + 2));
  numbers.channels[x] = stem + "x";
  numbers.channels[x + 1] = stem + "y";
}

void DescribePlanes(Visitor& v, const plant::PlantConfig& plant, plant::BearingConfig& bearing) {
  v.Number({"actuator_z", kMillimetre, 0, 100000, kRequired, "plane of the magnet and its contact"},
           bearing.actuator_z_m);
  RefuseBeyondShaft(v, plant.rotor, bearing.actuator_z_m, "actuator_z_mm");
  RefuseBesideShaft(v, plant, bearing.shaft, bearing.actuator_z_m, "actuator_z_mm");
  v.Number({"sensor_z", kMillimetre, 0, 100000, kRequired, "plane of the position sensors"},
           bearing.sensor_z_m);
  RefuseBeyondShaft(v, plant.rotor, bearing.sensor_z_m, "sensor_z_mm");
  RefuseBesideShaft(v, plant, bearing.shaft, bearing.sensor_z_m, "sensor_z_mm");
}

// Values that are allowed each by itself, not together.
void RefuseContradictions(Visitor& v, const RigNumbers& numbers,
                          const plant::BearingConfig& bearing) {
  const auto& drive = bearing.amplifier.voltage;
  v.RefuseIf(drive && drive->dead_band_a >= numbers.max_coil_current_a, "amplifier",
             fmt::format("dead band {:.6g} mA of the voltage must be smaller than max_current, "
                         "{:.6g} mA, of which nothing would be left",
                         drive ? drive->dead_band_a * 1e3 : 0.0, numbers.max_coil_current_a * 1e3));
  v.RefuseIf(bearing.touchdown.clearance_m > bearing.sensor.range_m, "sensor",
             fmt::format("sensor range {:.6g} um is smaller than the touchdown clearance {:.6g} um",
                         bearing.sensor.range_m * 1e6, bearing.touchdown.clearance_m * 1e6));
  v.RefuseIf(bearing.touchdown.clearance_m >= bearing.magnet.gap_m, "touchdown",
             fmt::format("clearance {:.6g} um must be smaller than the air gap {:.6g} um",
                         bearing.touchdown.clearance_m * 1e6, bearing.magnet.gap_m * 1e6));
}

void Describe(Visitor& v, RigFile& rig, plant::BearingConfig& bearing, std::size_t index) {
  const std::size_t x = 2 * index;
  v.Name({"name", "of the bearing; its axes are called after it"}, bearing.name);
  DescribeAxes(v, rig.numbers, bearing, index);
  const auto before = rig.plant.bearings.begin();
  v.RefuseIf(std::any_of(before, before + static_cast<std::ptrdiff_t>(index),
                         [&](const auto& other) { return other.name == bearing.name; }),
             "name", fmt::format("found \"{}\", which an earlier bearing has", bearing.name));
  v.When(!rig.plant.shafts.empty(), "with shafts",
         [&] { DescribeShaftNumber(v, rig.plant, bearing.shaft); });
  DescribePlanes(v, rig.plant, bearing);
  bearing.magnet.bias_current_a = rig.numbers.bias_current_a;
  bearing.magnet.max_coil_current_a = rig.numbers.max_coil_current_a;
  v.Group("magnet", "two opposed coils an axis", [&] { Describe(v, bearing.magnet); });
  v.Group("amplifier", "current loop of each axis", [&] {
    Describe(v, bearing.amplifier);
    DescribePolarity(v, "polarity_x", "-1: the x coils are wired the other way round",
                     rig.plant.actuator_polarity[x]);
    DescribePolarity(v, "polarity_y", "-1: the y coils are wired the other way round",
                     rig.plant.actuator_polarity[x + 1]);
  });
  v.Group("sensor", "position sensor of each axis", [&] {
    Describe(v, bearing.sensor);
    DescribePolarity(v, "polarity_x", "-1: the x probe reads the other way round",
                     rig.plant.sensor_polarity[x]);
    DescribePolarity(v, "polarity_y", "-1: the y probe reads the other way round",
                     rig.plant.sensor_polarity[x + 1]);
  });
  v.Group("touchdown", "retainer bearing in the plane of the magnet",
          [&] { Describe(v, bearing.touchdown); });
  RefuseContradictions(v, rig.numbers, bearing);
}

void DescribeSampling(Visitor& v, RigFile& rig) {
  double period_s = static_cast<double>(rig.plant.period_ns) / 1e9;
  v.Number({"period", kMicrosecond, 10, 10000, kRequired, "sampling period"}, period_s);
  const double period_ns = period_s * 1e9;
  v.RefuseIf(std::abs(period_ns - std::round(period_ns)) > 1e-6, "period_us",
             "must be a whole number of nanoseconds");
  rig.plant.period_ns = std::isfinite(period_ns) ? std::llround(period_ns) : 100'000;
  v.Number({"delay", Unit{"samples", "samples", ""}, 0, 10, 1,
            "from the sampling instant until the current commanded from it acts"},
           rig.plant.delay_samples);
  v.Integer({"substeps", 1, 1000, 4, "fixed integration steps of the simulation per period"},
            rig.plant.substeps);
}

void DescribeCoils(Visitor& v, RigNumbers& numbers) {
  v.Number({"bias_current", kAmpere, 0.01, 100, kRequired, "i0: the coils carry i0+ic, i0-ic"},
           numbers.bias_current_a);
  v.Number({"max_current", kAmpere, 0.01, 200, kRequired, "a coil current stays within 0 and this"},
           numbers.max_coil_current_a);
  v.RefuseIf(numbers.max_coil_current_a <= numbers.bias_current_a, "max_current_a",
             fmt::format("found {:.6g} A, but it must exceed the bias current {:.6g} A",
                         numbers.max_coil_current_a, numbers.bias_current_a));
}

void DescribeGravity(Visitor& v, plant::PlantConfig& plant) {
  v.Number({"acceleration", kGravity, 0, 100, 9.81, "0 for a vertical rotor"},
           plant.gravity_m_per_s2);
  v.RefuseIf(!plant.shafts.empty() && plant.gravity_m_per_s2 > 0.0, "acceleration_m_per_s2",
             "must be 0 with shafts: their positions count from the rest under all static loads");
  v.Number(
      {"direction", kDegree, -360, 360, 225, "where it pulls in the x-y plane, from +x towards +y"},
      plant.gravity_direction_rad);
}

void DescribeObjectives(Visitor& v, RigNumbers& numbers) {
  v.Number({"standing_orbit", kMicrometre, 0.01, 5000, kRequired, "largest radius at standstill"},
           numbers.standing_orbit_objective_m);
  v.Number({"spinning_orbit", kMicrometre, 0.01, 5000, kRequired, "largest radius while rotating"},
           numbers.spinning_orbit_objective_m);
}

void DescribeRun(Visitor& v, RigFile& rig) {
  bool has_run = !rig.run.controller.empty();
  v.OptionalGroup("run", "what the commands use with this rig unless told otherwise", has_run, [&] {
    constexpr std::size_t kLongestPath = 1000;
    v.Name({"controller",
            "shipped name, or a path (with a /) from the folder of this file",
            {},
            kLongestPath},
           rig.run.controller);
    v.Name({"scenario", "the same", {}, kLongestPath}, rig.run.scenario);
  });
}

void DescribeDrive(Visitor& v, RigFile& rig) {
  plant::DriveConfig& drive = rig.plant.drive;
  v.Number(
      {"max_speed", kRpm, 1, 300000, kRequired, "rated speed; the over-speed trip refers to it"},
      rig.numbers.max_speed_rad_per_s);
  v.Number({"max_acceleration", kRpmPerSecond, 0.1, 1e6, kRequired, "what the drive can do"},
           drive.max_acceleration_rad_per_s2);
  v.Number({"coast_down", kPerSecond, 0, 100, kRequired,
            "c of d(speed)/dt = -c speed - friction without torque"},
           drive.coast_down_1_per_s);
  v.Number({"friction", kRpmPerSecond, 0, 1e6, kRequired, "friction of the same equation"},
           drive.coast_down_rad_per_s2);
  v.Number({"polar_inertia", kInertia, 0, 1e6, 0,
            "of all that turns, as the first shaft feels it: friction in the touchdown bearings "
            "brakes it; 0: unknown, and contact does not change the speed"},
           drive.polar_inertia_kg_m2);
}

constexpr std::array<std::string_view, 3> kCarriesWords{"everything", "from_rig", "to_rig"};
constexpr std::array<std::string_view, 2> kActsWords{"at_next_sample", "on_arrival"};

void Describe(Visitor& v, can::BusConfig& bus) {
  v.Name({"name", "of the bus, for messages to people"}, bus.name);
  v.Name({"interface", "of the kernel, such as can0; --port can:IF may name another"},
         bus.interface);
  v.Number({"bit_rate", kMegabitPerSecond, 0.01, 1, kRequired, "of the arbitration phase"},
           bus.rates.arbitration_bit_per_s);
  v.Number({"data_bit_rate", kMegabitPerSecond, 0, 8, kRequired,
            "of the data phase of CAN FD; 0 for classical CAN"},
           bus.rates.data_bit_per_s);
  auto carries = static_cast<std::size_t>(bus.carries);
  v.Choice({"carries", kCarriesWords, "everything", "the messages of which sender"}, carries);
  bus.carries = static_cast<can::Carries>(carries);
  auto acts = static_cast<std::size_t>(bus.current_acts);
  v.Choice({"current_acts", kActsWords, "at_next_sample",
            "when the rig lets a current act whose frame has arrived"},
           acts);
  bus.current_acts = static_cast<can::Acts>(acts);
  v.Number({"load_limit", kOne, 0.05, 1, 0.8,
            "share of the time that the loop may occupy; beyond it the port refuses"},
           bus.load_limit);
}

void DescribeBuses(Visitor& v, RigFile& rig) {
  v.List({"buses", 0, 4, "CAN buses between controller and rig; see docs/real_rig.md"}, rig.buses,
         [&](can::BusConfig& bus, std::size_t /*index*/) { Describe(v, bus); });
  if (rig.buses.empty()) return;
  const auto carries = [&](can::Carries wanted) {
    return std::count_if(rig.buses.begin(), rig.buses.end(), [&](const can::BusConfig& bus) {
      return bus.carries == wanted || bus.carries == can::Carries::kEverything;
    });
  };
  v.RefuseIf(carries(can::Carries::kFromRig) != 1 || carries(can::Carries::kToRig) != 1, "buses",
             "each direction must be carried by exactly one bus: one that carries everything, or "
             "one from_rig and one to_rig");
  const auto fast = std::count_if(rig.buses.begin(), rig.buses.end(),
                                  [](const auto& bus) { return bus.rates.data_bit_per_s > 0.0; });
  v.RefuseIf(fast != 0 && fast != static_cast<std::ptrdiff_t>(rig.buses.size()), "buses",
             "all buses are CAN FD, or all are classical (data_bit_rate 0)");
}

// How the logs of this rig's own instruments name what is in them.
void DescribeLog(Visitor& v, LogLayout& log) {
  bool present = !log.rows.empty();
  v.OptionalGroup("log", "matrix of a MAT file in which the rig's own software logs", present, [&] {
    v.Name({"matrix", "name of the matrix"}, log.matrix);
    v.List({"rows", 1, 200, "what each row of the matrix holds, from the first"}, log.rows,
           [&](std::string& row, std::size_t) {
             v.Name({"column", "as a column of a CSV file is called; see docs/formats.md"}, row);
           });
  });
}

/// What RigNumbers repeats of the plant.
void Derive(RigFile& rig) {
  RigNumbers& numbers = rig.numbers;
  numbers.period_ns = rig.plant.period_ns;
  numbers.max_acceleration_rad_per_s2 = rig.plant.drive.max_acceleration_rad_per_s2;
  const bool guided = rig.plant.bearings.size() == 1 && rig.plant.bearings.front().x_only;
  numbers.channels.resize(guided ? 1 : 2 * rig.plant.bearings.size());
  numbers.bearings.clear();
  numbers.clearances_m.clear();
  numbers.sensor_ranges_m.clear();
  numbers.magnet_gaps_m.clear();
  for (const plant::BearingConfig& bearing : rig.plant.bearings) {
    numbers.bearings.push_back(bearing.name);
    const bool first = numbers.bearings.size() == 1;
    const auto smallest = [&](double so_far, double here) {
      return first ? here : std::min(so_far, here);
    };
    numbers.clearance_m = smallest(numbers.clearance_m, bearing.touchdown.clearance_m);
    numbers.sensor_range_m = smallest(numbers.sensor_range_m, bearing.sensor.range_m);
    numbers.clearances_m.push_back(bearing.touchdown.clearance_m);
    numbers.sensor_ranges_m.push_back(bearing.sensor.range_m);
    if (!bearing.magnet.exponential) numbers.magnet_gaps_m.push_back(bearing.magnet.gap_m);
  }
  if (numbers.magnet_gaps_m.size() != numbers.bearings.size()) numbers.magnet_gaps_m.clear();
  numbers.sensor_polarity = rig.plant.sensor_polarity;
  numbers.actuator_polarity = rig.plant.actuator_polarity;
}

}  // namespace

void Describe(Visitor& v, RigFile& rig) {
  v.Name({"name", "of the rig"}, rig.numbers.name);
  v.Group("sampling", "of the control loop", [&] { DescribeSampling(v, rig); });
  v.Group("coils", "of every bearing", [&] { DescribeCoils(v, rig.numbers); });
  bool has_rotor = rig.plant.shafts.empty();
  v.OptionalGroup("rotor", "the one rotor of the rig, free between its magnets", has_rotor,
                  [&] { Describe(v, rig.plant.rotor, rig.plant.unbalance); });
  DescribeTrain(v, rig.plant);
  const bool geared = !rig.plant.shafts.empty();
  v.RefuseIf(has_rotor == geared, "", "give either rotor or shafts");
  v.List(
      {"bearings", geared ? 0U : 1U, kMaxBearings, "from the drive end"}, rig.plant.bearings,
      [&](plant::BearingConfig& bearing, std::size_t index) { Describe(v, rig, bearing, index); });
  const auto x_only = [](const plant::BearingConfig& bearing) { return bearing.x_only; };
  v.RefuseIf(rig.plant.bearings.size() > 1 && std::ranges::any_of(rig.plant.bearings, x_only),
             "bearings", "axes: x is for a rig with one bearing only");
  v.Group("gravity", "where the weight of the rotor pulls", [&] { DescribeGravity(v, rig.plant); });
  v.Group("drive", "motor of the rotor", [&] { DescribeDrive(v, rig); });
  Describe(v, rig.lines, static_cast<double>(rig.plant.period_ns) * 1e-9);
  DescribeBuses(v, rig);
  v.Group("objectives", "what the verdict of a run is held against",
          [&] { DescribeObjectives(v, rig.numbers); });
  DescribeRun(v, rig);
  DescribeLog(v, rig.log);
  DescribeTolerances(v, rig.tolerances);
  Derive(rig);
  DescribeEffects(v, rig);
}

}  // namespace levitas::configuration
