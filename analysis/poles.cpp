#include "analysis/poles.hpp"

#include <fmt/core.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/sampled_loop.hpp"
#include "analysis/whirl_direction.hpp"
#include "numerics/dense/eigenvalues.hpp"
#include "numerics/dense/spectrum.hpp"

namespace levitas::analysis {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
/// An eigenvalue this small is a delay without a counterpart in continuous time.
constexpr double kDeadbeatModulus = 1e-8;
/// Poles of the two planes closer than this (relative to |s|) are one pole twice. Larger than the
/// scatter of the eigenvalue solver for a pair, far smaller than any gyroscopic split of interest.
constexpr double kSamePole = 1e-7;

bool Same(const Pole& a, const Pole& b) {
  return std::abs(a.s_rad_per_s - b.s_rad_per_s) < kSamePole * std::abs(a.s_rad_per_s);
}

/// First of the poles after `first` that is not the same pole.
std::size_t EndOfGroup(const std::vector<Pole>& poles, std::size_t first) {
  std::size_t end = first + 1;
  while (end < poles.size() && Same(poles[first], poles[end])) ++end;
  return end;
}

/// Gives every oscillating pole its sign. Eigenvectors of equal poles are any mixture of the two
/// whirl directions, so such a group is split by rank instead.
void Sign(std::vector<Pole>& poles) {
  for (std::size_t first = 0; first < poles.size();) {
    const std::size_t end = EndOfGroup(poles, first);
    const auto begin = poles.begin() + static_cast<std::ptrdiff_t>(first);
    const auto stop = poles.begin() + static_cast<std::ptrdiff_t>(end);
    std::sort(begin, stop,
              [](const Pole& a, const Pole& b) { return a.forward_share < b.forward_share; });
    for (std::size_t i = first; i < end; ++i) {
      const bool alone = end - first == 1;
      const bool backward = alone ? poles[i].forward_share < 0.5 : i - first < (end - first) / 2;
      if (backward) poles[i].frequency_hz = -poles[i].frequency_hz;
    }
    first = end;
  }
}

/// Real poles that both planes share are kept once.
void Pair(std::vector<Pole>& poles) {
  std::vector<Pole> kept;
  for (std::size_t first = 0; first < poles.size();) {
    const std::size_t end = EndOfGroup(poles, first);
    for (std::size_t i = first; i < end; i += 2) kept.push_back(poles[i]);
    first = end;
  }
  poles = std::move(kept);
}

void SortByPlace(std::vector<Pole>& poles) {
  std::sort(poles.begin(), poles.end(), [](const Pole& a, const Pole& b) {
    if (a.s_rad_per_s.imag() != b.s_rad_per_s.imag()) {
      return a.s_rad_per_s.imag() < b.s_rad_per_s.imag();
    }
    return a.s_rad_per_s.real() < b.s_rad_per_s.real();
  });
}

/// Diagonal scaling by powers of two that makes rows and columns of like size (Osborne 1960):
/// metres beside amperes beside integrators cost the eigenvalue solver half its digits otherwise.
/// Returns the scale d of x = d x'.
Eigen::VectorXd Balance(Eigen::MatrixXd& matrix) {
  constexpr int kMostRounds = 30;
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(matrix.rows());
  bool changed = true;
  for (int round = 0; changed && round < kMostRounds; ++round) {
    changed = false;
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
      const double diagonal = std::abs(matrix(i, i));
      const double column = matrix.col(i).lpNorm<1>() - diagonal;
      const double row = matrix.row(i).lpNorm<1>() - diagonal;
      if (!(column > 0.0) || !(row > 0.0)) continue;
      const double factor = std::exp2(std::round(0.5 * std::log2(row / column)));
      if (factor == 1.0) continue;
      matrix.col(i) *= factor;
      matrix.row(i) /= factor;
      scale[i] *= factor;
      changed = true;
    }
  }
  return scale;
}

Pole PoleOf(std::complex<double> z, double period_s) {
  Pole pole;
  pole.z = z;
  pole.s_rad_per_s = std::log(z) / period_s;
  pole.frequency_hz = pole.s_rad_per_s.imag() / kTwoPi;
  const double modulus = std::abs(pole.s_rad_per_s);
  pole.damping_ratio = modulus > 0.0 ? -pole.s_rad_per_s.real() / modulus : 0.0;
  return pole;
}

}  // namespace

bool Grows(const Pole& pole) { return !(std::abs(pole.z) < 1.0); }

std::vector<Pole> WorstFirst(std::vector<Pole> poles) {
  std::stable_sort(poles.begin(), poles.end(), [](const Pole& a, const Pole& b) {
    if (Grows(a) != Grows(b)) return Grows(a);
    if (Grows(a)) return std::abs(a.z) > std::abs(b.z);
    return a.damping_ratio < b.damping_ratio;
  });
  return poles;
}

std::string WhyUnstable(const LoopPoles& loop) {
  const auto worst = WorstFirst(loop.poles);
  if (worst.empty() || !Grows(worst.front())) {
    return "the magnets cannot carry the static load";
  }
  const Pole& pole = worst.front();
  const double rate = pole.s_rad_per_s.real();
  const std::string grows =
      rate > 0.0 ? fmt::format("grows e-fold every {:.3g} ms", 1e3 / rate) : "does not decay";
  if (pole.frequency_hz == 0.0) {
    return fmt::format("a pole without oscillation {}: too little stiffness against the magnets'",
                       grows);
  }
  return fmt::format("a pole at {:.1f} Hz {}", std::abs(pole.frequency_hz), grows);
}

LoopPoles ClosedLoopPoles(const plant::PlantConfig& plant, const law::LawConfig& law,
                          double speed_rad_per_s) {
  return PolesOf(CloseLoop(plant, law, speed_rad_per_s), speed_rad_per_s);
}

LoopPoles PolesOf(const SampledLoop& loop, double speed_rad_per_s) {
  Eigen::MatrixXd closed = ClosedLoopMatrix(loop);
  const Eigen::VectorXd scale = Balance(closed);
  const numerics::Spectrum spectrum = numerics::SpectrumOf(closed);
  const Eigen::VectorXcd& values = spectrum.values;
  const Eigen::MatrixXcd vectors = scale.asDiagonal() * spectrum.vectors;

  LoopPoles result;
  result.speed_rad_per_s = speed_rad_per_s;
  result.largest_pole_modulus = values.cwiseAbs().maxCoeff();
  result.point = loop.point;
  result.stable = result.largest_pole_modulus < 1.0 && loop.point.failure.empty();
  std::vector<Pole> oscillating;
  std::vector<Pole> real;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (std::abs(values[i]) < kDeadbeatModulus) {
      ++result.deadbeat_poles;
    } else if (values[i].imag() > 0.0) {
      oscillating.push_back(PoleOf(values[i], loop.period_s));
      oscillating.back().forward_share = ForwardShare(vectors.col(i), loop.modes);
    } else if (values[i].imag() == 0.0) {
      real.push_back(PoleOf(values[i], loop.period_s));
      real.back().forward_share = 0.5;
    }
  }
  SortByPlace(oscillating);
  SortByPlace(real);
  Sign(oscillating);
  Pair(real);
  result.poles = std::move(oscillating);
  result.poles.insert(result.poles.end(), real.begin(), real.end());
  std::stable_sort(result.poles.begin(), result.poles.end(), [](const Pole& a, const Pole& b) {
    return std::abs(a.frequency_hz) < std::abs(b.frequency_hz);
  });
  return result;
}

}  // namespace levitas::analysis
