#include "plant_sim/plant/linear_parts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plant_sim/effect/coil.hpp"
#include "plant_sim/effect/eddy_current.hpp"
#include "plant_sim/plant/eigen_index.hpp"

namespace levitas::plant {
namespace {

using Index = Eigen::Index;

// A lag faster than this is no lag to a loop sampled at kilohertz, and would cost digits.
constexpr double kFastestLagPerSecond = 1e9;

Eigen::Map<const Eigen::VectorXd> Vector(const std::vector<double>& values) {
  return {values.data(), At(values.size())};
}

/// First displacement and velocity state of the x or y plane.
Index Displacement(const StateLayout& at, int plane) { return At(plane == 0 ? at.q_x : at.q_y); }
Index Velocity(const StateLayout& at, int plane) { return At(plane == 0 ? at.v_x : at.v_y); }

/// Displacement along a plane at a bearing, relative to its housing.
Eigen::RowVectorXd Seen(const PlantModel& model, std::size_t bearing, int plane,
                        const std::vector<double>& shape, Index states) {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(states);
  row.segment(Displacement(model.layout(), plane), At(shape.size())) = Vector(shape).transpose();
  const std::size_t housing = model.effects().bearings[bearing].housing_state;
  if (housing != kNoState) row[At(housing) + plane] = -1.0;
  return row;
}

/// Displacement along an axis of the magnet, which may be turned.
Eigen::RowVectorXd InMagnetAxis(const PlantModel& model, std::size_t axis, Index states) {
  const std::size_t bearing = axis / 2;
  const BearingEffects& effects = model.effects().bearings[bearing];
  const double sine = axis % 2 == 0 ? effects.sine : -effects.sine;
  const int own = static_cast<int>(axis % 2);
  return effects.cosine * SeenByMagnet(model, bearing, own, states) +
         sine * SeenByMagnet(model, bearing, 1 - own, states);
}

void AddHousing(const BearingEffects& effects, Eigen::MatrixXd& a) {
  if (effects.housing_state == kNoState) return;
  const double w = effects.housing_rad_per_s;
  for (Index plane = 0; plane < 2; ++plane) {
    const Index position = At(effects.housing_state) + plane;
    const Index velocity = position + 2;
    a(position, velocity) = 1.0;
    a(velocity, position) -= w * w;
    a(velocity, velocity) -= 2.0 * effects.housing_damping_ratio * w;
  }
}

}  // namespace

Slopes SlopesAtCentre(const PlantModel& model, std::size_t bearing) {
  const BearingEffects& effects = model.effects().bearings[bearing];
  const magnet::Magnet& magnet = model.bearings()[bearing].magnet;
  const double bias_a = model.config().bearings[bearing].magnet.bias_current_a;
  Eigen::Vector2d ki;
  Eigen::Vector2d ks;
  for (Index i = 0; i < 2; ++i) {
    const MagnetEffects& e = effects.axis[static_cast<std::size_t>(i)];
    const double flux_a = effect::Saturated(bias_a, e.per_knee_1_per_a, e.knee_exponent);
    const double slope = effect::SaturatedSlope(bias_a, e.per_knee_1_per_a, e.knee_exponent);
    const double share = 0.5 * (e.towards * e.towards + e.away * e.away);
    ki[i] = share * e.gain * slope * magnet::ForcePerCurrent(magnet, flux_a);
    ks[i] = share * magnet::NegativeStiffness(magnet, flux_a) + e.stiffness_n_per_m;
  }
  Eigen::Matrix2d turn;
  turn << effects.cosine, -effects.sine, effects.sine, effects.cosine;
  Eigen::Matrix2d of_current = ki.asDiagonal();
  const double across = effects.coupling * magnet::ForcePerCurrent(magnet, bias_a);
  of_current(0, 1) = of_current(1, 0) = across;
  return {turn * of_current, turn * ks.asDiagonal() * turn.transpose()};
}

Eigen::VectorXd Reaction(const PlantModel& model, std::size_t bearing, int plane, Index states) {
  Eigen::VectorXd column = Eigen::VectorXd::Zero(states);
  const auto shape = Vector(model.bearings()[bearing].actuator_shape);
  column.segment(Velocity(model.layout(), plane), shape.size()) = shape;
  const BearingEffects& effects = model.effects().bearings[bearing];
  if (effects.housing_state != kNoState) {
    column[At(effects.housing_state) + 2 + plane] = -1.0 / effects.housing_mass_kg;
  }
  return column;
}

Eigen::RowVectorXd SeenByMagnet(const PlantModel& model, std::size_t bearing, int plane,
                                Eigen::Index states) {
  return Seen(model, bearing, plane, model.bearings()[bearing].actuator_shape, states);
}

Eigen::RowVectorXd Flux(const PlantModel& model, std::size_t axis, Eigen::MatrixXd& a) {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(a.cols());
  const MagnetEffects& magnet = model.effects().bearings[axis / 2].axis[axis % 2];
  const Index coil = At(model.layout().coil_current + axis);
  row[coil] = 1.0;
  if (magnet.hysteresis_state != kNoState) {
    const Index z = At(magnet.hysteresis_state);
    a(z, z) = -2.0 * std::numbers::pi * model.amplifier_bandwidth_hz(axis);
  }
  if (magnet.eddy_state == kNoState) return row;
  const effect::EddyLags& eddy = effect::Eddy();
  const bool lags = magnet.eddy_tau_s > 0.0;
  // ic + (ks/ki) x lags as one; the displacement's own force is added without a lag elsewhere.
  Eigen::RowVectorXd displacement = Eigen::RowVectorXd::Zero(a.cols());
  if (lags) {
    displacement = magnet.eddy_a_per_m * InMagnetAxis(model, axis, a.cols());
    row[coil] = eddy.direct;
    row += (eddy.direct - 1.0) * displacement;
  }
  for (std::size_t k = 0; k < effect::kEddyLags; ++k) {
    const Index state = At(magnet.eddy_state + k);
    const double rate = std::min(eddy.rate[k] / magnet.eddy_tau_s, kFastestLagPerSecond);
    a(state, state) = -rate;
    a.row(state) += rate * displacement;
    a(state, coil) = rate;
    if (lags) row[state] = eddy.gain[k];
  }
  return row;
}

void AddRotor(const PlantModel& model, double speed_rad_per_s, Eigen::MatrixXd& a) {
  const StateLayout& at = model.layout();
  const Index n = At(at.modes);
  const auto w = Vector(model.frequency()).array();
  const auto damping = Vector(model.damping_ratio()).array();
  const Eigen::Map<const Eigen::MatrixXd> gyroscopic(model.gyroscopic().data(), n, n);
  for (int plane = 0; plane < 2; ++plane) {
    const Index q = Displacement(at, plane);
    const Index v = Velocity(at, plane);
    a.block(q, v, n, n).setIdentity();
    a.block(v, q, n, n) = (-w.square()).matrix().asDiagonal();
    a.block(v, v, n, n) = (-2.0 * damping * w).matrix().asDiagonal();
  }
  if (model.guided()) {
    const double guide = 2.0 * std::numbers::pi * kGuideFrequencyHz;
    a.block(At(at.v_y), At(at.q_y), n, n).diagonal().setConstant(-guide * guide);
    a.block(At(at.v_y), At(at.v_y), n, n).diagonal().setConstant(-2.0 * kGuideDamping * guide);
  }
  a.block(At(at.v_x), At(at.v_y), n, n) = -speed_rad_per_s * gyroscopic;
  a.block(At(at.v_y), At(at.v_x), n, n) = speed_rad_per_s * gyroscopic;
}

void AddShaftEffects(const PlantModel& model, double speed_rad_per_s, Eigen::MatrixXd& a) {
  const StateLayout& at = model.layout();
  const Index n = At(at.modes);
  for (const PlaneSpring& spring : model.effects().springs) {
    const Eigen::MatrixXd square = Vector(spring.shape) * Vector(spring.shape).transpose();
    a.block(At(at.v_x), At(at.q_x), n, n) -= spring.xx * square;
    a.block(At(at.v_x), At(at.q_y), n, n) -= spring.xy * square;
    a.block(At(at.v_y), At(at.q_x), n, n) -= spring.yx * square;
    a.block(At(at.v_y), At(at.q_y), n, n) -= spring.yy * square;
  }
  for (const RotatingDamper& damper : model.effects().dampers) {
    const Eigen::MatrixXd square =
        damper.damping_n_s_per_m * Vector(damper.shape) * Vector(damper.shape).transpose();
    a.block(At(at.v_x), At(at.v_x), n, n) -= square;
    a.block(At(at.v_y), At(at.v_y), n, n) -= square;
    a.block(At(at.v_x), At(at.q_y), n, n) -= speed_rad_per_s * square;
    a.block(At(at.v_y), At(at.q_x), n, n) += speed_rad_per_s * square;
  }
}

void AddMagnets(const PlantModel& model, std::size_t bearing, const Slopes& slopes,
                Eigen::MatrixXd& a) {
  for (int from = 0; from < 2; ++from) {
    const Eigen::RowVectorXd seen = SeenByMagnet(model, bearing, from, a.cols());
    const Eigen::RowVectorXd flux = Flux(model, 2 * bearing + static_cast<std::size_t>(from), a);
    for (int to = 0; to < 2; ++to) {
      a += Reaction(model, bearing, to, a.rows()) *
           (slopes.displacement(to, from) * seen + slopes.current(to, from) * flux);
    }
  }
  AddHousing(model.effects().bearings[bearing], a);
}

void AddSensors(const PlantModel& model, std::size_t bearing, Eigen::MatrixXd& a) {
  const auto [c, s] = model.effects().turns[bearing];
  Eigen::Matrix2d turn;
  turn << c, s, -s, c;
  for (int to = 0; to < 2; ++to) {
    const std::size_t axis = 2 * bearing + static_cast<std::size_t>(to);
    const ReadingEffects& reading = model.effects().readings[axis];
    const Index filter = At(model.layout().sensor + axis);
    const double rate = 2.0 * std::numbers::pi * reading.bandwidth_hz;
    Index driven = filter;
    double drive = rate * reading.gain;
    if (model.bearings()[bearing].filter == SensorFilter::kButterworth2) {
      // s'' + 2 z w s' + w^2 s = w^2 g p
      driven = At(model.layout().sensor_rate() + axis);
      drive *= rate;
      a(filter, driven) = 1.0;
      a(driven, filter) = -rate * rate;
      a(driven, driven) = -2.0 * sensor::kButterworthDamping * rate;
    } else {
      a(filter, filter) = -rate;
      // Of a rig whose other probes have the state: it is there, decays and acts on nothing.
      if (model.layout().sensor_rates > 0) {
        const Index unused = At(model.layout().sensor_rate() + axis);
        a(unused, unused) = -rate;
      }
    }
    const sensor::Characteristic& curve = model.bearings()[bearing].characteristic;
    if (!curve.straight()) drive *= curve.SlopeAtCentre();
    for (int from = 0; from < 2; ++from) {
      a.row(driven) += drive * turn(to, from) *
                       Seen(model, bearing, from, model.bearings()[bearing].sensor_shape, a.cols());
    }
  }
}

}  // namespace levitas::plant
