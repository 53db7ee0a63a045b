#include "identification/balance/balance_rig.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/problem.hpp"
#include "common/two_pi.hpp"
#include "plant_sim/plant/bearing_frame.hpp"
#include "plant_sim/plant/find_operating_point.hpp"
#include "plant_sim/plant/linear_parts.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::balancing {
namespace {

using Eigen::Index;
using Kind = UnknownKind;
using plant::PlantModel;

/// Standard deviations of a probe's place that must be on the shaft, to both sides; it moves no
/// further.
constexpr double kRoomForProbe = 5.0;

std::size_t SizeOf(Index i) { return static_cast<std::size_t>(i); }

void RefuseUnlessOneRotor(const configuration::RigFile& rig) {
  const plant::PlantConfig& plant = rig.plant;
  const auto refuse = [&rig](const char* why) {
    throw BadInput(fmt::format("rig {}: {}; amb balance is for one rotor on radial bearings",
                               rig.numbers.name, why));
  };
  if (!plant.shafts.empty()) refuse("has geared shafts");
  if (rig.numbers.axes() < 2 || plant.bearings.front().x_only) refuse("has a single axis");
  for (const plant::BearingConfig& bearing : plant.bearings) {
    if (bearing.amplifier.voltage) refuse("has coils on a voltage");
  }
}

/// A node at each plane: an unbalance of nothing.
plant::PlantConfig WithPlanes(plant::PlantConfig plant, const std::vector<double>& planes_z_m) {
  for (const double z_m : planes_z_m) plant.unbalance.push_back({z_m, 0.0, 0.0, 0});
  return plant::InBearingFrame(std::move(plant));
}

/// What stands at the magnets when the probes read `position_m`: a straight line through them.
plant::OperatingPoint PointOf(const plant::PlantConfig& plant, const RecordedPoint& recorded) {
  plant::OperatingPoint point;
  const auto& bearings = plant.bearings;
  for (Index axis = 0; axis < recorded.position_m.size(); ++axis) {
    const std::size_t i = SizeOf(axis);
    point.control_a[i] = point.flux_a[i] = recorded.current_a[axis];
    point.displacement_m[i] = recorded.position_m[axis];
    if (bearings.size() != 2) continue;
    const double first_z_m = bearings[0].sensor_z_m;
    const double share =
        (bearings[i / 2].actuator_z_m - first_z_m) / (bearings[1].sensor_z_m - first_z_m);
    const double first_m = recorded.position_m[axis % 2];
    point.displacement_m[i] = first_m + share * (recorded.position_m[axis % 2 + 2] - first_m);
  }
  return point;
}

bool Has(const plant::PlantConfig& plant, effect::Id id, std::size_t bearing = 0) {
  return std::ranges::any_of(plant.effects, [&](const effect::EffectConfig& entry) {
    return entry.id == id && entry.bearing == bearing;
  });
}

void AddEffect(plant::PlantConfig& plant, effect::Id id, double value, std::size_t bearing = 0) {
  effect::EffectConfig entry;
  entry.id = id;
  entry.bearing = bearing;
  entry.values[0] = value;
  plant.effects.push_back(entry);
}

/// Changes the rig's own numbers; what belongs to axes is done to the matrices.
void Change(plant::PlantParameters& rig, const Unknown& unknown, double by) {
  plant::PlantConfig& plant = rig.config;
  const Index mode = rig.modes.rigid_modes + static_cast<Index>(unknown.index);
  switch (unknown.kind) {
    case Kind::kModeFrequency:
      rig.modes.frequency_rad_per_s[mode] *= 1.0 + by;
      break;
    case Kind::kModeDamping:
      rig.modes.damping_ratio[mode] *= std::exp(by);
      break;
    case Kind::kGyroscopic:
      rig.modes.gyroscopic *= 1.0 + by;
      break;
    case Kind::kMass:
      if (by != 0.0) AddEffect(plant, effect::Id::kRotorMass, 1.0 + by);
      break;
    case Kind::kAmplifierBandwidth:
      plant.bearings[unknown.index].amplifier.bandwidth_hz *= std::exp(by);
      break;
    case Kind::kSensorBandwidth:
      plant.bearings[unknown.index].sensor.bandwidth_hz *= std::exp(by);
      break;
    case Kind::kSensorPosition:
      if (by != 0.0) {
        const double most_m = kRoomForProbe * unknown.deviation;
        AddEffect(plant, effect::Id::kSensorPosition, std::clamp(by, -most_m, most_m),
                  unknown.index);
      }
      break;
    case Kind::kCurrentGain:
    case Kind::kStiffness:
    case Kind::kSensorGain:
    case Kind::kDelay:
      break;
  }
}

/// What the unknowns change beside the rig's own numbers.
struct MatrixChanges {
  Eigen::ArrayXd ki, ks, gain;  ///< per axis, of the healthy rig's
  double delay_samples{};       ///< on top of the rig's own
  double mass{1.0};             ///< of the healthy rotor's
};

MatrixChanges ApplyUnknowns(const std::vector<Unknown>& unknowns, const Eigen::VectorXd& place,
                            Index axes, plant::PlantParameters& rig) {
  const Eigen::ArrayXd healthy = Eigen::ArrayXd::Ones(axes);
  MatrixChanges changes{healthy, healthy, healthy};
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const double by = place[static_cast<Index>(i)];
    const auto axis = static_cast<Index>(unknowns[i].index);
    Change(rig, unknowns[i], by);
    if (unknowns[i].kind == Kind::kCurrentGain) changes.ki[axis] += by;
    if (unknowns[i].kind == Kind::kStiffness) changes.ks[axis] += by;
    if (unknowns[i].kind == Kind::kSensorGain) changes.gain[axis] += by;
    if (unknowns[i].kind == Kind::kDelay) changes.delay_samples = by;
    if (unknowns[i].kind == Kind::kMass) changes.mass += by;
  }
  return changes;
}

/// How the magnets push the rotor and see it.
void CoupleMagnets(const PlantModel& model, Index axes, RigMatrices& made) {
  const Index states = made.a0.rows();
  made.push.resize(states, axes);
  made.seen.resize(axes, states);
  for (Index axis = 0; axis < axes; ++axis) {
    made.push.col(axis) =
        plant::Reaction(model, SizeOf(axis / 2), static_cast<int>(axis % 2), states);
    made.seen.row(axis) =
        plant::SeenByMagnet(model, SizeOf(axis / 2), static_cast<int>(axis % 2), states);
  }
}

}  // namespace

std::string NameOf(const Unknown& unknown, const RigNumbers& rig) {
  const auto axis = [&] { return rig.channels[unknown.index]; };
  const auto bearing = [&] { return rig.bearings[unknown.index]; };
  switch (unknown.kind) {
    case Kind::kCurrentGain:
      return "ki " + axis();
    case Kind::kStiffness:
      return "ks " + axis();
    case Kind::kModeFrequency:
      return fmt::format("frequency of mode {}", unknown.index + 1);
    case Kind::kModeDamping:
      return fmt::format("damping of mode {}", unknown.index + 1);
    case Kind::kGyroscopic:
      return "gyroscopic effect";
    case Kind::kMass:
      return "rotor mass";
    case Kind::kAmplifierBandwidth:
      return "amplifier bandwidth " + bearing();
    case Kind::kSensorBandwidth:
      return "sensor bandwidth " + bearing();
    case Kind::kSensorGain:
      return "sensor gain " + axis();
    case Kind::kSensorPosition:
      return "sensor place " + bearing();
    case Kind::kDelay:
      return "delay";
  }
  return {};
}

BalanceRig::BalanceRig(const configuration::RigFile& rig, const RecordedPoint& point,
                       std::vector<double> planes_z_m)
    : rig_(rig), planes_z_m_(std::move(planes_z_m)), period_s_(rig.numbers.period_s()) {
  RefuseUnlessOneRotor(rig);
  axes_ = static_cast<Index>(rig.numbers.axes());
  nominal_ = plant::Reduce(WithPlanes(rig.plant, planes_z_m_));
  if (point.bias_current_a > 0.0) {
    for (auto& bearing : nominal_.config.bearings) {
      bearing.magnet.bias_current_a = point.bias_current_a;
    }
  }
  point_ = PointOf(nominal_.config, point);
  shapes_.resize(nominal_.modes.frequency_rad_per_s.size(), planes());
  for (Index p = 0; p < planes(); ++p) {
    shapes_.col(p) = nominal_.modes.ShapeAt(planes_z_m_[SizeOf(p)]).transpose();
  }
  const PlantModel model(nominal_);
  for (const auto& bearing : model.bearings()) magnets_.push_back(bearing.magnet);
  ki_.resize(axes_);
  ks_.resize(axes_);
  for (Index axis = 0; axis < axes_; ++axis) {
    const plant::Slopes slopes = plant::SlopesAt(model, SizeOf(axis / 2), point_);
    ki_[axis] = slopes.current(axis % 2, axis % 2);
    ks_[axis] = slopes.displacement(axis % 2, axis % 2);
  }
  ListUnknowns();
}

bool BalanceRig::MayMove(std::size_t bearing, double deviation_m) const {
  const auto& nodes = nominal_.modes.node_z_m;
  const double z_m = rig_.plant.bearings[bearing].sensor_z_m;
  return z_m - kRoomForProbe * deviation_m >= nodes.front() &&
         z_m + kRoomForProbe * deviation_m <= nodes.back();
}

void BalanceRig::ListUnknowns() {
  const configuration::Tolerances by = rig_.tolerances.value_or(configuration::Tolerances{});
  const auto add = [this](Kind kind, std::size_t index, double deviation) {
    if (deviation > 0.0) unknowns_.push_back({kind, index, deviation});
  };
  for (std::size_t axis = 0; axis < SizeOf(axes_); ++axis) {
    add(Kind::kCurrentGain, axis, by.current_gain);
    add(Kind::kStiffness, axis, by.displacement_stiffness);
    add(Kind::kSensorGain, axis, by.sensor_gain);
  }
  const auto& modes = nominal_.modes;
  for (Index i = modes.rigid_modes; i < modes.frequency_rad_per_s.size(); ++i) {
    const std::size_t mode = SizeOf(i - modes.rigid_modes);
    add(Kind::kModeFrequency, mode, by.modal_frequency);
    if (modes.damping_ratio[i] > 0.0) add(Kind::kModeDamping, mode, by.modal_damping);
  }
  add(Kind::kGyroscopic, 0, by.gyroscopic_inertia);
  if (!Has(rig_.plant, effect::Id::kRotorMass)) add(Kind::kMass, 0, by.rotor_mass);
  for (std::size_t b = 0; b < rig_.plant.bearings.size(); ++b) {
    add(Kind::kAmplifierBandwidth, b, by.amplifier_bandwidth);
    add(Kind::kSensorBandwidth, b, by.sensor_bandwidth);
    if (!Has(rig_.plant, effect::Id::kSensorPosition, b) && MayMove(b, by.sensor_position_m)) {
      add(Kind::kSensorPosition, b, by.sensor_position_m);
    }
  }
  add(Kind::kDelay, 0, by.delay_samples);
}

std::complex<double> BalanceRig::ForceBeyondSlopes(Index axis, std::complex<double> current_a,
                                                   std::complex<double> displacement_m) const {
  constexpr int kPerTurn = 32;
  constexpr double kSmall = 1e-3;  // of the amplitudes: there the slopes are all there is
  const std::size_t i = SizeOf(axis);
  const double bias_a = nominal_.config.bearings[i / 2].magnet.bias_current_a;
  const auto harmonic = [&](double share) {
    std::complex<double> sum = 0.0;
    for (int n = 0; n < kPerTurn; ++n) {
      const auto turned = std::polar(1.0, kTwoPi * n / kPerTurn);
      const double force_n = magnet::Force(
          magnets_[i / 2], bias_a, point_.control_a[i] + share * (current_a * turned).real(),
          point_.displacement_m[i] + share * (displacement_m * turned).real());
      sum += 2.0 / kPerTurn * force_n * std::conj(turned);
    }
    return sum / share;
  };
  return harmonic(1.0) - harmonic(kSmall);
}

double BalanceRig::centre_z_m() const {
  // rigid holds Phi^T M (1, z): products of its columns are the mass and its first moment.
  const Eigen::MatrixX2d& rigid = nominal_.modes.rigid;
  return rigid.col(0).dot(rigid.col(1)) / rigid.col(0).squaredNorm();
}

RigMatrices BalanceRig::At(const Eigen::VectorXd& place) const {
  plant::PlantParameters rig = nominal_;
  const MatrixChanges changes = ApplyUnknowns(unknowns_, place, axes_, rig);
  const Index rigid_modes = rig.modes.rigid_modes;
  const PlantModel model(std::move(rig));
  std::vector<plant::Slopes> slopes;
  for (Index b = 0; 2 * b < axes_; ++b) {
    slopes.push_back(plant::SlopesAt(model, SizeOf(b), point_));
    slopes.back().current =
        slopes.back().current * changes.ki.segment<2>(2 * b).matrix().asDiagonal();
    slopes.back().displacement =
        slopes.back().displacement * changes.ks.segment<2>(2 * b).matrix().asDiagonal();
  }
  plant::LinearModel linear = plant::LineariseWith(model, 0.0, slopes);
  RigMatrices made;
  made.a1 = plant::LineariseWith(model, 1.0, slopes).a - linear.a;
  made.a0 = std::move(linear.a);
  made.b = std::move(linear.b);
  made.c = changes.gain.matrix().asDiagonal() * linear.c;
  made.delay_s = (model.delay_samples() + changes.delay_samples) * period_s_;
  const Index states = made.a0.rows();
  made.coil_current = static_cast<Index>(model.layout().coil_current);
  CoupleMagnets(model, axes_, made);
  Eigen::MatrixXd shapes = shapes_;
  shapes.topRows(rigid_modes) /= std::sqrt(changes.mass);
  made.unbalance = Eigen::MatrixXcd::Zero(states, planes());
  const auto& at = model.layout();
  made.unbalance.middleRows(static_cast<Index>(at.v_x), shapes.rows()) = shapes;
  made.unbalance.middleRows(static_cast<Index>(at.v_y), shapes.rows()) =
      std::complex<double>(0.0, -1.0) * shapes;
  return made;
}

}  // namespace levitas::balancing
