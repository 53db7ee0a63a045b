#include "identification/geared/record_lines.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include "common/problem.hpp"
#include "common/two_pi.hpp"
#include "identification/frf/flat_top.hpp"
#include "identification/geared/imaginary_unit.hpp"
#include "identification/geared/steady_stretches.hpp"
#include "numerics/dense/factorisations.hpp"

namespace levitas::identification {
namespace {

using Complex = std::complex<double>;
using Kind = GearedLine::Kind;

constexpr double kBadShare = 0.001;

/// One line by kind and order of the pinion's angle.
struct Order {
  Kind kind{};
  int harmonic{};
  double order{};
};

/// A shaft's axes and what its readings and commands pass.
struct Chain {
  std::size_t x{};
  double sensor_gain{}, sensor_hz{}, amplifier_hz{};
};

Chain ChainOf(const plant::PlantConfig& rig, std::size_t shaft) {
  const std::size_t b = rig.bearings[0].shaft == shaft ? 0 : 1;
  const plant::BearingConfig& bearing = rig.bearings[b];
  return {2 * b, bearing.sensor.gain, bearing.sensor.bandwidth_hz, bearing.amplifier.bandwidth_hz};
}

std::vector<Order> Orders(const gear::GearPair& pair, int harmonics) {
  const double ratio = static_cast<double>(pair.driving.teeth) / pair.driven.teeth;
  std::vector<Order> orders{{Kind::kTransmissionError, 0, 0.0},
                            {Kind::kPinion, 0, 1.0},
                            {Kind::kMirror, 0, -1.0},
                            {Kind::kGear, 0, -ratio},
                            {Kind::kMirror, 0, ratio}};
  for (int i = 1; i <= harmonics; ++i) {
    orders.push_back({Kind::kTransmissionError, i, static_cast<double>(i * pair.driving.teeth)});
    orders.push_back({Kind::kTransmissionError, -i, static_cast<double>(-i * pair.driving.teeth)});
  }
  return orders;
}

void RefuseBadRows(const session::Recording& record, const SteadyStretch& stretch) {
  const auto rows = static_cast<double>(stretch.end - stretch.begin);
  const double at_s = static_cast<double>(stretch.begin) * record.period_s();
  std::string problems;
  if (record.cycle[stretch.end - 1] - record.cycle[stretch.begin] !=
      stretch.end - 1 - stretch.begin) {
    problems += "\n  samples are missing";
  }
  for (std::size_t axis = 0; axis < record.axes(); ++axis) {
    std::set<double> values;
    double clipped = 0.0;
    double limited = 0.0;
    for (std::size_t n = stretch.begin; n < stretch.end; ++n) {
      if (values.size() < 4) values.insert(record.position_m[axis][n]);
      if (std::abs(record.position_m[axis][n]) >= 0.999 * record.sensor_range_m[axis])
        clipped += 1.0;
      if (std::abs(record.current_a[axis][n]) >= 0.9999 * record.current_limit_a) limited += 1.0;
    }
    const std::string& name = record.channels[axis];
    if (values.size() < 4) problems += "\n  position " + name + " is dead: check probe and cable";
    const double flat = FlatShare(
        std::span(record.position_m[axis]).subspan(stretch.begin, stretch.end - stretch.begin));
    if (std::max(clipped, flat * rows) > kBadShare * rows) {
      problems += "\n  position " + name + " is clipped";
    }
    if (limited > kBadShare * rows) {
      problems += fmt::format(
          "\n  control current {} is at its limit ({:.4g} A) in {:.1f} % of the samples, allowed "
          "{:g} %: the lines are not the model's",
          name, record.current_limit_a, 100.0 * limited / rows, 100.0 * kBadShare);
    }
  }
  if (!problems.empty()) {
    throw BadInput(
        fmt::format("{}: the stretch from {:.2f} s is not usable{}", record.name, at_s, problems));
  }
}

/// Complex amplitudes of both shafts' positions and currents, and the deviations of each.
struct Amplitudes {
  Eigen::MatrixXcd value;  ///< orders x (pinion_m, gear_m, pinion_a, gear_a)
  Eigen::Vector4d sigma;
};

Amplitudes Fit(const session::Recording& record, const std::vector<double>& angle,
               const SteadyStretch& stretch, const std::vector<Order>& orders, const Chain& pinion,
               const Chain& gear) {
  const auto size = static_cast<Eigen::Index>(orders.size());
  Eigen::MatrixXcd normal = Eigen::MatrixXcd::Zero(size, size);
  Eigen::MatrixXcd right = Eigen::MatrixXcd::Zero(size, 4);
  Eigen::Vector4d power = Eigen::Vector4d::Zero();
  Eigen::VectorXcd basis(size);
  for (std::size_t n = stretch.begin; n < stretch.end; ++n) {
    for (Eigen::Index k = 0; k < size; ++k) {
      basis[k] = std::polar(1.0, orders[static_cast<std::size_t>(k)].order * angle[n]);
    }
    Eigen::RowVector4cd row;
    row << Complex(record.position_m[pinion.x][n], record.position_m[pinion.x + 1][n]),
        Complex(record.position_m[gear.x][n], record.position_m[gear.x + 1][n]),
        Complex(record.current_a[pinion.x][n], record.current_a[pinion.x + 1][n]),
        Complex(record.current_a[gear.x][n], record.current_a[gear.x + 1][n]);
    normal.noalias() += basis.conjugate() * basis.transpose();
    right.noalias() += basis.conjugate() * row;
    power += row.cwiseAbs2().transpose();
  }
  Amplitudes found;
  found.value = normal.ldlt().solve(right);
  const auto rows = static_cast<double>(stretch.end - stretch.begin);
  for (Eigen::Index c = 0; c < 4; ++c) {
    const double explained = right.col(c).dot(found.value.col(c)).real();
    found.sigma[c] = std::sqrt(std::max(power[c] - explained, 0.0) / rows / rows);
  }
  return found;
}

Complex Lag(double f_hz, double corner_hz) { return 1.0 / (1.0 + kJ * f_hz / corner_hz); }

/// From command to coil: delay, hold, amplifier.
Complex Drive(double w, double corner_hz, double delay_s, double period_s) {
  const double half = 0.5 * w * period_s;
  const double hold = std::abs(half) > 1e-12 ? std::sin(half) / half : 1.0;
  return hold * std::polar(1.0, -w * delay_s - half) * Lag(w / kTwoPi, corner_hz);
}

void RefuseTooFewStretches(const session::Recording& record, std::size_t stretches,
                           const std::string& rig) {
  if (stretches < 2) {
    throw BadInput(fmt::format(
        "{}: {} stretch(es) of {:.1f} s at one speed, levitated and turning; at least two of "
        "different speed are needed (amb run --rig {})",
        record.name, stretches, kShortestStretchS, rig));
  }
}

}  // namespace

std::vector<GearedLine> LinesOfRecord(const session::Recording& record,
                                      const configuration::RigFile& rig, int harmonics) {
  const bool torsion = KnownOfRig(rig).torsion.has_value();
  const gear::GearPair& pair = rig.plant.gears.front();
  const Chain pinion = ChainOf(rig.plant, pair.driving.shaft);
  const Chain gear = ChainOf(rig.plant, pair.driven.shaft);
  const std::vector<double> angle = UnwrappedAngle(record);
  const auto stretches = SteadyStretches(record, angle, pair);
  RefuseTooFewStretches(record, stretches.size(), rig.numbers.name);
  const double delay_s = rig.plant.delay_samples * record.period_s();
  std::vector<GearedLine> lines;
  for (const SteadyStretch& stretch : stretches) {
    RefuseBadRows(record, stretch);
    const std::vector<Order> orders = Orders(pair, harmonics);
    const Amplitudes found = Fit(record, angle, stretch, orders, pinion, gear);
    for (std::size_t k = 0; k < orders.size(); ++k) {
      if (orders[k].kind == Kind::kMirror && !torsion) continue;
      GearedLine line;
      line.kind = orders[k].kind;
      line.harmonic = orders[k].harmonic;
      line.speed_rad_per_s = stretch.speed_rad_per_s;
      line.frequency_rad_per_s = orders[k].order * stretch.speed_rad_per_s;
      const auto row = found.value.row(static_cast<Eigen::Index>(k));
      const double w = line.frequency_rad_per_s;
      const auto read = [w](const Chain& c) {
        return c.sensor_gain * Lag(w / kTwoPi, c.sensor_hz);
      };
      const auto drive = [&](const Chain& c) {
        return Drive(w, c.amplifier_hz, delay_s, record.period_s());
      };
      line.pinion_m = row[0] / read(pinion);
      line.gear_m = row[1] / read(gear);
      // The only place where the record's sign of a current (+ki ic) meets the equations' (-ki I).
      line.pinion_a = -row[2] * drive(pinion);
      line.gear_a = -row[3] * drive(gear);
      line.sigma_m = std::max(found.sigma[0], found.sigma[1]) / std::abs(read(pinion));
      line.sigma_a = std::max(found.sigma[2], found.sigma[3]);
      lines.push_back(line);
    }
  }
  return lines;
}

}  // namespace levitas::identification
