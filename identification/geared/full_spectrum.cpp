#include "identification/geared/full_spectrum.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "common/problem.hpp"

namespace levitas::identification {
namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;
using Kind = GearedLine::Kind;

const Complex kJ(0.0, 1.0);

Complex Impedance(const ShaftKnown& s, double w) {
  return Complex(s.stiffness_n_per_m - s.mass_kg * w * w, w * s.damping_n_s_per_m);
}

struct Solution {
  Eigen::VectorXd value, sigma;
  double condition{};
};

/// Columns scaled to unit length, so that units do not decide what counts as small.
Solution Solve(const Eigen::MatrixXd& design, const Eigen::VectorXd& right, const char* step) {
  const Eigen::VectorXd length = design.colwise().norm().cwiseMax(1e-300);
  const Eigen::MatrixXd scaled = design * length.cwiseInverse().asDiagonal();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd& s = svd.singularValues();
  if (design.rows() < design.cols() || s[s.size() - 1] < 1e-10 * s[0]) {
    throw BadInput(fmt::format(
        "full spectrum: the lines do not determine {} ({} equations, {} unknowns); record more "
        "speeds or more lines",
        step, design.rows(), design.cols()));
  }
  const Eigen::VectorXd value = svd.solve(right);
  const double freedom = std::max<double>(1.0, static_cast<double>(design.rows() - design.cols()));
  const double noise = std::sqrt((scaled * value - right).squaredNorm() / freedom);
  const Eigen::VectorXd spread =
      (svd.matrixV() * s.cwiseInverse().asDiagonal()).rowwise().norm() * noise;
  return {value.cwiseQuotient(length), spread.cwiseQuotient(length), s[0] / s[s.size() - 1]};
}

/// Adds a complex equation sum_k a_k x_k = b as two real rows.
class Equations {
 public:
  Equations(std::size_t lines, Index unknowns)
      : design(Eigen::MatrixXd::Zero(2 * static_cast<Index>(lines), unknowns)),
        right(Eigen::VectorXd::Zero(2 * static_cast<Index>(lines))) {}
  void Real(Index unknown, Complex a) {
    design(row_, unknown) += a.real();
    design(row_ + 1, unknown) += a.imag();
  }
  /// A complex unknown stands as real and imaginary part.
  void ComplexAt(Index unknown, Complex a) {
    Real(unknown, a);
    Real(unknown + 1, kJ * a);
  }
  void Close(Complex b) {
    right[row_] = b.real();
    right[row_ + 1] = b.imag();
    row_ += 2;
  }
  Eigen::MatrixXd design;
  Eigen::VectorXd right;

 private:
  Index row_{0};
};

void RefuseTooFew(const std::vector<GearedLine>& lines) {
  std::set<double> speeds;
  bool pinion = false;
  bool gear = false;
  for (const GearedLine& line : lines) {
    speeds.insert(line.speed_rad_per_s);
    pinion = pinion || line.kind == Kind::kPinion;
    gear = gear || line.kind == Kind::kGear;
  }
  if (speeds.size() < 2) {
    throw BadInput(
        "full spectrum: lines of one speed only; at least two speeds tell stiffness "
        "from damping and run-out from transmission error");
  }
  if (!pinion || !gear) {
    throw BadInput(fmt::format("full spectrum: no line {}: the run-out is not determined",
                               pinion ? "gear_1x" : "pinion_1x"));
  }
}

/// Sum of both shafts' equations: ks_p, ki_p, ks_g, ki_g, eps_p (2), eps_g (2).
Solution SolveShafts(const std::vector<GearedLine>& lines, const ShaftKnown& pinion,
                     const ShaftKnown& gear) {
  Equations eq(lines.size(), 8);
  for (const GearedLine& line : lines) {
    const double w = line.frequency_rad_per_s;
    eq.Real(0, line.pinion_m);
    eq.Real(1, -line.pinion_a);
    eq.Real(2, line.gear_m);
    eq.Real(3, -line.gear_a);
    if (line.kind == Kind::kPinion) eq.ComplexAt(4, pinion.mass_kg * w * w);
    if (line.kind == Kind::kGear) eq.ComplexAt(6, gear.mass_kg * w * w);
    eq.Close(Impedance(pinion, w) * line.pinion_m + Impedance(gear, w) * line.gear_m);
  }
  return Solve(eq.design, eq.right, "ks, ki and the run-outs");
}

/// Mesh force on the pinion, from what both shafts need: the mean of the two accounts.
Complex MeshForce(const GearedLine& line, const ShaftKnown& pinion, const ShaftKnown& gear,
                  const GearedParameters& p) {
  const double w = line.frequency_rad_per_s;
  Complex from_pinion = p.pinion.ks_n_per_m * line.pinion_m - p.pinion.ki_n_per_a * line.pinion_a -
                        Impedance(pinion, w) * line.pinion_m;
  Complex from_gear = Impedance(gear, w) * line.gear_m - p.gear.ks_n_per_m * line.gear_m +
                      p.gear.ki_n_per_a * line.gear_a;
  if (line.kind == Kind::kPinion) from_pinion += pinion.mass_kg * w * w * p.pinion.run_out_m;
  if (line.kind == Kind::kGear) from_gear -= gear.mass_kg * w * w * p.gear.run_out_m;
  return 0.5 * (from_pinion + from_gear);
}

void SolveMesh(const std::vector<GearedLine>& lines, const ShaftKnown& pinion,
               const ShaftKnown& gear, GearedParameters& p) {
  std::size_t count = 0;
  for (const GearedLine& line : lines) count += line.kind != Kind::kTransmissionError ? 1U : 0U;
  Equations eq(count, 2);
  for (const GearedLine& line : lines) {
    if (line.kind == Kind::kTransmissionError) continue;
    const Complex deflection =
        line.pinion_m - line.gear_m +
        (line.kind == Kind::kPinion ? p.pinion.run_out_m : -p.gear.run_out_m);
    eq.Real(0, deflection);
    eq.Real(1, kJ * line.frequency_rad_per_s * deflection);
    eq.Close(MeshForce(line, pinion, gear, p));
  }
  const Solution mesh = Solve(eq.design, eq.right, "mesh stiffness and damping");
  p.mesh_stiffness_n_per_m = mesh.value[0];
  p.mesh_stiffness_sigma = mesh.sigma[0];
  p.mesh_damping_n_s_per_m = mesh.value[1];
  p.mesh_damping_sigma = mesh.sigma[1];
}

void SolveErrors(const std::vector<GearedLine>& lines, const ShaftKnown& pinion,
                 const ShaftKnown& gear, GearedParameters& p) {
  std::map<int, std::vector<Complex>> found;
  for (const GearedLine& line : lines) {
    if (line.kind != Kind::kTransmissionError) continue;
    const Complex mesh(p.mesh_stiffness_n_per_m,
                       line.frequency_rad_per_s * p.mesh_damping_n_s_per_m);
    found[line.harmonic].push_back(line.pinion_m - line.gear_m -
                                   MeshForce(line, pinion, gear, p) / mesh);
  }
  for (const auto& [harmonic, values] : found) {
    Complex mean = 0.0;
    for (const Complex value : values) mean += value / static_cast<double>(values.size());
    double scatter = 0.0;
    for (const Complex value : values) scatter += std::norm(value - mean);
    const double n = std::max<double>(2.0, static_cast<double>(values.size()));
    p.error.push_back({harmonic, mean, std::sqrt(scatter / (n * (n - 1.0)))});
  }
}

}  // namespace

GearedParameters IdentifyGeared(const std::vector<GearedLine>& lines, const ShaftKnown& pinion,
                                const ShaftKnown& gear) {
  RefuseTooFew(lines);
  const Solution shafts = SolveShafts(lines, pinion, gear);
  const Eigen::VectorXd& v = shafts.value;
  const Eigen::VectorXd& s = shafts.sigma;
  GearedParameters p;
  p.condition = shafts.condition;
  p.pinion = {v[0], s[0], v[1], s[1], {v[4], v[5]}, std::hypot(s[4], s[5])};
  p.gear = {v[2], s[2], v[3], s[3], {v[6], v[7]}, std::hypot(s[6], s[7])};
  SolveMesh(lines, pinion, gear, p);
  SolveErrors(lines, pinion, gear, p);
  return p;
}

}  // namespace levitas::identification
