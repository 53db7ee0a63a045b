#include "benchmark/accuracy/identification/geared_bound.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <type_traits>

#include "common/random.hpp"
#include "numerics/factors/factors.hpp"

namespace levitas::accuracy {
namespace {

using Complex = std::complex<double>;
using identification::GearedLine;
using Index = Eigen::Index;

constexpr double kStep = 1e-5;
constexpr int kDraws = 4001;
/// What no line tells and nothing holds does not matter to the figures, but must not be infinite.
constexpr double kWidest = 10.0;

struct Unknown {
  std::function<void(configuration::RigFile&, double)> move;  ///< by a share of its value
  double prior{kWidest};
};

/// Where the unknowns stand; complex ones take two places.
struct Unknowns {
  std::vector<Unknown> all;
  std::array<Index, 2> ks{}, ki{}, run_out{};
  std::array<Index, 2> stiffness{-1, -1};
  Index mean{}, mean_parts{2};
  std::vector<Index> varying{};
  Index mesh_stiffness{}, mesh_damping{};

  Index Add(std::function<void(configuration::RigFile&, double)> move, double prior = kWidest) {
    all.push_back({std::move(move), prior});
    return static_cast<Index>(all.size()) - 1;
  }
};

gear::GearPair& Pair(configuration::RigFile& rig) { return rig.plant.gears.front(); }

void AddMagnet(std::size_t s, Unknowns& to) {
  // ki = 4 k i0/s0^2, ks = 4 k i0^2/s0^3: gap ~ ki/ks, k ~ ki^3/ks^2.
  to.ki[s] = to.Add([s](configuration::RigFile& rig, double share) {
    auto& magnet = rig.plant.bearings[s].magnet;
    magnet.gap_m *= 1.0 + share;
    magnet.force_constant_n_m2_per_a2 *= std::pow(1.0 + share, 3);
  });
  to.ks[s] = to.Add([s](configuration::RigFile& rig, double share) {
    auto& magnet = rig.plant.bearings[s].magnet;
    magnet.gap_m /= 1.0 + share;
    magnet.force_constant_n_m2_per_a2 /= std::pow(1.0 + share, 2);
  });
  to.run_out[s] = to.Add([s](configuration::RigFile& rig, double share) {
    (s == 0 ? Pair(rig).driving : Pair(rig).driven).runout_m *= 1.0 + share;
  });
  to.Add([s](configuration::RigFile& rig, double share) {
    (s == 0 ? Pair(rig).driving : Pair(rig).driven).runout_phase_rad += share;
  });
}

void AddTorsion(const configuration::RigFile& rig, std::size_t s, double uncertainty,
                Unknowns& to) {
  for (std::size_t i = 0; i < rig.plant.shafts[s].torsion.inertias.size(); ++i) {
    const auto add = [&](auto member) {
      to.Add(
          [s, i, member](configuration::RigFile& moved, double share) {
            moved.plant.shafts[s].torsion.inertias[i].*member *= 1.0 + share;
          },
          uncertainty);
    };
    using Inertia = std::decay_t<decltype(rig.plant.shafts[s].torsion.inertias[i])>;
    add(&Inertia::inertia_kg_m2);
    add(&Inertia::stiffness_n_m_per_rad);
  }
}

void AddKnown(std::size_t s, double uncertainty, Unknowns& to) {
  to.Add(
      [s](configuration::RigFile& rig, double share) {
        rig.plant.shafts[s].lumped.mass_kg *= 1.0 + share;
        (s == 0 ? Pair(rig).driving : Pair(rig).driven).eccentric_mass_kg *= 1.0 + share;
      },
      uncertainty);
  to.Add([s](configuration::RigFile& rig,
             double share) { rig.plant.shafts[s].lumped.damping_n_s_per_m *= 1.0 + share; },
         uncertainty);
  to.stiffness[s] = to.Add(
      [s](configuration::RigFile& rig, double share) {
        auto& lumped = rig.plant.shafts[s].lumped;
        lumped.kll_n_per_m *= 1.0 + share;
        lumped.kla_n *= 1.0 + share;
        lumped.kaa_n_m *= 1.0 + share;
      },
      uncertainty);
  to.Add([s](configuration::RigFile& rig,
             double share) { rig.plant.shafts[s].lumped.diametral_inertia_kg_m2 *= 1.0 + share; },
         uncertainty);
  to.Add([s](configuration::RigFile& rig,
             double share) { rig.plant.shafts[s].lumped.polar_inertia_kg_m2 *= 1.0 + share; },
         uncertainty);
}

Index AddError(std::size_t harmonic, Unknowns& to) {
  const Index first = to.Add([harmonic](configuration::RigFile& rig, double share) {
    Pair(rig).transmission_error[harmonic].amplitude_m *= 1.0 + share;
  });
  to.Add([harmonic](configuration::RigFile& rig, double share) {
    Pair(rig).transmission_error[harmonic].phase_rad += share;
  });
  return first;
}

/// A free train absorbs the mean error along the line of action: only what is across it is
/// identifiable.
Index AddMeanAcross(std::size_t harmonic, Unknowns& to) {
  return to.Add([harmonic](configuration::RigFile& rig, double share) {
    const gear::Vector n = gear::LineOfAction(Pair(rig).pressure_angle_rad);
    const Complex along(n.x, n.y);
    gear::Harmonic& h = Pair(rig).transmission_error[harmonic];
    const Complex mean = std::polar(h.amplitude_m, h.phase_rad);
    const Complex moved = mean + share * (mean - along * (mean * std::conj(along)).real());
    h.amplitude_m = std::abs(moved);
    h.phase_rad = std::arg(moved);
  });
}

Unknowns UnknownsOf(const configuration::RigFile& rig, const GearedPlan& plan) {
  Unknowns to;
  to.mesh_stiffness = to.Add(
      [](configuration::RigFile& r, double share) { Pair(r).stiffness_n_per_m *= 1.0 + share; });
  to.mesh_damping = to.Add(
      [](configuration::RigFile& r, double share) { Pair(r).damping_n_s_per_m *= 1.0 + share; });
  for (std::size_t s = 0; s < 2; ++s) {
    AddMagnet(s, to);
    if (plan.model_error <= 0.0) continue;
    AddKnown(s, plan.model_error, to);
    AddTorsion(rig, s, plan.model_error, to);
  }
  const bool torsion = !rig.plant.shafts[0].torsion.inertias.empty();
  to.mean_parts = torsion ? 1 : 2;
  const auto& errors = rig.plant.gears.front().transmission_error;
  for (std::size_t h = 0; h < errors.size(); ++h) {
    if (errors[h].order == 0) {
      to.mean = torsion ? AddMeanAcross(h, to) : AddError(h, to);
    } else {
      to.varying.push_back(AddError(h, to));
    }
  }
  return to;
}

/// Real and imaginary parts of all readings, in units of their noise.
Eigen::VectorXd Stacked(const std::vector<GearedLine>& lines, double sigma_m, double sigma_a) {
  Eigen::VectorXd rows(8 * static_cast<Index>(lines.size()));
  Index at = 0;
  for (const GearedLine& l : lines) {
    for (const auto& [value, sigma] :
         {std::pair{l.pinion_m, sigma_m}, std::pair{l.gear_m, sigma_m},
          std::pair{l.pinion_a, sigma_a}, std::pair{l.gear_a, sigma_a}}) {
      rows[at++] = value.real() * std::numbers::sqrt2 / sigma;
      rows[at++] = value.imag() * std::numbers::sqrt2 / sigma;
    }
  }
  return rows;
}

/// Orthonormal directions in which unknown currents move the readings of one speed.
Eigen::MatrixXd ByCurrents(const configuration::RigFile& rig, const GearedPlan& plan, double speed,
                           const std::vector<GearedLine>& lines, double sigma_m, double sigma_a) {
  const Eigen::VectorXd still = Stacked(lines, sigma_m, sigma_a);
  Eigen::MatrixXd moved(still.size(), 4 * static_cast<Index>(lines.size()));
  Index column = 0;
  for (const GearedLine& line : lines) {
    for (std::size_t shaft = 0; shaft < 2; ++shaft) {
      for (const Complex unit : {Complex(1.0, 0.0), Complex(0.0, 1.0)}) {
        // Linear in the current: of the size of the noise it is as good as infinitesimal.
        const AddedCurrent added{line.frequency_rad_per_s, shaft, sigma_a * unit};
        moved.col(column++) = Stacked(LinesAt(rig, plan, speed, {added}), sigma_m, sigma_a) - still;
      }
    }
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(moved);
  return Eigen::MatrixXd(qr.householderQ()).leftCols(qr.rank());
}

Eigen::MatrixXd Information(const configuration::RigFile& rig, const GearedPlan& plan,
                            const Unknowns& unknowns) {
  const auto count = static_cast<Index>(unknowns.all.size());
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(count, count);
  GearedPlan noisy = plan;
  noisy.model_error = 0.0;
  const auto measured = MakeGearedTrial(rig, noisy).lines;
  std::size_t first = 0;
  for (const double hz : plan.speeds_hz) {
    const double speed = 2.0 * std::numbers::pi * hz;
    const auto lines = LinesAt(rig, plan, speed);
    const double sigma_m = measured[first].sigma_m;
    const double sigma_a = measured[first].sigma_a;
    first += lines.size();
    Eigen::MatrixXd jacobian(8 * static_cast<Index>(lines.size()), count);
    for (Index k = 0; k < count; ++k) {
      std::array<Eigen::VectorXd, 2> sides;
      for (std::size_t side = 0; side < 2; ++side) {
        configuration::RigFile moved = rig;
        unknowns.all[static_cast<std::size_t>(k)].move(moved, side == 0 ? kStep : -kStep);
        sides[side] = Stacked(LinesAt(moved, plan, speed), sigma_m, sigma_a);
      }
      jacobian.col(k) = (sides[0] - sides[1]) / (2.0 * kStep);
    }
    const Eigen::MatrixXd currents = ByCurrents(rig, plan, speed, lines, sigma_m, sigma_a);
    jacobian -= currents * (currents.transpose() * jacobian);
    information += jacobian.transpose() * jacobian;
  }
  for (Index k = 0; k < count; ++k) {
    information(k, k) += std::pow(unknowns.all[static_cast<std::size_t>(k)].prior, -2);
  }
  if (plan.model_error > 0.0) {
    for (std::size_t s = 0; s < 2; ++s) {
      Eigen::VectorXd ratio = Eigen::VectorXd::Zero(count);
      ratio[unknowns.ks[s]] = 1.0 / plan.model_error;
      ratio[unknowns.ki[s]] = -1.0 / plan.model_error;
      information += ratio * ratio.transpose();
    }
  }
  return information;
}

/// One draw's errors as Compare counts them.
GearedErrors ErrorsOf(const configuration::RigFile& rig, const Unknowns& at,
                      const Eigen::VectorXd& off) {
  GearedErrors e;
  e.mesh_stiffness = std::abs(off[at.mesh_stiffness]);
  e.mesh_damping = std::abs(off[at.mesh_damping]);
  for (std::size_t s = 0; s < 2; ++s) {
    e.ks = std::max(e.ks, std::abs(off[at.ks[s]]));
    e.ki = std::max(e.ki, std::abs(off[at.ki[s]]));
    e.run_out = std::max(e.run_out, off.segment(at.run_out[s], 2).norm());
    const double k = rig.plant.shafts[s].lumped.kll_n_per_m;
    const double ks = KsOf(rig.plant.bearings[s]);
    const double stiff = at.stiffness[s] < 0 ? 0.0 : off[at.stiffness[s]];
    e.net_stiffness =
        std::max(e.net_stiffness, std::abs((k * stiff - ks * off[at.ks[s]]) / (k - ks)));
  }
  e.mean_error = off.segment(at.mean, at.mean_parts).norm();
  std::vector<double> varying;
  for (const Index first : at.varying) varying.push_back(off.segment(first, 2).norm());
  std::ranges::sort(varying);
  if (!varying.empty()) e.varying_error = varying[varying.size() / 2];
  return e;
}

}  // namespace

GearedErrors BoundOf(const configuration::RigFile& rig, const GearedPlan& plan) {
  const Unknowns unknowns = UnknownsOf(rig, plan);
  const Eigen::LLT<Eigen::MatrixXd> root(Information(rig, plan, unknowns));
  Random random(plan.seed);
  std::vector<GearedErrors> draws;
  for (int n = 0; n < kDraws; ++n) {
    Eigen::VectorXd unit(static_cast<Index>(unknowns.all.size()));
    for (double& value : unit) value = random.Normal();
    draws.push_back(ErrorsOf(rig, unknowns, root.matrixU().solve(unit)));
  }
  GearedErrors median;
  for (const auto member :
       {&GearedErrors::mesh_stiffness, &GearedErrors::mesh_damping, &GearedErrors::ks,
        &GearedErrors::ki, &GearedErrors::run_out, &GearedErrors::net_stiffness,
        &GearedErrors::mean_error, &GearedErrors::varying_error}) {
    std::ranges::nth_element(draws, draws.begin() + kDraws / 2, {}, member);
    median.*member = draws[kDraws / 2].*member;
  }
  return median;
}

}  // namespace levitas::accuracy
