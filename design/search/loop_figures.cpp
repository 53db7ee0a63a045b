#include "design/search/loop_figures.hpp"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "analysis/sampled_loop.hpp"
#include "common/ellipse.hpp"
#include "common/rotational_speed.hpp"
#include "common/two_pi.hpp"
#include "numerics/dense/eigenvalues.hpp"
#include "numerics/dense/spectrum.hpp"

namespace levitas::design {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;

std::vector<double> GridHz(const uncertainty::AnalysisWeights& weights, int points,
                           const std::vector<double>& modes_hz) {
  std::vector<double> out;
  for (int i = 0; i < points; ++i) {
    // A fifth of the points below 10 Hz, where nothing resonates.
    const double share = static_cast<double>(i) / (points - 1);
    const double middle = 10.0;
    out.push_back(share < 0.2 ? weights.first_hz * std::pow(middle / weights.first_hz, share / 0.2)
                              : middle * std::pow(weights.last_hz / middle, (share - 0.2) / 0.8));
  }
  for (const double hz : modes_hz)
    for (const double at : {0.99, 1.0, 1.01}) out.push_back(at * hz);
  return out;
}

}  // namespace

FigureMaker::FigureMaker(configuration::RigFile rig,
                         const std::vector<uncertainty::Parameter>& parameters,
                         FigureOptions options)
    : rig_(std::move(rig)), options_(std::move(options)) {
  for (const double w : options_.speeds_rad_per_s) {
    Speed speed{w, std::make_unique<uncertainty::UncertainPlant>(rig_, parameters, w), {}};
    for (const double hz : GridHz(options_.weights, options_.grid_points, speed.plant->ModesHz()))
      speed.grid.push_back(speed.plant->At(hz));
    speeds_.push_back(std::move(speed));
  }
  const Complex j(0.0, 1.0);
  for (const double w : options_.orbit_speeds_rad_per_s) {
    const uncertainty::UncertainPlant plant(rig_, {}, w);
    Harmonic first{w, plant.At(w / kTwoPi), plant.PositionOf(rig_.plant.unbalance, w)};
    Harmonic third{w, plant.At(3.0 * w / kTwoPi), {}};
    third.position_m =
        plant.PositionOf(3.0 * w / kTwoPi, 0.0, options_.third_n, j * options_.third_n);
    harmonics_.push_back(std::move(first));
    harmonics_.push_back(std::move(third));
  }
}

void FigureMaker::Note(const Speed& speed, const uncertainty::PlantPoint& point,
                       const Eigen::MatrixXcd& law, LoopFigures& out) const {
  const Eigen::MatrixXcd m = uncertainty::LoopMatrix(point, law, options_.weights);
  const double mu = uncertainty::QuickMu(m, point.zw.rows());
  if (mu > out.mu) {
    out.mu = mu;
    out.mu_hz = point.hz;
    out.mu_rpm = RadPerSToRpm(speed.rad_per_s);
  }
  const double s = uncertainty::SensitivityOf(point, law).diagonal().cwiseAbs().maxCoeff();
  if (s > out.sensitivity) {
    out.sensitivity = s;
    out.sensitivity_hz = point.hz;
    out.sensitivity_rpm = RadPerSToRpm(speed.rad_per_s);
  }
}

void FigureMaker::AddHarmonics(const uncertainty::LawResponse& law, LoopFigures& out) const {
  for (std::size_t i = 0; i + 1 < harmonics_.size(); i += 2) {
    Eigen::VectorXd orbit = Eigen::VectorXd::Zero(harmonics_[i].position_m.size() / 2);
    Eigen::VectorXd current = Eigen::VectorXd::Zero(harmonics_[i].position_m.size());
    for (const Harmonic* h : {&harmonics_[i], &harmonics_[i + 1]}) {
      const Eigen::MatrixXcd k = law.At(h->point.hz);
      const Eigen::VectorXcd y = uncertainty::SensitivityOf(h->point, k) * h->position_m;
      current += (k * y).cwiseAbs();
      for (Index b = 0; b < orbit.size(); ++b) orbit(b) += LargestRadius(y(2 * b), y(2 * b + 1));
    }
    const double rpm = RadPerSToRpm(harmonics_[i].speed_rad_per_s);
    if (orbit.size() > 0 && orbit.maxCoeff() > out.orbit_m) {
      out.orbit_m = orbit.maxCoeff();
      out.orbit_rpm = rpm;
    }
    if (current.maxCoeff() > out.current_a) {
      out.current_a = current.maxCoeff();
      out.current_rpm = rpm;
    }
  }
}

LoopFigures FigureMaker::Of(const law::LawConfig& law) const {
  constexpr double kLightlyDamped = 0.12;
  LoopFigures out;
  out.stable = true;
  const uncertainty::LawResponse response(law);
  for (const Speed& speed : speeds_) {
    const auto loop = analysis::CloseLoop(rig_.plant, law, speed.rad_per_s);
    const Eigen::VectorXcd poles = numerics::EigenvaluesOf(analysis::ClosedLoopMatrix(loop));
    out.pole_modulus = std::max(out.pole_modulus, poles.cwiseAbs().maxCoeff());
    out.stable = out.stable && poles.cwiseAbs().maxCoeff() < 1.0;  // not by what is no number
    for (const auto& point : speed.grid) Note(speed, point, response.At(point.hz), out);
    for (const Complex& z : poles) {
      if (!(z.imag() > 0.0) || std::abs(z) < 0.5) continue;
      const Complex s = std::log(z) / loop.period_s;
      if (-s.real() > kLightlyDamped * std::abs(s)) continue;
      const double hz = s.imag() / kTwoPi;
      if (hz < options_.weights.first_hz || hz > options_.weights.last_hz) continue;
      Note(speed, speed.plant->At(hz), response.At(hz), out);
    }
  }
  AddHarmonics(response, out);
  return out;
}

}  // namespace levitas::design
