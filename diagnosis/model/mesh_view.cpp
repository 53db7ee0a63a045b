#include "diagnosis/model/mesh_view.hpp"

namespace levitas::diagnosis {
namespace {

using Complex = std::complex<double>;

WheelView WheelOf(const plant::PlantModel& model, const gear::Wheel& wheel,
                  const std::vector<double>& shape) {
  return {wheel.shaft,
          model.train().ratio[wheel.shaft],
          wheel.teeth,
          wheel.z_m,
          wheel.base_radius_m,
          wheel.eccentric_mass_kg,
          std::polar(wheel.runout_m, wheel.runout_phase_rad),
          shape};
}

}  // namespace

std::vector<MeshView> MeshesOf(const plant::PlantModel& model) {
  std::vector<MeshView> meshes;
  const auto& pairs = model.config().gears;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const gear::GearPair& pair = pairs[i];
    const plant::MeshModel& of = model.train().meshes[i];
    MeshView& mesh = meshes.emplace_back();
    mesh.name = pair.name;
    mesh.driving = WheelOf(model, pair.driving, of.driving_shape);
    mesh.driven = WheelOf(model, pair.driven, of.driven_shape);
    mesh.shape = of.shape;
    mesh.normal = {of.law.normal.x, of.law.normal.y};
    mesh.isotropic = pair.direction == gear::Direction::kIsotropic;
    mesh.stiffness_n_per_m = pair.stiffness_n_per_m;
    mesh.damping_n_s_per_m = pair.damping_n_s_per_m;
    mesh.preload_n = of.law.preload_n;
    mesh.half_backlash_m = 0.5 * pair.imperfection.backlash_m;
    mesh.error = pair.transmission_error;
  }
  return meshes;
}

void MeshView::Impose(double angle_rad, double speed_rad_per_s, Complex& delta_m,
                      Complex& rate_m_per_s) const noexcept {
  Complex delta;
  Complex rate;
  // Every prescribed line: its amplitude, its order of the first shaft's rotation.
  const auto add = [&](Complex amplitude, double order) {
    const Complex line = amplitude * std::polar(1.0, order * angle_rad);
    delta += line;
    rate += Complex(0.0, order * speed_rad_per_s) * line;
  };
  add(driving.runout_m, driving.ratio);
  add(-driven.runout_m, driven.ratio);
  for (const gear::Harmonic& h : error) {
    add(-std::polar(h.amplitude_m, h.phase_rad), h.order * engagement());
  }
  delta_m = Seen(delta);
  rate_m_per_s = Seen(rate);
}

TeethMoment MeshView::At(double angle_rad, double speed_rad_per_s, const float* q,
                         const float* v) const noexcept {
  const std::size_t modes = shape.size();
  Complex delta;
  Complex rate;
  for (std::size_t i = 0; i < modes; ++i) {
    delta += shape[i] * Complex(static_cast<double>(q[i]), static_cast<double>(q[modes + i]));
    rate += shape[i] * Complex(static_cast<double>(v[i]), static_cast<double>(v[modes + i]));
  }
  Complex imposed;
  Complex imposed_rate;
  Impose(angle_rad, speed_rad_per_s, imposed, imposed_rate);
  delta = Seen(delta) + imposed;
  rate = Seen(rate) + imposed_rate;
  return {static_cast<float>(delta.real()), static_cast<float>(delta.imag()),
          static_cast<float>(rate.real()), static_cast<float>(rate.imag())};
}

}  // namespace levitas::diagnosis
