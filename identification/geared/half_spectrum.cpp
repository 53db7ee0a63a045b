#include "identification/geared/half_spectrum.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "common/problem.hpp"
#include "common/two_pi.hpp"
#include "identification/geared/elastic_shaft.hpp"
#include "identification/geared/geared_forces.hpp"
#include "identification/geared/imaginary_unit.hpp"
#include "identification/geared/probe_planes.hpp"
#include "identification/geared/steady_stretches.hpp"
#include "numerics/dense/factorisations.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "plant_sim/rotor/torsion_springs.hpp"

namespace levitas::identification {
namespace {

using Complex = std::complex<double>;

/// A line counts where it is so many standard deviations above its noise.
constexpr double kStandsOut = 5.0;

struct HalfOrder {
  std::string name;
  double order{};  ///< multiples of the pinion's rotation
};

std::vector<HalfOrder> HalfOrders(const gear::GearPair& pair, int harmonics) {
  const double ratio = static_cast<double>(pair.driving.teeth) / pair.driven.teeth;
  std::vector<HalfOrder> orders{{"pinion_1x", 1.0}};
  if (ratio != 1.0) orders.push_back({"gear_1x", ratio});
  for (int i = 1; i <= harmonics; ++i) {
    orders.push_back({fmt::format("mesh_{}", i), static_cast<double>(i * pair.driving.teeth)});
  }
  return orders;
}

/// What the torsional modes make of a coupling: s_c and k_c.
struct Coupling {
  Eigen::VectorXd twist;
  double stiffness_n_m_per_rad{};
};

/// Of the couplings that the record names, in its order; the rig may have its gauges elsewhere.
std::vector<Coupling> CouplingsOf(const plant::PlantModel& model,
                                  const std::vector<std::string>& names,
                                  const std::string& record) {
  std::vector<Coupling> couplings;
  const auto& inertias = model.train().inertias;
  const std::vector<rotor::TorsionSpring> springs = rotor::TorsionSprings(model.config().shafts);
  for (const std::string& name : names) {
    const auto spring = std::ranges::find(springs, name, &rotor::TorsionSpring::name);
    if (spring == springs.end()) {
      std::string all;
      for (const auto& one : springs) all += (all.empty() ? "" : ", ") + one.name;
      throw BadInput(fmt::format(
          "{}: its gauges are on the coupling {}, the rig has {}; take the rig that was "
          "recorded (without --rig: that of the session)",
          record, name, all));
    }
    const std::vector<double>& from = inertias[spring->inertia].twist;
    const std::vector<double>& to = inertias[spring->inertia + 1].twist;
    const auto modes = static_cast<Eigen::Index>(from.size());
    const Eigen::Map<const Eigen::VectorXd> near(from.data(), modes);
    const Eigen::Map<const Eigen::VectorXd> far(to.data(), modes);
    couplings.push_back({far - near, spring->stiffness_n_m_per_rad});
  }
  return couplings;
}

/// Columns: torque and twist of each coupling in turn.
struct Amplitudes {
  Eigen::MatrixXcd value;  ///< orders x columns
  Eigen::VectorXd sigma;   ///< of each column's amplitudes
};

void FillBasis(const std::vector<HalfOrder>& orders, double angle_rad, Eigen::VectorXd& basis) {
  basis[0] = 1.0;
  for (std::size_t k = 0; k < orders.size(); ++k) {
    const double phase = orders[k].order * angle_rad;
    basis[static_cast<Eigen::Index>(2 * k + 1)] = std::cos(phase);
    basis[static_cast<Eigen::Index>(2 * k + 2)] = -std::sin(phase);
  }
}

/// `rows`: instants of the stretch with a torsion.
void RefuseSparseTorsion(const session::Recording& record, const SteadyStretch& stretch,
                         double rows) {
  if (rows < 0.5 * static_cast<double>(stretch.end - stretch.begin)) {
    throw BadInput(fmt::format(
        "{}: of the stretch at {:.2f} Hz the record holds the torsion of {:.0f} of {} instants; at "
        "least half are needed",
        record.name, stretch.speed_rad_per_s / kTwoPi, rows, stretch.end - stretch.begin));
  }
}

Amplitudes Fit(const session::Recording& record, const std::vector<double>& angle,
               const SteadyStretch& stretch, const std::vector<HalfOrder>& orders,
               const session::TorsionRecording& torsion) {
  const auto size = static_cast<Eigen::Index>(2 * orders.size() + 1);
  const auto columns = static_cast<Eigen::Index>(2 * torsion.couplings.size());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(size, size);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(size, columns);
  Eigen::VectorXd power = Eigen::VectorXd::Zero(columns);
  Eigen::VectorXd basis(size);
  Eigen::RowVectorXd values(columns);
  double rows = 0.0;
  for (std::size_t n = stretch.begin; n < stretch.end; ++n) {
    const auto row = torsion.RowOf(torsion.rig_session.front(), record.cycle[n]);
    if (!row) continue;
    rows += 1.0;
    FillBasis(orders, angle[n], basis);
    for (std::size_t c = 0; c < torsion.couplings.size(); ++c) {
      values[static_cast<Eigen::Index>(2 * c)] = torsion.torque_n_m[c][*row];
      values[static_cast<Eigen::Index>(2 * c + 1)] = torsion.twist_rad[c][*row];
    }
    normal.noalias() += basis * basis.transpose();
    right.noalias() += basis * values;
    power += values.cwiseAbs2().transpose();
  }
  RefuseSparseTorsion(record, stretch, rows);
  const Eigen::MatrixXd solved = normal.ldlt().solve(right);
  Amplitudes found{Eigen::MatrixXcd(orders.size(), columns), Eigen::VectorXd(columns)};
  for (std::size_t k = 0; k < orders.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    found.value.row(at) = solved.row(2 * at + 1) + kJ * solved.row(2 * at + 2);
  }
  for (Eigen::Index c = 0; c < columns; ++c) {
    // A difference of sums is not known better than to their rounding.
    const double rounding = 1e-15 * power[c];
    const double left = std::max(power[c] - right.col(c).dot(solved.col(c)), rounding) / rows;
    found.sigma[c] = std::sqrt(2.0 * left / rows);
  }
  return found;
}

/// (n* f(W) + n f(-W)*)/2 of a line of this speed and frequency; none where either is left out.
std::optional<Complex> AlongOf(const std::vector<GearedLine>& lines,
                               const std::vector<Complex>& force, Complex normal, double speed,
                               double w) {
  const auto forward = ForceAt(lines, force, speed, w);
  const auto backward = ForceAt(lines, force, speed, -w);
  if (!forward || !backward) return std::nullopt;
  return 0.5 * (std::conj(normal) * *forward + normal * std::conj(*backward));
}

Complex ModelTorque(const TorsionKnown& torsion, const Coupling& coupling, double w,
                    Complex along) {
  return -2.0 * coupling.stiffness_n_m_per_rad * TwistBetween(torsion, coupling.twist, w) * along;
}

/// M = k theta with noise on both: the least of sum |M - k theta|^2 / (s_M^2 + k^2 s_theta^2).
void FindStiffness(const std::vector<TorsionLine>& lines, std::size_t index,
                   CouplingFound& coupling) {
  double k = coupling.known_n_m_per_rad;
  for (int round = 0; round < 5; ++round) {
    double cross = 0.0;
    double square = 0.0;
    coupling.lines_used = 0;
    for (const TorsionLine& line : lines) {
      if (line.coupling != index || std::abs(line.twist_rad) <= kStandsOut * line.twist_sigma_rad) {
        continue;
      }
      const double noise = line.torque_sigma_n_m * line.torque_sigma_n_m +
                           k * k * line.twist_sigma_rad * line.twist_sigma_rad;
      // The twist as both readings explain it, so that its noise does not draw k towards 0.
      const Complex rest = line.torque_n_m - k * line.twist_rad;
      const Complex twist =
          line.twist_rad + k * line.twist_sigma_rad * line.twist_sigma_rad / noise * rest;
      cross += (std::conj(twist) * (line.torque_n_m + k * (twist - line.twist_rad))).real() / noise;
      square += std::norm(twist) / noise;
      ++coupling.lines_used;
    }
    if (coupling.lines_used == 0 || !(square > 0.0)) return;
    k = cross / square;
    coupling.stiffness_sigma = std::sqrt(1.0 / square);
  }
  coupling.stiffness_n_m_per_rad = k;
}

void FindUnexplained(const std::vector<TorsionLine>& lines, std::size_t index,
                     CouplingFound& coupling) {
  double power = 0.0;
  double left = 0.0;
  for (const TorsionLine& line : lines) {
    if (line.coupling != index || !line.model_n_m) continue;
    const double noise = 2.0 * line.torque_sigma_n_m * line.torque_sigma_n_m;
    power += std::norm(line.torque_n_m) - noise;
    left += std::norm(line.torque_n_m - *line.model_n_m) - noise;
  }
  if (power > 0.0) coupling.unexplained_share = std::max(left, 0.0) / power;
}

void RefuseRestart(const session::Recording& record, const session::TorsionRecording& torsion) {
  if (torsion.rig_session.front() != torsion.rig_session.back()) {
    throw BadInput(record.name +
                   ": the rig began anew within the record and counted its cycles from 0 again, so "
                   "that torsion cannot be told of which stretch it is; record without a restart");
  }
}

/// The mesh force of each line.
std::vector<Complex> ForcesOn(const std::vector<GearedLine>& lines, const GearedParameters& found) {
  std::vector<Complex> force;
  const std::vector<LineGains> gains = GainsOn(lines, found.corrected, found);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    force.push_back(MeshForce(lines[k], found.corrected, found, gains[k]));
  }
  return force;
}

}  // namespace

HalfSpectrum HalfSpectrumOf(const session::Recording& record,
                            const session::TorsionRecording& torsion,
                            const configuration::RigFile& rig, const std::vector<GearedLine>& lines,
                            const GearedParameters& found, int harmonics) {
  HalfSpectrum half;
  if (torsion.rows() == 0 || !found.corrected.torsion) return half;
  const gear::GearPair& pair = rig.plant.gears.front();
  RefuseRestart(record, torsion);
  const std::vector<Coupling> couplings =
      CouplingsOf(plant::PlantModel(rig.plant), torsion.couplings, record.name);
  for (std::size_t c = 0; c < couplings.size(); ++c) {
    half.couplings.push_back({.name = torsion.couplings[c],
                              .known_n_m_per_rad = couplings[c].stiffness_n_m_per_rad,
                              .unexplained_share = {}});
  }
  const std::vector<GearedLine> seen = LinesOffNodes(lines, found.corrected);
  const std::vector<Complex> force = ForcesOn(seen, found);
  const auto orders = HalfOrders(pair, harmonics);
  const std::vector<double> angle = UnwrappedAngle(record);
  for (const SteadyStretch& stretch : SteadyStretches(record, angle, pair)) {
    const Amplitudes amplitudes = Fit(record, angle, stretch, orders, torsion);
    for (std::size_t c = 0; c < couplings.size(); ++c) {
      for (std::size_t k = 0; k < orders.size(); ++k) {
        const auto row = static_cast<Eigen::Index>(k);
        const auto column = static_cast<Eigen::Index>(2 * c);
        const double w = orders[k].order * stretch.speed_rad_per_s;
        const std::optional<Complex> along =
            AlongOf(seen, force, found.corrected.torsion->normal, stretch.speed_rad_per_s, w);
        half.lines.push_back(
            {c, orders[k].name, stretch.speed_rad_per_s, w, amplitudes.value(row, column),
             amplitudes.value(row, column + 1), amplitudes.sigma[column],
             amplitudes.sigma[column + 1],
             along ? std::optional(ModelTorque(*found.corrected.torsion, couplings[c], w, *along))
                   : std::nullopt});
      }
    }
  }
  for (std::size_t c = 0; c < couplings.size(); ++c) {
    FindStiffness(half.lines, c, half.couplings[c]);
    FindUnexplained(half.lines, c, half.couplings[c]);
  }
  return half;
}

}  // namespace levitas::identification
