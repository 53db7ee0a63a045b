#include "analysis/step_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "controller/law/axis_law.hpp"
#include "plant_sim/plant/bearing_frame.hpp"
#include "plant_sim/plant/plant.hpp"

namespace levitas::analysis {
namespace {

constexpr int kFiner = 8;
constexpr double kDurationS = 1.0;
constexpr double kManyModes = 16.0;
constexpr double kRelease = 0.1;  // of the clearance

plant::PlantConfig Quiet(const plant::PlantConfig& given) {
  plant::PlantConfig rig = plant::InBearingFrame(given);
  for (auto& bearing : rig.bearings) {
    bearing.amplifier.dac_bits = 0;
    bearing.sensor.noise_rms_m = 0.0;
    bearing.sensor.adc_bits = 0;
  }
  return rig;
}

/// Rig and law on their own, without a supervisor: nothing but the equations.
class BareLoop {
 public:
  BareLoop(const plant::PlantConfig& rig, const law::LawConfig& law, double speed_rad_per_s)
      : plant_(rig, 1), coefficients_(AtPeriod(rig, law)), state_(coefficients_) {
    AxisArray release_m{};
    double bias_a = 0.0;
    limit_a_ = law.current_limit_a;
    for (std::size_t axis = 0; axis < coefficients_.axes(); ++axis) {
      const plant::BearingConfig& bearing = rig.bearings[axis / 2];
      const double room_m = bearing.touchdown.clearance_m > 0.0 ? bearing.touchdown.clearance_m
                                                                : 0.5 * bearing.magnet.gap_m;
      release_m[axis] = kRelease * room_m;
      bias_a = bearing.magnet.bias_current_a;
      const double room_a = std::min(bias_a, bearing.magnet.max_coil_current_a - bias_a);
      if (!(limit_a_ > 0.0)) limit_a_ = room_a;
    }
    plant_.PlaceAtRest(release_m);
    plant_.SetSpeed(speed_rad_per_s, 0.0);
    command_.bias_current_a = bias_a;
    command_.drive_enabled = true;
    command_.speed_set_point_rad_per_s = speed_rad_per_s;
    command_.acceleration_limit_rad_per_s2 = rig.drive.max_acceleration_rad_per_s2;
  }

  /// Positions as the sensors show them.
  AxisArray Step() {
    AxisArray error_m{};
    const AxisArray seen_m = plant_.SensorOutput();
    for (std::size_t axis = 0; axis < coefficients_.axes(); ++axis) {
      error_m[axis] = -seen_m[axis];
    }
    const law::LawOutput out = law::Step(coefficients_, state_, error_m, {}, limit_a_);
    command_.control_current_a = out.control_current_a;
    plant_.Advance(command_);
    return seen_m;
  }

 private:
  static law::LawConfig AtPeriod(const plant::PlantConfig& rig, law::LawConfig law) {
    law.period_s = static_cast<double>(rig.period_ns) * 1e-9;
    return law;
  }

  plant::Plant plant_;
  law::LawCoefficients coefficients_;
  law::LawState state_;
  plant::PlantCommand command_;
  double limit_a_{};
};

}  // namespace

StepError MeasureStepError(const plant::PlantConfig& rig, const law::LawConfig& law,
                           double speed_rad_per_s) {
  plant::PlantConfig coarse = Quiet(rig);
  plant::PlantConfig fine = coarse;
  fine.substeps = kFiner * coarse.substeps;
  BareLoop with_rigs_step(coarse, law, speed_rad_per_s);
  BareLoop with_finer_step(fine, law, speed_rad_per_s);
  const auto modes = static_cast<double>(rig.rotor.given ? rig.rotor.given->modes.size() + 2
                                                         : rig.rotor.modes_per_plane);
  const double share = modes > 0.0 ? std::min(1.0, kManyModes / modes) : 0.1;
  const double period_s = static_cast<double>(rig.period_ns) * 1e-9;
  const auto periods = static_cast<std::uint64_t>(share * kDurationS / period_s);
  StepError error{coarse.substeps, fine.substeps, static_cast<double>(periods) * period_s,
                  speed_rad_per_s, 0.0,           0.0};
  for (std::uint64_t n = 0; n < periods; ++n) {
    const AxisArray a_m = with_rigs_step.Step();
    const AxisArray b_m = with_finer_step.Step();
    for (std::size_t axis = 0; axis < law.axis_count(); ++axis) {
      const double difference_m = std::abs(a_m[axis] - b_m[axis]);
      error.largest_m = std::isfinite(difference_m) ? std::max(error.largest_m, difference_m)
                                                    : std::numeric_limits<double>::infinity();
      error.peak_m = std::max(error.peak_m, std::abs(b_m[axis]));
    }
  }
  return error;
}

}  // namespace levitas::analysis
