#include "design/pid/coordinates.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <string>

#include "common/problem.hpp"
#include "controller/law/discrete_law.hpp"
#include "plant_sim/plant/linear_parts.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::design {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;

/// Distances of the two planes from the centre of mass, both positive.
struct Levers {
  double drive_end_m{}, other_m{};
};

Levers LeversOf(double centre_m, double drive_end_m, double other_m) {
  const Levers out{centre_m - drive_end_m, other_m - centre_m};
  if (!(out.drive_end_m > 0.0) || !(out.other_m > 0.0))
    throw Problem(ExitStatus::kOther,
                  "the centre of mass lies at z = " + std::to_string(1e3 * centre_m) +
                      " mm, not between the two bearings: translation and tilt are no coordinates "
                      "for this rotor; leave out --tilt");
  return out;
}

/// Roots of z^2 + a1 z + a2, or of z + a1 alone.
void AddPoles(const law::Section& section, std::vector<Complex>& poles) {
  if (section.a2 == 0.0) {
    if (section.b1 != 0.0 || section.a1 != 0.0) poles.emplace_back(-section.a1);
    return;
  }
  const Complex root = std::sqrt(Complex(0.25 * section.a1 * section.a1 - section.a2));
  for (const double side : {1.0, -1.0}) {
    const Complex pole = -0.5 * section.a1 + side * root;
    constexpr double kRounding = 1e-12;
    // An integrator's pole is 1, not a digit less: it would leak.
    poles.push_back(std::abs(pole - 1.0) < kRounding ? Complex(1.0) : pole);
  }
}

Complex ValueOf(const std::vector<law::Section>& sections, Complex q) {
  Complex out = 1.0;
  for (const auto& s : sections)
    out *= (s.b0 + q * (s.b1 + q * s.b2)) / (1.0 + q * (s.a1 + q * s.a2));
  return out;
}

/// Of a cascade: value at z -> infinity, and the residue in z at one of its single poles.
double DirectOf(const std::vector<law::Section>& sections) {
  double out = 1.0;
  for (const auto& s : sections) out *= s.b0;
  return out;
}

/// From a circle around the pole that holds no other: the trapezoid rule is exact to rounding.
Complex ResidueAt(const std::vector<law::Section>& sections, Complex pole, double radius) {
  constexpr int kPoints = 32;
  Complex sum = 0.0;
  for (int k = 0; k < kPoints; ++k) {
    const Complex away = std::polar(radius, 2.0 * std::numbers::pi * (k + 0.5) / kPoints);
    sum += away * ValueOf(sections, 1.0 / (pole + away));
  }
  return sum / static_cast<double>(kPoints);
}

/// A pole of one channel as a block between all axes.
law::ModalBlock BlockOf(Complex pole, Complex residue, const Eigen::RowVectorXd& measure,
                        const Eigen::VectorXd& drive) {
  law::ModalBlock out;
  const bool pair = pole.imag() != 0.0;
  out.pole_real = pole.real();
  out.pole_imaginary = pole.imag();
  // r/(z - p) and its conjugate: 2 Re r and 2 Im r of the two states that [1; 0] drives.
  const double first = pair ? 2.0 * residue.real() : residue.real();
  const double second = pair ? 2.0 * residue.imag() : 0.0;
  for (Index axis = 0; axis < measure.size(); ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    out.first_input[i] = measure(axis);
    out.first_output[i] = -first * drive(axis);
    out.second_output[i] = -second * drive(axis);
  }
  return out;
}

void AddChannel(const law::AxisLawConfig& config, double period_s,
                const Eigen::RowVectorXd& measure, const Eigen::VectorXd& drive,
                law::StateSpaceConfig& out) {
  const auto sections = law::DiscreteSections(config, period_s);
  std::vector<Complex> poles;
  for (const auto& section : sections) AddPoles(section, poles);
  const double direct = DirectOf(sections);
  for (Index to = 0; to < drive.size(); ++to)
    for (Index from = 0; from < measure.size(); ++from)
      out.direct[static_cast<std::size_t>(to)][static_cast<std::size_t>(from)] -=
          direct * drive(to) * measure(from);
  for (std::size_t i = 0; i < poles.size(); ++i) {
    double nearest = 1.0;
    for (std::size_t k = 0; k < poles.size(); ++k)
      if (k != i) nearest = std::min(nearest, std::abs(poles[i] - poles[k]));
    constexpr double kApart = 1e-6;  // nearer: residues of opposite sign cancel all digits
    if (nearest < kApart)
      throw std::invalid_argument("two filters of a channel have the same pole, z = " +
                                  std::to_string(poles[i].real()));
    if (poles[i].imag() < 0.0) continue;
    out.blocks.push_back(
        BlockOf(poles[i], ResidueAt(sections, poles[i], 0.4 * nearest), measure, drive));
  }
}

}  // namespace

Coordinates TranslationAndTilt(const configuration::RigFile& rig) {
  const auto& bearings = rig.plant.bearings;
  if (!rig.plant.shafts.empty() || bearings.size() != 2 || rig.numbers.axes() != 4)
    throw Problem(ExitStatus::kOther,
                  "translation and tilt are coordinates of one rotor in two bearings of two axes "
                  "each: this rig is another; leave out --tilt");
  const plant::PlantModel model(rig.plant);
  const auto& rigid = model.parameters().modes.rigid;
  const double centre_m = rigid.col(0).dot(rigid.col(1)) / rigid.col(0).squaredNorm();
  const Levers sensors = LeversOf(centre_m, bearings[0].sensor_z_m, bearings[1].sensor_z_m);
  const Levers coils = LeversOf(centre_m, bearings[0].actuator_z_m, bearings[1].actuator_z_m);
  const double at_sensors = sensors.drive_end_m + sensors.other_m;
  const double at_coils = coils.drive_end_m + coils.other_m;
  Coordinates out{Eigen::MatrixXd::Zero(4, 4), Eigen::MatrixXd::Zero(4, 4)};
  for (Index plane = 0; plane < 2; ++plane) {
    const Index de = plane;
    const Index nde = 2 + plane;
    const double ki_de = plant::SlopesAtCentre(model, 0).current(plane, plane);
    const double ki_nde = plant::SlopesAtCentre(model, 1).current(plane, plane);
    const double mean = 0.5 * (ki_de + ki_nde);
    out.measure(plane, de) = sensors.other_m / at_sensors;
    out.measure(plane, nde) = sensors.drive_end_m / at_sensors;
    out.measure(2 + plane, de) = -0.5;
    out.measure(2 + plane, nde) = 0.5;
    out.drive(de, plane) = 2.0 * coils.other_m / at_coils * mean / ki_de;
    out.drive(nde, plane) = 2.0 * coils.drive_end_m / at_coils * mean / ki_nde;
    out.drive(de, 2 + plane) = -mean / ki_de;
    out.drive(nde, 2 + plane) = mean / ki_nde;
  }
  return out;
}

law::LawConfig BetweenAxes(const law::LawConfig& channels, const Coordinates& coordinates) {
  law::StateSpaceConfig blocks;
  blocks.axes = static_cast<std::size_t>(coordinates.measure.cols());
  blocks.discrete = true;
  for (std::size_t i = 0; i < blocks.axes; ++i)
    blocks.input_v_per_m[i] = blocks.output_a_per_v[i] = 1.0;
  for (std::size_t i = 0; i < channels.axes.size(); ++i)
    AddChannel(channels.axes[i], channels.period_s, coordinates.measure.row(static_cast<Index>(i)),
               coordinates.drive.col(static_cast<Index>(i)), blocks);
  law::LawConfig out;
  out.period_s = channels.period_s;
  out.current_limit_a = channels.current_limit_a;
  out.state_space = std::move(blocks);
  return out;
}

}  // namespace levitas::design
