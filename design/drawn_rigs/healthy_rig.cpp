#include "design/drawn_rigs/healthy_rig.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "common/two_pi.hpp"

namespace levitas::uncertainty {
namespace {

using effect::Id;

class Drawing {
 public:
  Drawing(configuration::RigFile& rig, Random& draw)
      : rig_(rig), draw_(draw), by_(rig.tolerances.value_or(configuration::Tolerances{})) {}

  void Run() {
    plant::PlantConfig& plant = rig_.plant;
    plant.delay_samples = std::max(0.0, plant.delay_samples + Off(by_.delay_samples));
    for (plant::UnbalanceMass& mass : plant.unbalance) Shift(mass);
    for (std::size_t b = 0; b < plant.bearings.size(); ++b) Draw(plant.bearings[b], b);
    if (!plant.shafts.empty()) return;
    Add(Id::kRotorMass, {1.0 + Off(by_.rotor_mass)});
    Add(Id::kGyroscopicInertia, {1.0 + Off(by_.gyroscopic_inertia)});
    for (const rotor::Disc& disc : plant.rotor.discs)
      Add(Id::kStaticLoad, {disc.z_m, Off(by_.static_load_n), Off(by_.static_load_n)});
  }

 private:
  [[nodiscard]] double Off(double deviation) {
    constexpr double kMost = 3.0;
    return deviation * std::clamp(draw_.Normal(), -kMost, kMost);
  }

  /// An entry of the file that says the same already stays alone.
  void Add(Id id, std::initializer_list<double> values, std::uint32_t axes = effect::kAllAxes,
           std::size_t bearing = 0) {
    const auto same = [&](const effect::EffectConfig& entry) {
      return entry.id == id && entry.bearing == bearing && (entry.axes & axes) != 0U;
    };
    if (id != Id::kStaticLoad && std::ranges::any_of(rig_.plant.effects, same)) return;
    effect::EffectConfig entry;
    entry.id = id;
    entry.axes = axes;
    entry.bearing = bearing;
    std::copy(values.begin(), values.end(), entry.values.begin());
    rig_.plant.effects.push_back(entry);
  }

  void Shift(plant::UnbalanceMass& mass) {
    const double x = mass.moment_kg_m * std::cos(mass.phase_rad) + Off(by_.unbalance_kg_m);
    const double y = mass.moment_kg_m * std::sin(mass.phase_rad) + Off(by_.unbalance_kg_m);
    mass.moment_kg_m = std::hypot(x, y);
    mass.phase_rad = std::atan2(y, x);
  }

  void Draw(plant::BearingConfig& bearing, std::size_t b) {
    bearing.sensor.bandwidth_hz *= 1.0 + Off(by_.sensor_bandwidth);
    bearing.sensor.gain *= 1.0 + Off(by_.sensor_gain);
    bearing.amplifier.bandwidth_hz *= 1.0 + Off(by_.amplifier_bandwidth);
    const std::size_t axes = rig_.numbers.axes() / rig_.plant.bearings.size();
    for (std::size_t axis = axes * b; axis < axes * (b + 1); ++axis) {
      const auto one = 1U << static_cast<unsigned>(axis);
      Add(Id::kSensorOffset, {Off(by_.sensor_offset_m)}, one);
      Add(Id::kSensorRunout,
          {1.0, std::abs(Off(by_.sensor_runout_m)), kTwoPi * (draw_.Uniform() - 0.5)}, one);
    }
    if (rig_.plant.shafts.empty())
      Add(Id::kSensorPosition, {OnShaft(bearing.sensor_z_m, Off(by_.sensor_position_m))},
          effect::kAllAxes, b);
  }

  /// The shift, turned inwards where it would leave the shaft: of a rotor of given modes, what its
  /// planes span.
  [[nodiscard]] double OnShaft(double z_m, double shift_m) const {
    double low_m = 0.0;
    double high_m = 0.0;
    for (const rotor::Section& section : rig_.plant.rotor.sections) high_m += section.length_m;
    if (rig_.plant.rotor.given) {
      low_m = high_m = rig_.plant.bearings.front().sensor_z_m;
      for (const plant::BearingConfig& one : rig_.plant.bearings) {
        low_m = std::min({low_m, one.sensor_z_m, one.actuator_z_m});
        high_m = std::max({high_m, one.sensor_z_m, one.actuator_z_m});
      }
    }
    const double moved_m = z_m + shift_m;
    return moved_m < low_m || moved_m > high_m ? -shift_m : shift_m;
  }

  configuration::RigFile& rig_;
  Random& draw_;
  configuration::Tolerances by_;
};

}  // namespace

configuration::RigFile DrawWithin(const configuration::RigFile& rig, Random& draw) {
  configuration::RigFile out = rig;
  Drawing(out, draw).Run();
  return out;
}

}  // namespace levitas::uncertainty
