#include "design/pid/sampled_plant.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "common/problem.hpp"
#include "common/two_pi.hpp"
#include "numerics/dense/eigenvalues.hpp"
#include "numerics/dense/factorisations.hpp"
#include "numerics/dense/spectrum.hpp"
#include "plant_sim/plant/find_operating_point.hpp"
#include "plant_sim/plant/linear_model.hpp"
#include "plant_sim/plant/linear_parts.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::design {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;

constexpr double kLightlyDamped = 0.1;

/// (e^{l h} - 1)/l, also where l h is small.
Complex Held(Complex l, double h) {
  const Complex x = l * h;
  if (std::abs(x) < 1e-4) return h * (1.0 + x * (0.5 + x / 6.0));
  return (std::exp(x) - 1.0) / l;
}

Complex Power(Complex q, int times) {
  Complex out = 1.0;
  for (int i = 0; i < times; ++i) out *= q;
  return out;
}

/// Powers of two that make rows and columns of like size (E. E. Osborne, J. ACM 7, 1960).
Eigen::VectorXd ScaleAlike(Eigen::MatrixXd& a) {
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(a.rows());
  for (int turn = 0; turn < 20; ++turn)
    for (Index i = 0; i < a.rows(); ++i) {
      const double column = a.col(i).lpNorm<1>() - std::abs(a(i, i));
      const double row = a.row(i).lpNorm<1>() - std::abs(a(i, i));
      if (!(column > 0.0) || !(row > 0.0)) continue;
      const double by = std::exp2(std::round(0.5 * std::log2(row / column)));
      a.col(i) *= by;
      a.row(i) /= by;
      scale[i] *= by;
    }
  return scale;
}

struct Modal {
  Eigen::VectorXcd poles;
  Eigen::MatrixXcd input, output;
};

struct StateSpace {
  Eigen::MatrixXd a, b, c;
};

Modal ModesOf(const Eigen::MatrixXd& a, const StateSpace& of) {
  const numerics::Spectrum spectrum = numerics::SpectrumOf(a);
  return {spectrum.values, spectrum.vectors.partialPivLu().solve(of.b.cast<Complex>()),
          of.c * spectrum.vectors};
}

/// Whether the sum over modes is the model, within a part in a million.
bool IsTheModel(const Modal& modal, const StateSpace& of) {
  constexpr double kAlike = 1e-6;
  return std::ranges::all_of(std::array{3.0, 77.0, 410.0}, [&](double hz) {
    const Complex s(1.0, kTwoPi * hz);
    Eigen::MatrixXcd whole = -of.a.cast<Complex>();
    whole.diagonal().array() += s;
    const Eigen::MatrixXcd direct = of.c * whole.partialPivLu().solve(of.b.cast<Complex>());
    const Eigen::MatrixXcd sum =
        modal.output * (s - modal.poles.array()).inverse().matrix().asDiagonal() * modal.input;
    return (sum - direct).norm() < kAlike * direct.norm();
  });
}

/// Of a rotor that is the same in two directions, a disc in the middle between like bearings, the
/// eigenvectors of equal poles may be returned nearly parallel. A relative change of the model by
/// 1e-8 at most makes the poles differ, and the vectors with them.
Modal ModalForm(const plant::LinearModel& model, Index channels) {
  StateSpace of{model.a, {}, {}};
  const Eigen::VectorXd scale = ScaleAlike(of.a);
  of.b = scale.cwiseInverse().asDiagonal() * model.b.leftCols(channels);
  of.c = model.c.topRows(channels) * scale.asDiagonal();
  for (const double apart : {0.0, 1e-10, 1e-9, 1e-8}) {
    Eigen::MatrixXd a = of.a;
    for (Index i = 0; i < a.rows(); ++i)
      for (Index j = 0; j < a.cols(); ++j)
        a(i, j) *= 1.0 + apart * std::sin(1.3 * static_cast<double>(i * i + 1) +
                                          2.1 * static_cast<double>(j * j + 1));
    Modal modal = ModesOf(a, of);
    if (IsTheModel(modal, of)) return modal;
  }
  throw Problem(ExitStatus::kOther,
                "the rig's linear model has no independent modes: no PID is designed for it");
}

/// Without its flexible modes when only the rigid body is known.
plant::PlantModel ModelOf(const plant::PlantConfig& config, Known known) {
  plant::PlantParameters parameters = plant::Reduce(config);
  if (known == Known::kAll) return plant::PlantModel(std::move(parameters));
  rotor::ModalRotor& modes = parameters.modes;
  const Index rigid = modes.rigid_modes;
  modes.frequency_rad_per_s.conservativeResize(rigid);
  modes.damping_ratio.conservativeResize(rigid);
  modes.gyroscopic.conservativeResize(rigid, rigid);
  modes.shapes.conservativeResize(Eigen::NoChange, rigid);
  modes.slopes.conservativeResize(Eigen::NoChange, rigid);
  modes.rigid.conservativeResize(rigid, Eigen::NoChange);
  return plant::PlantModel(std::move(parameters));
}

/// Force per current and per displacement of each axis.
struct AxisSlopes {
  std::vector<double> current, displacement;
};

/// At the point, or at the centre where nothing is carried.
AxisSlopes SlopesOfAxes(const plant::PlantModel& model, const plant::OperatingPoint& point,
                        bool carried) {
  AxisSlopes out;
  for (std::size_t b = 0; b < model.bearings().size(); ++b) {
    const auto slopes = carried ? plant::SlopesAt(model, b, point) : SlopesAtCentre(model, b);
    for (const int plane : {0, 1}) {
      if (out.current.size() == model.channels()) continue;
      out.current.push_back(slopes.current(plane, plane));
      out.displacement.push_back(slopes.displacement(plane, plane));
    }
  }
  return out;
}

/// A rotor that only its spin holds up has poles on the axis itself, where nothing can be counted:
/// they are taken as damped by 0.002 %.
void DampOnAxis(Complex& pole) {
  constexpr double kOnAxis = 2e-5;
  if (pole.imag() != 0.0 && std::abs(pole.real()) < kOnAxis * std::abs(pole))
    pole.real(-kOnAxis * std::abs(pole));
}

/// Of each mode, output times input: real parts, then imaginary ones.
std::vector<double> Residues(const Eigen::MatrixXcd& output, const Eigen::MatrixXcd& input) {
  std::vector<double> out;
  for (Index i = 0; i < output.cols(); ++i) {
    const Eigen::MatrixXcd one = output.col(i) * input.row(i);
    for (Index k = 0; k < one.size(); ++k) out.push_back(one.data()[k].real());
    for (Index k = 0; k < one.size(); ++k) out.push_back(one.data()[k].imag());
  }
  return out;
}

}  // namespace

SampledPlant::SampledPlant(const configuration::RigFile& rig, double speed_rad_per_s, Known known,
                           Coordinates coordinates)
    : coordinates_(std::move(coordinates)),
      period_s_(static_cast<double>(rig.plant.period_ns) * 1e-9),
      speed_rad_per_s_(speed_rad_per_s) {
  const plant::PlantModel model = ModelOf(rig.plant, known);
  const auto channels = static_cast<Index>(model.channels());
  const auto point = plant::FindOperatingPoint(
      model, speed_rad_per_s,
      {Eigen::MatrixXd::Zero(channels, channels), std::vector<bool>(model.channels(), true), 0.0});
  failure_ = point.failure;
  const bool carried = failure_.empty();
  if (carried) static_a_ = point.control_a;
  AxisSlopes slopes = SlopesOfAxes(model, point, carried);
  ki_ = std::move(slopes.current);
  ks_ = std::move(slopes.displacement);
  auto modal = ModalForm(carried ? plant::Linearise(model, speed_rad_per_s, point)
                                 : plant::Linearise(model, speed_rad_per_s),
                         channels);
  whole_delay_ = static_cast<int>(std::floor(model.delay_samples()));
  const double fraction = model.delay_samples() - whole_delay_;
  const double late_s = (1.0 - fraction) * period_s_;
  const double early_s = fraction * period_s_;
  const Index modes = modal.poles.size();
  z_poles_.resize(modes);
  now_.resize(modes);
  before_.resize(modes);
  constexpr double kStands = 0.1;  // 1/s: a free rotation, which no magnet sees
  for (Index i = 0; i < modes; ++i) {
    Complex& l = modal.poles[i];
    DampOnAxis(l);
    z_poles_[i] = std::exp(l * period_s_);
    now_[i] = Held(l, late_s);
    before_[i] = fraction > 0.0 ? std::exp(l * late_s) * Held(l, early_s) : 0.0;
    if (l.real() > kStands) ++growing_;
  }
  input_ = modal.input;
  output_ = modal.output;
  if (!coordinates_.empty()) {
    input_ = input_ * coordinates_.drive;
    output_ = coordinates_.measure * output_;
  }
  residue_ = Residues(output_, input_);
  MakeGrid(modal.poles);
  TakeLightModes(modal.poles);
}

Complex SampledPlant::Gain(Index mode, Complex z) const {
  const Complex q = 1.0 / z;
  return Power(q, whole_delay_) * (now_[mode] + before_[mode] * q);
}

void SampledPlant::TakeLightModes(const Eigen::VectorXcd& poles) {
  constexpr double kTogether = 1e-3;
  std::vector<bool> taken(static_cast<std::size_t>(poles.size()));
  for (Index i = 0; i < poles.size(); ++i) {
    const Complex l = poles[i];
    const bool light = l.imag() > 0.0 && std::abs(l.real()) < kLightlyDamped * std::abs(l);
    if (!light || taken[static_cast<std::size_t>(i)] || l.imag() * period_s_ > 3.0) continue;
    own_damping_ = std::min(own_damping_, -l.real() / std::abs(l));
    std::vector<Index> group;
    for (Index k = i; k < poles.size(); ++k)
      if (std::abs(poles[k] - l) < kTogether * std::abs(l)) group.push_back(k);
    const auto size = static_cast<Index>(group.size());
    LightMode mode{z_poles_[i],
                   {},
                   Eigen::MatrixXcd(size, input_.cols()),
                   Eigen::MatrixXcd(output_.rows(), size),
                   AxisMatrix::Zero(output_.rows(), input_.cols())};
    for (Index k = 0; k < size; ++k) {
      const Index at = group[static_cast<std::size_t>(k)];
      taken[static_cast<std::size_t>(at)] = true;
      mode.poles.push_back(z_poles_[at]);
      mode.input.row(k) = Gain(at, mode.z) * input_.row(at);
      mode.output.col(k) = output_.col(at);
    }
    for (Index k = 0; k < poles.size(); ++k)
      if (std::find(group.begin(), group.end(), k) == group.end())
        mode.others.noalias() +=
            (Gain(k, mode.z) / (mode.z - z_poles_[k]) * output_.col(k)) * input_.row(k);
    light_.push_back(std::move(mode));
  }
}

// The search's innermost loop: real arithmetic, entries side by side, their number known to the
// compiler for four axes.
AxisMatrix SampledPlant::At(Complex z) const {
  const Complex q = std::conj(z) / std::norm(z);
  const Complex late = Power(q, whole_delay_);
  constexpr std::size_t kFourAxes = 16;
  const auto entries = static_cast<std::size_t>(output_.rows() * input_.cols());
  std::array<double, kMaxAxes * kMaxAxes> real{};
  std::array<double, kMaxAxes * kMaxAxes> imaginary{};
  const double* residue = residue_.data();
  const auto add = [&](Complex gain, std::size_t count) {
    const double* r = residue;
    const double* j = residue + count;
    for (std::size_t k = 0; k < count; ++k) {
      real[k] += gain.real() * r[k] - gain.imag() * j[k];
      imaginary[k] += gain.real() * j[k] + gain.imag() * r[k];
    }
  };
  for (Index i = 0; i < z_poles_.size(); ++i) {
    const Complex away = z - z_poles_[i];
    const Complex gain =
        late * (now_[i] + before_[i] * q) * std::conj(away) * (1.0 / std::norm(away));
    if (entries == kFourAxes)
      add(gain, kFourAxes);
    else
      add(gain, entries);
    residue += 2 * entries;
  }
  AxisMatrix out(output_.rows(), input_.cols());
  for (std::size_t k = 0; k < entries; ++k) out.data()[k] = {real[k], imaginary[k]};
  return out;
}

SampledPoint SampledPlant::AtHz(double hz) const {
  const Complex z = std::polar(1.0, kTwoPi * hz * period_s_);
  return {hz, z, At(z)};
}

void SampledPlant::MakeGrid(const Eigen::VectorXcd& poles) {
  constexpr double kFirstHz = 0.2;
  constexpr double kPerDecade = 40.0;
  const double last_hz = 0.5 / period_s_;
  std::vector<double> at{0.0};
  for (double hz = kFirstHz; hz < last_hz; hz *= std::pow(10.0, 1.0 / kPerDecade)) at.push_back(hz);
  at.push_back(last_hz);
  for (const Complex& pole : poles) {
    const double damping = -pole.real() / std::abs(pole);
    const double hz = std::abs(pole) / kTwoPi;
    if (!(pole.imag() > 0.0) || std::abs(damping) > kLightlyDamped) continue;
    const double width = std::max(std::abs(damping), 2e-4);
    for (const double share : {-16.0, -6.0, -2.0, -0.6, 0.6, 2.0, 6.0, 16.0}) {
      const double beside = hz * (1.0 + share * width);
      if (beside > kFirstHz && beside < last_hz) at.push_back(beside);
    }
  }
  std::sort(at.begin(), at.end());
  constexpr double kSame = 1e-5;
  for (const double hz : at)
    if (grid_.empty() || hz > grid_.back().hz * (1.0 + kSame)) grid_.push_back(AtHz(hz));
}

}  // namespace levitas::design
