#include "identification/geared/joint_unknowns.hpp"

#include <algorithm>
#include <cmath>

#include "identification/geared/shaft_equations.hpp"

namespace levitas::identification {
namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;

constexpr Index kPinionKs = 0, kPinionKi = 1, kGearKs = 2, kGearKi = 3, kMesh = 4;
constexpr Index kPinionRunOut = 6, kGearRunOut = 8, kErrors = 10;
/// Of a shaft's corrections, as Correctable() counts them.
constexpr Index kTiltInertia = 3;
constexpr double kElsewhere = 1.5;

double Size(double value) { return std::max(std::abs(value), 1e-300); }

Index Own() { return static_cast<Index>(Correctable().size()); }

}  // namespace

JointUnknowns::JointUnknowns(const GearedKnown& known, const GearedParameters& start)
    : known_(known), base_(start) {
  const auto errors = static_cast<Index>(start.error.size());
  scale_.resize(kErrors + 2 * errors);
  scale_.head(kErrors) << Size(start.pinion.ks_n_per_m), Size(start.pinion.ki_n_per_a),
      Size(start.gear.ks_n_per_m), Size(start.gear.ki_n_per_a), Size(start.mesh_stiffness_n_per_m),
      Size(start.mesh_damping_n_s_per_m), Size(std::abs(start.pinion.run_out_m)),
      Size(std::abs(start.pinion.run_out_m)), Size(std::abs(start.gear.run_out_m)),
      Size(std::abs(start.gear.run_out_m));
  double largest = 1e-300;
  for (const TransmissionError& e : start.error) {
    largest = std::max(largest, std::abs(e.amplitude_m));
  }
  scale_.tail(2 * errors).setConstant(largest);

  start_ = Eigen::VectorXd::Zero(scale_.size() + corrections());
  start_.head(kErrors) << start.pinion.ks_n_per_m, start.pinion.ki_n_per_a, start.gear.ks_n_per_m,
      start.gear.ki_n_per_a, start.mesh_stiffness_n_per_m, start.mesh_damping_n_s_per_m,
      start.pinion.run_out_m.real(), start.pinion.run_out_m.imag(), start.gear.run_out_m.real(),
      start.gear.run_out_m.imag();
  for (Index h = 0; h < errors; ++h) {
    const Complex e = start.error[static_cast<std::size_t>(h)].amplitude_m;
    start_.segment<2>(kErrors + 2 * h) << e.real(), e.imag();
  }
  start_.head(scale_.size()).array() /= scale_.array();

  if (known.uncertainty <= 0.0) {
    hold_.resize(0, start_.size());
    return;
  }
  hold_ = Eigen::MatrixXd::Zero(corrections() + 2, start_.size());
  hold_.topRightCorner(corrections(), corrections())
      .diagonal()
      .setConstant(1.0 / known.uncertainty);
  Index row = corrections();
  for (const auto& [shaft, ks] : {std::pair{&known.pinion, kPinionKs}, {&known.gear, kGearKs}}) {
    const double ratio = shaft->ks_n_per_m / shaft->ki_n_per_a;
    hold_(row, ks) = scale_[ks] / (known.uncertainty * shaft->ks_n_per_m);
    hold_(row, ks + 1) = -ratio * scale_[ks + 1] / (known.uncertainty * shaft->ks_n_per_m);
    ++row;
  }
}

std::vector<Eigen::VectorXd> JointUnknowns::starts() const {
  std::vector<Eigen::VectorXd> all{start_};
  if (known_.uncertainty <= 0.0 || known_.pinion.tilt_stiffness_n_m <= 0.0) return all;
  const Index pinion = scale_.size() + kTiltInertia;
  const Index gear = pinion + Own();
  const double off = kElsewhere * known_.uncertainty;
  for (const double one : {0.0, -off, off}) {
    for (const double other : {0.0, -off, off}) {
      if (one == 0.0 && other == 0.0) continue;
      all.push_back(start_);
      all.back()[pinion] = one;
      all.back()[gear] = other;
    }
  }
  return all;
}

Index JointUnknowns::corrections() const {
  if (known_.uncertainty <= 0.0) return 0;
  const Index twists = known_.torsion ? known_.torsion->frequency_rad_per_s.size() : 0;
  return 2 * Own() + 2 * twists;
}

GearedParameters JointUnknowns::At(const Eigen::VectorXd& x) const {
  GearedParameters p = base_;
  const Eigen::VectorXd v = x.head(scale_.size()).cwiseProduct(scale_);
  p.pinion.ks_n_per_m = v[kPinionKs];
  p.pinion.ki_n_per_a = v[kPinionKi];
  p.gear.ks_n_per_m = v[kGearKs];
  p.gear.ki_n_per_a = v[kGearKi];
  p.mesh_stiffness_n_per_m = v[kMesh];
  p.mesh_damping_n_s_per_m = v[kMesh + 1];
  p.pinion.run_out_m = {v[kPinionRunOut], v[kPinionRunOut + 1]};
  p.gear.run_out_m = {v[kGearRunOut], v[kGearRunOut + 1]};
  for (std::size_t h = 0; h < p.error.size(); ++h) {
    const Index at = kErrors + 2 * static_cast<Index>(h);
    p.error[h].amplitude_m = {v[at], v[at + 1]};
  }
  p.corrected = known_;
  if (corrections() == 0) return p;
  Index at = scale_.size();
  for (ShaftKnown* shaft : {&p.corrected.pinion, &p.corrected.gear}) {
    for (const Numbers& numbers : Correctable()) Scale(*shaft, numbers, 1.0 + x[at++]);
  }
  if (!p.corrected.torsion) return p;
  TorsionKnown& torsion = *p.corrected.torsion;
  for (Index i = 0; i < torsion.frequency_rad_per_s.size(); ++i) {
    torsion.frequency_rad_per_s[i] *= 1.0 + x[at++];
    torsion.twist_m[i] *= 1.0 + x[at++];
  }
  return p;
}

void JointUnknowns::Take(const Eigen::VectorXd& x, const Eigen::VectorXd& sigma,
                         GearedParameters& p) const {
  const bool along = p.mean_along_line_unknown;
  const double condition = p.condition;
  p = At(x);
  p.condition = condition;
  p.mean_along_line_unknown = along;
  const Eigen::VectorXd s = sigma.head(scale_.size()).cwiseProduct(scale_);
  const auto both = [&s](Index at) { return std::hypot(s[at], s[at + 1]); };
  p.pinion.ks_sigma = s[kPinionKs];
  p.pinion.ki_sigma = s[kPinionKi];
  p.gear.ks_sigma = s[kGearKs];
  p.gear.ki_sigma = s[kGearKi];
  p.pinion.run_out_sigma = both(kPinionRunOut);
  p.gear.run_out_sigma = both(kGearRunOut);
  p.mesh_stiffness_sigma = s[kMesh];
  p.mesh_damping_sigma = s[kMesh + 1];
  for (std::size_t h = 0; h < p.error.size(); ++h) {
    TransmissionError& e = p.error[h];
    e.sigma = both(kErrors + 2 * static_cast<Index>(h));
    if (e.harmonic != 0 || !along) continue;
    const Complex unit = known_.torsion->normal;
    e.amplitude_m -= unit * (std::conj(unit) * e.amplitude_m).real();
  }
}

}  // namespace levitas::identification
