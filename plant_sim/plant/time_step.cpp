#include "plant_sim/plant/time_step.hpp"

#include <algorithm>
#include <cmath>

namespace levitas::plant {
namespace {

// acceleration += (fx, fy) at the plane of `shape`
void Project(const std::vector<double>& shape, double fx_n, double fy_n, std::size_t modes,
             double* __restrict acceleration) noexcept {
  const double* __restrict s = shape.data();
  for (std::size_t i = 0; i < modes; ++i) acceleration[i] += s[i] * fx_n;
  for (std::size_t i = 0; i < modes; ++i) acceleration[modes + i] += s[i] * fy_n;
}

// - W G v_y in the x plane, + W G v_x in the y plane, (10). By columns, so that rows are vectors.
void AddGyroscopic(const std::vector<double>& gyroscopic, double speed_rad_per_s, std::size_t modes,
                   const double* __restrict velocity, double* __restrict acceleration) noexcept {
  for (std::size_t column = 0; column < modes; ++column) {
    const double* __restrict g = gyroscopic.data() + column * modes;
    const double from_x = speed_rad_per_s * velocity[column];
    const double from_y = speed_rad_per_s * velocity[modes + column];
    for (std::size_t i = 0; i < modes; ++i) {
      acceleration[i] -= g[i] * from_y;
      acceleration[modes + i] += g[i] * from_x;
    }
  }
}

}  // namespace

Spin MakeSpin(const Rotation& rotation) noexcept {
  const double speed = rotation.speed_rad_per_s;
  const double change = rotation.acceleration_rad_per_s2;
  if (speed == 0.0 && change == 0.0) return {};
  const double c = std::cos(rotation.angle_rad);
  const double s = std::sin(rotation.angle_rad);
  return {speed, speed * speed * c + change * s, speed * speed * s - change * c};
}

double AtPlane(const std::vector<double>& shape, const double* modal) noexcept {
  // Two partial sums let the processor use both lanes; the order is fixed, so the bits are too.
  const double* __restrict s = shape.data();
  const std::size_t size = shape.size();
  double even = 0.0;
  double odd = 0.0;
  std::size_t i = 0;
  for (; i + 1 < size; i += 2) {
    even += s[i] * modal[i];
    odd += s[i + 1] * modal[i + 1];
  }
  if (i < size) even += s[i] * modal[i];
  return even + odd;
}

void ModalForces(const PlantModel& model, const Currents& currents, const Spin& spin,
                 const double* position, const double* velocity, double* acceleration,
                 ForceReport& report) noexcept {
  const std::size_t modes = model.layout().modes;
  const double* gravity = model.gravity().data();
  const double* real = model.unbalance().data();
  const double* imaginary = real + modes;
  for (std::size_t i = 0; i < modes; ++i) {
    acceleration[i] =
        gravity[i] + spin.unbalance_real * real[i] - spin.unbalance_imaginary * imaginary[i];
    acceleration[modes + i] = gravity[modes + i] + spin.unbalance_real * imaginary[i] +
                              spin.unbalance_imaginary * real[i];
  }
  if (spin.speed_rad_per_s != 0.0) {
    AddGyroscopic(model.gyroscopic(), spin.speed_rad_per_s, modes, velocity, acceleration);
  }
  std::size_t axis = 0;
  for (const BearingModel& b : model.bearings()) {
    const double x_m = AtPlane(b.actuator_shape, position);
    const double y_m = AtPlane(b.actuator_shape, position + modes);
    double fx_n = magnet::Force(b.magnet, currents.bias_a[axis], currents.control_a[axis], x_m);
    double fy_n =
        magnet::Force(b.magnet, currents.bias_a[axis + 1], currents.control_a[axis + 1], y_m);
    report.magnet_n[axis] = fx_n;
    report.magnet_n[axis + 1] = fy_n;
    if (b.has_touchdown && support::Touches(b.touchdown, x_m, y_m)) {
      const auto contact =
          support::Push(b.touchdown, x_m, y_m, AtPlane(b.actuator_shape, velocity),
                        AtPlane(b.actuator_shape, velocity + modes), spin.speed_rad_per_s);
      fx_n += contact.x_n;
      fy_n += contact.y_n;
      report.contact_n = std::max(report.contact_n, contact.normal_n);
    }
    Project(b.actuator_shape, fx_n, fy_n, modes, acceleration);
    axis += 2;
  }
}

void StepRotor(const PlantModel& model, const StepTable& table, const Currents& start_currents,
               const Currents& end_currents, const Spin& start_spin, const Spin& end_spin,
               double* position, double* velocity, Workspace& work, ForceReport& report) noexcept {
  const std::size_t count = 2 * model.layout().modes;
  double* __restrict start = work.start.data();
  double* __restrict end = work.end.data();
  double* __restrict x = work.position.data();
  double* __restrict v = work.velocity.data();
  ModalForces(model, start_currents, start_spin, position, velocity, start, report);
  {
    const double* __restrict xx = table.xx.data();
    const double* __restrict xv = table.xv.data();
    const double* __restrict vx = table.vx.data();
    const double* __restrict vv = table.vv.data();
    const double* __restrict x0 = table.x0.data();
    const double* __restrict v0 = table.v0.data();
    for (std::size_t i = 0; i < count; ++i) {
      x[i] = xx[i] * position[i] + xv[i] * velocity[i] + x0[i] * start[i];
      v[i] = vx[i] * position[i] + vv[i] * velocity[i] + v0[i] * start[i];
    }
  }
  ModalForces(model, end_currents, end_spin, x, v, end, report);
  const double* __restrict x1 = table.x1.data();
  const double* __restrict v1 = table.v1.data();
  for (std::size_t i = 0; i < count; ++i) {
    position[i] = x[i] + x1[i] * (end[i] - start[i]);
    velocity[i] = v[i] + v1[i] * (end[i] - start[i]);
  }
}

}  // namespace levitas::plant
