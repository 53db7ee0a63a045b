#include "identification/geared/joint_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

#include "identification/geared/geared_forces.hpp"
#include "identification/geared/joint_unknowns.hpp"
#include "numerics/factors/factors.hpp"
#include "numerics/minimum/levenberg_marquardt.hpp"

namespace levitas::identification {
namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;
using Kind = GearedLine::Kind;

constexpr double kLoud = 0.01;
/// The normal equations cost as much as a dozen evaluations: damping moves in small steps, and the
/// search ends where an undamped step would gain a millionth of a noise variance.
constexpr numerics::LevenbergMarquardtOptions kOptions{.first_damping = 1e-3,
                                                       .lowered_by = 0.2,
                                                       .raised_by = 5.0,
                                                       .most_damping = 1e8,
                                                       .most_trials = 60,
                                                       .least_predicted_gain = 1e-6};
/// Cost per degree of freedom that noise alone hardly leaves: some hundred of them.
constexpr double kExplained = 1.5;
constexpr double kExact = 1e-4;
constexpr double kStep = 1e-5;
/// Readings of a line: two positions, two currents, each complex.
constexpr Index kReadings = 8;
constexpr Index kEquations = 4;

using Readings = std::array<Complex GearedLine::*, 4>;
constexpr Readings kRead{&GearedLine::pinion_m, &GearedLine::gear_m, &GearedLine::pinion_a,
                         &GearedLine::gear_a};

/// Lines that torsion couples: one frequency, forward and backward, of one speed.
using Group = std::vector<GearedLine>;

std::vector<Group> GroupsOf(const std::vector<GearedLine>& lines, bool torsion) {
  double position = 0.0;
  double current = 0.0;
  for (const GearedLine& l : lines) {
    position += std::norm(l.pinion_m) + std::norm(l.gear_m);
    current += std::norm(l.pinion_a) + std::norm(l.gear_a);
  }
  const auto readings = 2.0 * static_cast<double>(lines.size());
  const double least_m = kExact * std::sqrt(position / readings);
  const double least_a = kExact * std::sqrt(current / readings);
  std::vector<Group> groups;
  for (GearedLine line : lines) {
    line.sigma_m = std::max(line.sigma_m, least_m);
    line.sigma_a = std::max(line.sigma_a, least_a);
    const auto mirror = std::ranges::find_if(groups, [&](const Group& group) {
      const GearedLine& one = group.front();
      const double apart = std::abs(one.frequency_rad_per_s + line.frequency_rad_per_s);
      return torsion && one.speed_rad_per_s == line.speed_rad_per_s &&
             apart <= 1e-6 * std::abs(line.frequency_rad_per_s) && one.frequency_rad_per_s != 0.0;
    });
    if (mirror == groups.end()) {
      groups.push_back({line});
    } else {
      mirror->push_back(line);
    }
  }
  return groups;
}

/// What a group's lines need of torsion and elastic shafts; it does not depend on readings and
/// costs a dozen residuals.
struct OnLines {
  std::vector<Complex> per_force;  ///< TwistPerForceOn
  std::vector<LineGains> gains;
};

OnLines OnLinesOf(const Group& group, const GearedParameters& p) {
  return {TwistPerForceOn(group, p.corrected.torsion), GainsOn(group, p.corrected, p)};
}

/// Residuals of both equations of every line of the group [N]; linear in the readings.
Eigen::VectorXd Residual(const Group& group, const GearedParameters& p, const OnLines& on) {
  std::vector<MeshForces> forces;
  std::vector<Complex> force;
  Eigen::VectorXd residual(kEquations * static_cast<Index>(group.size()));
  for (std::size_t n = 0; n < group.size(); ++n) {
    forces.push_back(MeshForcesOf(group[n], p.corrected, p, on.gains[n]));
    force.push_back(0.5 * (forces[n].from_pinion + forces[n].from_gear));
  }
  const Complex normal = p.corrected.torsion ? p.corrected.torsion->normal : 0.0;
  const auto twist = TwistOnLines(group, force, on.per_force, normal);
  for (std::size_t n = 0; n < group.size(); ++n) {
    const GearedLine& line = group[n];
    const MeshForces& both = forces[n];
    const GearMotion gears = GearMotionOf(line, on.gains[n]);
    Complex deflection = gears.pinion_m - gears.gear_m + twist[n];
    if (line.kind == Kind::kPinion) deflection += p.pinion.run_out_m;
    if (line.kind == Kind::kGear) deflection -= p.gear.run_out_m;
    if (line.kind == Kind::kTransmissionError) {
      const auto own = std::ranges::find(p.error, line.harmonic, &TransmissionError::harmonic);
      if (own != p.error.end()) deflection -= own->amplitude_m;
    }
    const Complex mesh(p.mesh_stiffness_n_per_m,
                       line.frequency_rad_per_s * p.mesh_damping_n_s_per_m);
    const Complex sum = both.from_pinion - both.from_gear;
    const Complex teeth = force[n] - mesh * deflection;
    residual.segment<kEquations>(kEquations * static_cast<Index>(n)) =
        Eigen::Vector4d(sum.real(), sum.imag(), teeth.real(), teeth.imag());
  }
  return residual;
}

double SigmaOf(const GearedLine& line, std::size_t reading) {
  return (reading < 2 ? line.sigma_m : line.sigma_a) / std::sqrt(2.0);
}

/// Adds `share` standard deviations to one real number of a group.
void Move(Group& group, Index number, double share) {
  GearedLine& line = group[static_cast<std::size_t>(number / kReadings)];
  const auto reading = static_cast<std::size_t>(number % kReadings / 2);
  const double by = share * SigmaOf(line, reading);
  line.*kRead[reading] += number % 2 == 0 ? Complex(by, 0.0) : Complex(0.0, by);
}

/// A group's equations in units of their noise, with the lines as they are best explained.
struct Whitened {
  Eigen::VectorXd residual;
  Eigen::LLT<Eigen::MatrixXd> noise;
  Group explained;
  OnLines on;
};

Whitened Whiten(const Group& group, const GearedParameters& p) {
  OnLines on = OnLinesOf(group, p);
  const Eigen::VectorXd residual = Residual(group, p, on);
  const auto numbers = kReadings * static_cast<Index>(group.size());
  Eigen::MatrixXd by_noise(residual.size(), numbers);
  for (Index k = 0; k < numbers; ++k) {
    Group moved = group;
    Move(moved, k, 1.0);
    by_noise.col(k) = Residual(moved, p, on) - residual;
  }
  const Eigen::MatrixXd covariance = by_noise * by_noise.transpose();
  Whitened w{{}, Eigen::LLT<Eigen::MatrixXd>(covariance), group, std::move(on)};
  const Eigen::VectorXd shift = -by_noise.transpose() * w.noise.solve(residual);
  for (Index k = 0; k < numbers; ++k) Move(w.explained, k, shift[k]);
  w.residual = w.noise.matrixL().solve(residual);
  return w;
}

/// Every group's equations, and the known numbers that priors hold, as one sum of squares.
class JointProblem {
 public:
  using Iterate = numerics::Iterate<Eigen::VectorXd>;

  JointProblem(const std::vector<Group>& groups, const JointUnknowns& unknowns)
      : groups_(groups), unknowns_(unknowns) {}

  [[nodiscard]] Iterate At(Eigen::VectorXd x) const {
    const GearedParameters p = unknowns_.At(x);
    double cost = unknowns_.Held(x).squaredNorm();
    for (const Group& group : groups_) cost += Whiten(group, p).residual.squaredNorm();
    return {std::move(x), cost};
  }
  [[nodiscard]] Iterate Step(const Eigen::VectorXd& from, const Eigen::VectorXd& step) const {
    return At(from + step);
  }
  [[nodiscard]] std::optional<numerics::NormalEquations> Linearise(const Iterate& at) const {
    return EquationsAt(at.point);
  }
  [[nodiscard]] numerics::NormalEquations EquationsAt(const Eigen::VectorXd& x) const;

 private:
  const std::vector<Group>& groups_;
  const JointUnknowns& unknowns_;
};

/// Parameters with one unknown raised and lowered.
struct Sides {
  GearedParameters more, less;
  bool known;  ///< that unknown changes OnLines
};

/// Of the numbers of torsion that JointUnknowns corrects.
bool SameTorsion(const GearedParameters& a, const GearedParameters& b) {
  if (!a.corrected.torsion) return true;
  return a.corrected.torsion->frequency_rad_per_s == b.corrected.torsion->frequency_rad_per_s &&
         a.corrected.torsion->twist_m == b.corrected.torsion->twist_m;
}

bool SameGains(const ShaftKnown& a, const ShaftFound& of_a, const ShaftKnown& b,
               const ShaftFound& of_b) {
  return !a.elastic ||
         (a.mass_ratio == b.mass_ratio && a.damping_ratio == b.damping_ratio &&
          a.stiffness_ratio == b.stiffness_ratio && a.gyroscopic_ratio == b.gyroscopic_ratio &&
          of_a.ks_n_per_m == of_b.ks_n_per_m && of_a.ki_n_per_a == of_b.ki_n_per_a);
}

bool SameOnLines(const GearedParameters& a, const GearedParameters& b) {
  return SameTorsion(a, b) &&
         SameGains(a.corrected.pinion, a.pinion, b.corrected.pinion, b.pinion) &&
         SameGains(a.corrected.gear, a.gear, b.corrected.gear, b.gear);
}

/// Of the explained lines by the unknown of these sides.
Eigen::VectorXd SlopeOf(const Whitened& w, const Sides& sides) {
  const auto at = [&w, &sides](const GearedParameters& p) {
    return sides.known ? Residual(w.explained, p, OnLinesOf(w.explained, p))
                       : Residual(w.explained, p, w.on);
  };
  return (at(sides.more) - at(sides.less)) / (2.0 * kStep);
}

numerics::NormalEquations JointProblem::EquationsAt(const Eigen::VectorXd& x) const {
  const GearedParameters p = unknowns_.At(x);
  std::vector<Sides> sides;
  for (Index k = 0; k < x.size(); ++k) {
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(x.size(), k);
    Sides both{unknowns_.At(x + step), unknowns_.At(x - step), false};
    both.known = !SameOnLines(both.more, p);
    sides.push_back(std::move(both));
  }
  const Eigen::MatrixXd& hold = unknowns_.HeldBy();
  numerics::NormalEquations equations{hold.transpose() * hold,
                                      hold.transpose() * unknowns_.Held(x)};
  for (const Group& group : groups_) {
    const Whitened w = Whiten(group, p);
    Eigen::MatrixXd by_unknowns(w.residual.size(), x.size());
    for (Index k = 0; k < x.size(); ++k) {
      by_unknowns.col(k) = SlopeOf(w, sides[static_cast<std::size_t>(k)]);
    }
    const Eigen::MatrixXd jacobian = w.noise.matrixL().solve(by_unknowns);
    equations.matrix += jacobian.transpose() * jacobian;
    equations.gradient += jacobian.transpose() * w.residual;
  }
  return equations;
}

JointProblem::Iterate Fit(const std::vector<Group>& groups, const JointUnknowns& unknowns,
                          const Eigen::VectorXd& start) {
  JointProblem problem(groups, unknowns);
  return numerics::LevenbergMarquardt(problem, problem.At(start), kOptions).at;
}

/// What makes the noise kLoud of the rms of all positions.
double LoudestOf(const std::vector<Group>& groups) {
  double power = 0.0;
  double noise = 0.0;
  for (const Group& group : groups) {
    for (const GearedLine& line : group) {
      power += std::norm(line.pinion_m) + std::norm(line.gear_m);
      noise += 2.0 * line.sigma_m * line.sigma_m;
    }
  }
  return kLoud * std::sqrt(power / noise);
}

std::vector<Group> Louder(std::vector<Group> groups, double factor) {
  for (Group& group : groups) {
    for (GearedLine& line : group) {
      line.sigma_m *= factor;
      line.sigma_a *= factor;
    }
  }
  return groups;
}

}  // namespace

void FitJointly(const std::vector<GearedLine>& lines, const GearedKnown& known,
                GearedParameters& p) {
  const std::vector<Group> groups = GroupsOf(lines, known.torsion.has_value());
  const JointUnknowns unknowns(known, p);
  const Index count = unknowns.starts().front().size();
  const auto rows = kEquations * static_cast<Index>(lines.size()) + unknowns.HeldBy().rows();
  const double freedom = std::max<double>(1.0, static_cast<double>(rows - count));
  JointProblem::Iterate best{unknowns.starts().front(), std::numeric_limits<double>::infinity()};
  for (const Eigen::VectorXd& start : unknowns.starts()) {
    Eigen::VectorXd x = start;
    // Continuation: with low noise the basin is narrow: start with inflated noise and reduce it.
    for (double factor = LoudestOf(groups); factor > 1.0; factor *= 0.1) {
      x = Fit(Louder(groups, factor), unknowns, x).point;
    }
    JointProblem::Iterate found = Fit(groups, unknowns, x);
    if (found.cost < best.cost) best = std::move(found);
    if (best.cost < kExplained * freedom) break;
  }
  const double scale = std::sqrt(std::max(1.0, best.cost / freedom));
  const Eigen::MatrixXd covariance = JointProblem(groups, unknowns)
                                         .EquationsAt(best.point)
                                         .matrix.ldlt()
                                         .solve(Eigen::MatrixXd::Identity(count, count));
  unknowns.Take(best.point, scale * covariance.diagonal().cwiseMax(0.0).cwiseSqrt(), p);
}

}  // namespace levitas::identification
