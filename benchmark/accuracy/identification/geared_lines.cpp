#include "benchmark/accuracy/identification/geared_lines.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <array>
#include <cmath>
#include <numbers>

#include "plant_sim/gear/mesh.hpp"
#include "plant_sim/magnet/magnet.hpp"

namespace levitas::accuracy {
namespace {

using Complex = std::complex<double>;
using identification::GearedLine;
using Kind = GearedLine::Kind;
using Index = Eigen::Index;
using Matrix = Eigen::MatrixXd;

const Complex kJ(0.0, 1.0);

magnet::Magnet MagnetOf(const plant::BearingConfig& b) {
  return {b.magnet.force_constant_n_m2_per_a2, b.magnet.gap_m, b.magnet.max_coil_current_a};
}
}  // namespace

double KsOf(const plant::BearingConfig& b) {
  return magnet::NegativeStiffness(MagnetOf(b), b.magnet.bias_current_a);
}
double KiOf(const plant::BearingConfig& b) {
  return magnet::ForcePerCurrent(MagnetOf(b), b.magnet.bias_current_a);
}

std::complex<double> ErrorOf(const gear::GearPair& pair, int order) {
  Complex sum = 0.0;
  for (const gear::Harmonic& h : pair.transmission_error) {
    if (h.order == order) sum += std::polar(h.amplitude_m, h.phase_rad);
  }
  return sum;
}

std::complex<double> RunOut(const gear::Wheel& wheel) {
  return std::polar(wheel.runout_m, wheel.runout_phase_rad);
}

namespace {

/// M q'' + C q' + K q in the real coordinates xp yp xg yg, then tilts, then torsion.
struct Rotor {
  Matrix mass, damping, stiffness;
  Matrix mesh;  ///< 2 x n: what of q is the relative displacement of the teeth
};

void AddTorsion(const plant::PlantConfig& rig, Index at, Rotor& r) {
  // Every shaft's line of springs, with the damping ratio of the modes that have stiffness.
  for (const rotor::Shaft& shaft : rig.shafts) {
    const auto& inertias = shaft.torsion.inertias;
    const auto n = static_cast<Index>(inertias.size());
    Matrix j = Matrix::Zero(n, n);
    Matrix k = Matrix::Zero(n, n);
    for (Index i = 0; i < n; ++i) {
      const auto& own = inertias[static_cast<std::size_t>(i)];
      j(i, i) = own.inertia_kg_m2;
      k(i, i) += own.ground_stiffness_n_m_per_rad;
      r.damping(at + i, at + i) += own.ground_damping_n_m_s_per_rad;
      if (i + 1 == n) break;
      k.block(i, i, 2, 2) += own.stiffness_n_m_per_rad * (Matrix(2, 2) << 1, -1, -1, 1).finished();
    }
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> modes(k, j);
    const Matrix to = j * modes.eigenvectors();
    const Eigen::VectorXd w = modes.eigenvalues().cwiseMax(0.0).cwiseSqrt();
    r.mass.block(at, at, n, n) += j;
    r.stiffness.block(at, at, n, n) += k;
    r.damping.block(at, at, n, n) +=
        to * (2.0 * shaft.torsion.damping_ratio * w).asDiagonal() * to.transpose();
    at += n;
  }
}

/// Translation of a shaft and, where it has some, its tilting.
void AddLateral(const rotor::LumpedShaft& l, Index s, double turns, bool tilts, Rotor& r) {
  for (Index axis = 0; axis < 2; ++axis) {
    const Index x = 2 * s + axis;
    r.mass(x, x) = l.mass_kg;
    r.damping(x, x) = l.damping_n_s_per_m;
    r.stiffness(x, x) = l.kll_n_per_m;
    r.mesh(axis, x) = s == 0 ? 1.0 : -1.0;
    if (!tilts) continue;
    const Index a = 4 + x;
    r.mass(a, a) = l.diametral_inertia_kg_m2;
    r.stiffness(a, a) = l.kaa_n_m;
    r.stiffness(x, a) = r.stiffness(a, x) = l.kla_n;
    // - j Ip W psi': the x equation has + Ip W psi_y', the y equation - Ip W psi_x'.
    r.damping(a, 4 + 2 * s + 1 - axis) += (axis == 0 ? 1.0 : -1.0) * l.polar_inertia_kg_m2 * turns;
  }
}

Rotor Assemble(const plant::PlantConfig& rig, double speed) {
  const bool tilts = rig.shafts[0].lumped.tilts;
  const Index lateral = tilts ? 8 : 4;
  Index size = lateral;
  for (const rotor::Shaft& s : rig.shafts) size += static_cast<Index>(s.torsion.inertias.size());
  Rotor r{Matrix::Zero(size, size), Matrix::Zero(size, size), Matrix::Zero(size, size),
          Matrix::Zero(2, size)};
  const gear::GearPair& pair = rig.gears.front();
  const gear::Vector n = gear::LineOfAction(pair.pressure_angle_rad);
  Index twist = lateral;
  for (Index s = 0; s < 2; ++s) {
    const rotor::Shaft& shaft = rig.shafts[static_cast<std::size_t>(s)];
    const double turns =
        s == 0 ? speed : -speed * pair.driving.teeth / static_cast<double>(pair.driven.teeth);
    AddLateral(shaft.lumped, s, turns, tilts, r);
    if (!shaft.torsion.inertias.empty()) {
      const double radius = s == 0 ? pair.driving.base_radius_m : pair.driven.base_radius_m;
      const Index at = twist + static_cast<Index>(shaft.torsion.gear_at);
      r.mesh(0, at) = radius * n.x;
      r.mesh(1, at) = radius * n.y;
      twist += static_cast<Index>(shaft.torsion.inertias.size());
    }
  }
  if (size > lateral) AddTorsion(rig, lateral, r);
  r.stiffness += pair.stiffness_n_per_m * r.mesh.transpose() * r.mesh;
  r.damping += pair.damping_n_s_per_m * r.mesh.transpose() * r.mesh;
  return r;
}

/// Forward and backward amplitudes of a vector in the plane, as x and y of exp(jwt), w > 0.
struct Plane {
  Complex x, y;
};
Plane FromWhirl(Complex forward, Complex backward) {
  return {forward + std::conj(backward), -kJ * (forward - std::conj(backward))};
}
Complex Forward(Complex x, Complex y) { return 0.5 * (x + kJ * y); }
Complex Backward(Complex x, Complex y) { return 0.5 * std::conj(x - kJ * y); }

class Loop {
 public:
  Loop(const plant::PlantConfig& rig, const GearedPlan& plan, double speed,
       const std::vector<AddedCurrent>& added)
      : rig_(rig), plan_(plan), speed_(speed), added_(added), rotor_(Assemble(rig, speed)) {}

  /// Both lines at +-w, w >= 0, from a tooth displacement and forces on the discs (forward,
  /// backward).
  void Add(double w, std::array<Complex, 2> teeth, std::array<Complex, 2> on_pinion,
           std::array<Complex, 2> on_gear, GearedLine forward, GearedLine backward,
           std::vector<GearedLine>& lines) const {
    const std::array<Complex, 2> to_pinion = AddedAt(w, 0);
    const std::array<Complex, 2> to_gear = AddedAt(w, 1);
    for (std::size_t side = 0; side < 2; ++side) {
      on_pinion[side] -= KiOf(rig_.bearings[0]) * to_pinion[side];
      on_gear[side] -= KiOf(rig_.bearings[1]) * to_gear[side];
    }
    const auto& pair = rig_.gears.front();
    const Complex current = plan_.kp_a_per_m + kJ * w * plan_.kd_a_s_per_m;
    const Plane d = FromWhirl(teeth[0], teeth[1]);
    const Complex mesh = pair.stiffness_n_per_m + kJ * w * pair.damping_n_s_per_m;
    Eigen::VectorXcd force =
        -rotor_.mesh.transpose().cast<Complex>() * (mesh * Eigen::Vector2cd(d.x, d.y));
    const Plane p = FromWhirl(on_pinion[0], on_pinion[1]);
    const Plane g = FromWhirl(on_gear[0], on_gear[1]);
    force.head(4) += Eigen::Vector4cd(p.x, p.y, g.x, g.y);
    const Eigen::VectorXcd q = Solve(DynamicStiffness(w, current), force, w);
    forward.speed_rad_per_s = backward.speed_rad_per_s = speed_;
    forward.frequency_rad_per_s = w;
    backward.frequency_rad_per_s = -w;
    forward.pinion_m = Forward(q[0], q[1]);
    forward.gear_m = Forward(q[2], q[3]);
    backward.pinion_m = Backward(q[0], q[1]);
    backward.gear_m = Backward(q[2], q[3]);
    forward.pinion_a = current * forward.pinion_m + to_pinion[0];
    forward.gear_a = current * forward.gear_m + to_gear[0];
    backward.pinion_a = std::conj(current) * backward.pinion_m + to_pinion[1];
    backward.gear_a = std::conj(current) * backward.gear_m + to_gear[1];
    if (w == 0.0) {  // both halves are the mean
      forward.pinion_m += backward.pinion_m;
      forward.gear_m += backward.gear_m;
      forward.pinion_a += backward.pinion_a;
      forward.gear_a += backward.gear_a;
    }
    // A line without excitation only says something where torsion couples both whirls.
    if (forward.kind != Kind::kMirror || keeps_mirrors_) lines.push_back(forward);
    if (w > 0.0 && (backward.kind != Kind::kMirror || keeps_mirrors_)) lines.push_back(backward);
  }
  void KeepMirrors() { keeps_mirrors_ = true; }

 private:
  /// Of rotor and magnets, with the law's current per displacement.
  [[nodiscard]] Eigen::MatrixXcd DynamicStiffness(double w, Complex current) const {
    Eigen::MatrixXcd dynamic = rotor_.stiffness.cast<Complex>() +
                               kJ * w * rotor_.damping.cast<Complex>() -
                               w * w * rotor_.mass.cast<Complex>();
    for (Index s = 0; s < 2; ++s) {
      const auto& bearing = rig_.bearings[static_cast<std::size_t>(s)];
      for (Index axis = 0; axis < 2; ++axis) {
        dynamic(2 * s + axis, 2 * s + axis) += KiOf(bearing) * current - KsOf(bearing);
      }
    }
    return dynamic;
  }

  /// Forward and backward at +-w.
  [[nodiscard]] std::array<Complex, 2> AddedAt(double w, std::size_t shaft) const {
    std::array<Complex, 2> sum{};
    for (const AddedCurrent& one : added_) {
      if (one.shaft != shaft || std::abs(one.frequency_rad_per_s) != w) continue;
      sum[one.frequency_rad_per_s < 0.0 ? 1 : 0] += one.current_a;
    }
    return sum;
  }

  /// At rest a train that turns freely takes no torque: its rotation gives way.
  static Eigen::VectorXcd Solve(const Eigen::MatrixXcd& dynamic, const Eigen::VectorXcd& force,
                                double w) {
    if (w > 0.0) return dynamic.partialPivLu().solve(force);
    return dynamic.completeOrthogonalDecomposition().solve(force);
  }

  const plant::PlantConfig& rig_;
  const GearedPlan& plan_;
  double speed_;
  const std::vector<AddedCurrent>& added_;
  Rotor rotor_;
  bool keeps_mirrors_{};
};

GearedLine Line(Kind kind, int harmonic = 0) {
  GearedLine line;
  line.kind = kind;
  line.harmonic = harmonic;
  return line;
}

}  // namespace

std::vector<GearedLine> LinesAt(const configuration::RigFile& rig, const GearedPlan& plan,
                                double speed, const std::vector<AddedCurrent>& added) {
  const gear::GearPair& pair = rig.plant.gears.front();
  const double gear_speed = speed * pair.driving.teeth / static_cast<double>(pair.driven.teeth);
  Loop loop(rig.plant, plan, speed, added);
  if (!rig.plant.shafts[0].torsion.inertias.empty()) loop.KeepMirrors();
  std::vector<GearedLine> lines;
  const GearedLine mirror = Line(Kind::kMirror);
  const Complex p = RunOut(pair.driving);
  const Complex g = RunOut(pair.driven);
  const Kind error = Kind::kTransmissionError;
  loop.Add(0.0, {-ErrorOf(pair, 0), 0.0}, {}, {}, Line(error), mirror, lines);
  loop.Add(speed, {p, 0.0}, {pair.driving.eccentric_mass_kg * speed * speed * p, 0.0}, {},
           Line(Kind::kPinion), mirror, lines);
  loop.Add(gear_speed, {0.0, -g}, {},
           {0.0, pair.driven.eccentric_mass_kg * gear_speed * gear_speed * g}, mirror,
           Line(Kind::kGear), lines);
  for (int i = 1; i <= 5; ++i) {
    loop.Add(i * pair.driving.teeth * speed, {-ErrorOf(pair, i), -ErrorOf(pair, -i)}, {}, {},
             Line(error, i), Line(error, -i), lines);
  }
  return lines;
}

}  // namespace levitas::accuracy
