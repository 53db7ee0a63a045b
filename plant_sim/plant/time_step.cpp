#include "plant_sim/plant/time_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "plant_sim/plant/applied_effects/effect_forces.hpp"

namespace levitas::plant {
namespace {

// The number of modes: a run-time number, or for the usual ones (eight per plane; two or four of
// geared shafts) one that the compiler knows, which makes the loops below straight vector code (1.5
// times as fast).
using AnyModes = std::size_t;
template <std::size_t kModes>
using Fixed = std::integral_constant<std::size_t, kModes>;

// Sums of shape times modal coordinate in both planes. Two partial sums each let the processor use
// both lanes; the order is fixed, so the bits are too.
template <class Count>
std::array<double, 2> BothPlanes(Count modes, const double* __restrict shape,
                                 const double* __restrict modal) noexcept {
  double x_even = 0.0;
  double x_odd = 0.0;
  double y_even = 0.0;
  double y_odd = 0.0;
  std::size_t i = 0;
  for (; i + 1 < modes; i += 2) {
    x_even += shape[i] * modal[i];
    x_odd += shape[i + 1] * modal[i + 1];
    y_even += shape[i] * modal[modes + i];
    y_odd += shape[i + 1] * modal[modes + i + 1];
  }
  if (i < modes) {
    x_even += shape[i] * modal[i];
    y_even += shape[i] * modal[modes + i];
  }
  return {x_even + x_odd, y_even + y_odd};
}

// acceleration += (fx, fy) at the plane of `shape`
template <class Count>
void Project(Count modes, const double* __restrict shape, double fx_n, double fy_n,
             double* __restrict acceleration) noexcept {
  for (std::size_t i = 0; i < modes; ++i) acceleration[i] += shape[i] * fx_n;
  for (std::size_t i = 0; i < modes; ++i) acceleration[modes + i] += shape[i] * fy_n;
}

// - W G v_y in the x plane, + W G v_x in the y plane, (10). By columns, so that rows are vectors.
template <class Count>
void AddGyroscopic(Count modes, const double* __restrict gyroscopic, double speed_rad_per_s,
                   const double* __restrict velocity, double* __restrict acceleration) noexcept {
  for (std::size_t column = 0; column < modes; ++column) {
    const double* __restrict g = gyroscopic + column * modes;
    const double from_x = speed_rad_per_s * velocity[column];
    const double from_y = speed_rad_per_s * velocity[modes + column];
    for (std::size_t i = 0; i < modes; ++i) acceleration[i] -= g[i] * from_y;
    for (std::size_t i = 0; i < modes; ++i) acceleration[modes + i] += g[i] * from_x;
  }
}

template <class Count>
void AddSteadyForces(Count modes, const PlantModel& model, const Spin& spin,
                     double* __restrict acceleration) noexcept {
  const double* __restrict gravity = model.gravity().data();
  if (spin.unbalance_real == 0.0 && spin.unbalance_imaginary == 0.0) {
    for (std::size_t i = 0; i < 2 * modes; ++i) acceleration[i] = gravity[i];
    return;
  }
  const double* __restrict real = model.unbalance().data();
  const double* __restrict imaginary = real + modes;
  const double c = spin.unbalance_real;
  const double s = spin.unbalance_imaginary;
  for (std::size_t i = 0; i < modes; ++i) {
    acceleration[i] = gravity[i] + (c * real[i] - s * imaginary[i]);
  }
  for (std::size_t i = 0; i < modes; ++i) {
    acceleration[modes + i] = gravity[modes + i] + (c * imaginary[i] + s * real[i]);
  }
}

template <class Count>
void AddBearing(Count modes, const BearingModel& b, const Currents& currents, std::size_t axis,
                double speed_rad_per_s, const double* position, const double* velocity,
                double* acceleration, ForceReport& report) noexcept {
  const double* shape = b.actuator_shape.data();
  const auto [x_m, y_m] = BothPlanes(modes, shape, position);
  double fx_n = magnet::Force(b.magnet, currents.bias_a[axis], currents.control_a[axis], x_m);
  double fy_n = b.x_only ? 0.0
                         : magnet::Force(b.magnet, currents.bias_a[axis + 1],
                                         currents.control_a[axis + 1], y_m);
  if (b.has_touchdown && support::Touches(b.touchdown, x_m, y_m)) {
    const auto [vx_m_per_s, vy_m_per_s] = BothPlanes(modes, shape, velocity);
    const auto contact = support::Push(b.touchdown, x_m, y_m, vx_m_per_s, vy_m_per_s,
                                       b.speed_ratio * speed_rad_per_s);
    fx_n += contact.x_n;
    fy_n += contact.y_n;
    Report(b.touchdown, contact, b.speed_ratio, report);
  }
  Project(modes, shape, fx_n, fy_n, acceleration);
}

// The same with effects: turned or uneven magnets, rubbing rings, a housing that moves.
template <class Count>
void AddBearingWithEffects(Count modes, const BearingModel& b, const BearingEffects& effects,
                           const Currents& currents, std::size_t axis, double speed_rad_per_s,
                           const double* position, const double* velocity, double* acceleration,
                           ForceReport& report, const Housings* housings) noexcept {
  const double* shape = b.actuator_shape.data();
  auto [x_m, y_m] = BothPlanes(modes, shape, position);
  auto [vx_m_per_s, vy_m_per_s] = BothPlanes(modes, shape, velocity);
  if (housings != nullptr) {
    x_m -= housings->position_m[axis];
    y_m -= housings->position_m[axis + 1];
    vx_m_per_s -= housings->velocity_m_per_s[axis];
    vy_m_per_s -= housings->velocity_m_per_s[axis + 1];
  }
  PlaneForce force = MagnetWithEffects(b, effects, currents, axis, x_m, y_m);
  if (b.x_only) force.y_n = 0.0;
  const PlaneForce rub = Rub(b, effects, x_m, y_m, vx_m_per_s, vy_m_per_s, speed_rad_per_s, report);
  force.x_n += rub.x_n;
  force.y_n += rub.y_n;
  if (b.has_touchdown && support::Touches(b.touchdown, x_m, y_m)) {
    const auto contact = support::Push(b.touchdown, x_m, y_m, vx_m_per_s, vy_m_per_s,
                                       b.speed_ratio * speed_rad_per_s);
    force.x_n += contact.x_n;
    force.y_n += contact.y_n;
    Report(b.touchdown, contact, b.speed_ratio, report);
  }
  report.bearing_n[axis] = force.x_n;
  report.bearing_n[axis + 1] = force.y_n;
  Project(modes, shape, force.x_n, force.y_n, acceleration);
}

template <class Count>
void Forces(Count modes, const PlantModel& model, const Currents& currents, const Spin& spin,
            const double* position, const double* velocity, double* acceleration,
            ForceReport& report, const Housings* housings) noexcept {
  report.friction_n_m = 0.0;
  report.slip_rad_per_s = 0.0;
  AddSteadyForces(modes, model, spin, acceleration);
  if (spin.speed_rad_per_s != 0.0) {
    AddGyroscopic(modes, model.gyroscopic().data(), spin.speed_rad_per_s, velocity, acceleration);
  }
  if (spin.train != nullptr) {
    AddTrain(model.train(), *spin.train, modes, position, velocity, acceleration);
  }
  std::size_t axis = 0;
  const EffectModel& effects = model.effects();
  if (effects.magnets) {
    for (const BearingModel& b : model.bearings()) {
      AddBearingWithEffects(modes, b, effects.bearings[axis / 2], currents, axis,
                            spin.speed_rad_per_s, position, velocity, acceleration, report,
                            housings);
      axis += 2;
    }
  } else {
    for (const BearingModel& b : model.bearings()) {
      AddBearing(modes, b, currents, axis, spin.speed_rad_per_s, position, velocity, acceleration,
                 report);
      axis += 2;
    }
  }
  if (effects.motions) AddEffectForces(model, spin, position, velocity, acceleration);
}

// A housing under the reaction of its bearing, n = -F/m: predicted from the force at the start.
void PredictHousings(const PlantModel& model, const StepTable& table, const AxisArray& force_n,
                     const Housings& now, Housings& end) noexcept {
  for (std::size_t axis = 0; axis < model.axes(); ++axis) {
    const BearingEffects& bearing = model.effects().bearings[axis / 2];
    if (bearing.housing_state == kNoState) continue;
    const ModeStep& step = table.housing[axis / 2];
    const double n = -force_n[axis] / bearing.housing_mass_kg;
    const double u = now.position_m[axis];
    const double v = now.velocity_m_per_s[axis];
    end.position_m[axis] = step.xx * u + step.xv * v + step.x0 * n;
    end.velocity_m_per_s[axis] = step.vx * u + step.vv * v + step.v0 * n;
  }
}

// ... and corrected by what the force became.
void CorrectHousings(const PlantModel& model, const StepTable& table, const AxisArray& start_n,
                     const AxisArray& end_n, const Housings& predicted, Housings& now) noexcept {
  for (std::size_t axis = 0; axis < model.axes(); ++axis) {
    const BearingEffects& bearing = model.effects().bearings[axis / 2];
    if (bearing.housing_state == kNoState) continue;
    const ModeStep& step = table.housing[axis / 2];
    const double change = -(end_n[axis] - start_n[axis]) / bearing.housing_mass_kg;
    now.position_m[axis] = predicted.position_m[axis] + step.x1 * change;
    now.velocity_m_per_s[axis] = predicted.velocity_m_per_s[axis] + step.v1 * change;
  }
}

// Free motion and constant force, (35).
template <class Count>
void Predict(Count count, const StepTable& table, const double* __restrict position,
             const double* __restrict velocity, const double* __restrict force,
             double* __restrict x, double* __restrict v) noexcept {
  const double* __restrict xx = table.xx.data();
  const double* __restrict xv = table.xv.data();
  const double* __restrict x0 = table.x0.data();
  for (std::size_t i = 0; i < count; ++i) {
    x[i] = xx[i] * position[i] + xv[i] * velocity[i] + x0[i] * force[i];
  }
  const double* __restrict vx = table.vx.data();
  const double* __restrict vv = table.vv.data();
  const double* __restrict v0 = table.v0.data();
  for (std::size_t i = 0; i < count; ++i) {
    v[i] = vx[i] * position[i] + vv[i] * velocity[i] + v0[i] * force[i];
  }
}

// What the change of force over the substep adds, (36).
template <class Count>
void Correct(Count count, const StepTable& table, const double* __restrict start,
             const double* __restrict end, const double* __restrict x, const double* __restrict v,
             double* __restrict position, double* __restrict velocity) noexcept {
  const double* __restrict x1 = table.x1.data();
  const double* __restrict v1 = table.v1.data();
  for (std::size_t i = 0; i < count; ++i) position[i] = x[i] + x1[i] * (end[i] - start[i]);
  for (std::size_t i = 0; i < count; ++i) velocity[i] = v[i] + v1[i] * (end[i] - start[i]);
}

// Calls `function` with the number of modes, and of all coordinates, as constants where they are
// kept for it.
template <class Function>
void WithModes(const PlantModel& model, const Function& function) noexcept {
  const std::size_t modes = model.layout().modes;
  if (modes == 8 && model.layout().twists == 0) {
    function(Fixed<8>{}, Fixed<16>{});
  } else if (modes == 4) {
    function(Fixed<4>{}, AnyModes{model.coordinates()});
  } else if (modes == 2) {
    function(Fixed<2>{}, AnyModes{model.coordinates()});
  } else {
    function(AnyModes{modes}, AnyModes{model.coordinates()});
  }
}

}  // namespace

void Report(const support::Touchdown& ring, const support::Contact& contact, double ratio,
            ForceReport& report) noexcept {
  report.contact_n = std::max(report.contact_n, contact.normal_n);
  if (!(contact.normal_n > 0.0) || !(ring.journal_radius_m > 0.0)) return;
  report.friction_n_m += ratio * contact.tangential_n * ring.journal_radius_m;
  report.slip_rad_per_s = std::max(
      report.slip_rad_per_s, std::abs(contact.sliding_m_per_s / (ratio * ring.journal_radius_m)));
}

Heading MakeHeading(const Rotation& rotation) noexcept {
  return {std::cos(rotation.angle_rad), std::sin(rotation.angle_rad)};
}

Spin MakeSpin(const Rotation& rotation, const Heading& heading) noexcept {
  const double square = rotation.speed_rad_per_s * rotation.speed_rad_per_s;
  const double change = rotation.acceleration_rad_per_s2;
  return {rotation.speed_rad_per_s,
          square * heading.cosine + change * heading.sine,
          square * heading.sine - change * heading.cosine,
          nullptr,
          heading.cosine,
          heading.sine};
}

double AtPlane(const std::vector<double>& shape, const double* modal) noexcept {
  double sum = 0.0;
  for (std::size_t i = 0; i < shape.size(); ++i) sum += shape[i] * modal[i];
  return sum;
}

void AtPlanes(const PlantModel& model, const std::vector<double>& shape, const double* position,
              double& x_m, double& y_m) noexcept {
  WithModes(model, [&](auto modes, auto) {
    const auto both = BothPlanes(modes, shape.data(), position);
    x_m = both[0];
    y_m = both[1];
  });
}

void ModalForces(const PlantModel& model, const Currents& currents, const Spin& spin,
                 const double* position, const double* velocity, double* acceleration,
                 ForceReport& report, const Housings* housings) noexcept {
  WithModes(model, [&](auto modes, auto) {
    Forces(modes, model, currents, spin, position, velocity, acceleration, report, housings);
  });
}

void StepRotor(const PlantModel& model, const StepTable& table, const Currents& start_currents,
               const Currents& end_currents, const Spin& start_spin, const Spin& end_spin,
               double* position, double* velocity, Workspace& work, ForceReport& report,
               Housings* housings) noexcept {
  double* start = work.start.data();
  double* end = work.end.data();
  double* x = work.position.data();
  double* v = work.velocity.data();
  WithModes(model, [&](auto modes, auto count) {
    Forces(modes, model, start_currents, start_spin, position, velocity, start, report, housings);
    Predict(count, table, position, velocity, start, x, v);
    if (housings == nullptr) {
      Forces(modes, model, end_currents, end_spin, x, v, end, report, nullptr);
    } else {
      const AxisArray start_n = report.bearing_n;
      Housings predicted;
      PredictHousings(model, table, start_n, *housings, predicted);
      Forces(modes, model, end_currents, end_spin, x, v, end, report, &predicted);
      CorrectHousings(model, table, start_n, report.bearing_n, predicted, *housings);
    }
    Correct(count, table, start, end, x, v, position, velocity);
  });
}

}  // namespace levitas::plant
