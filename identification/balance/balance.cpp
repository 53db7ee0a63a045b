#include "identification/balance/balance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/problem.hpp"
#include "common/two_pi.hpp"

namespace levitas::balancing {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;

constexpr double kSamePlaceM = 1e-3;
constexpr int kSpeeds = 100;
constexpr int kSlowest = 10;  ///< of kSpeeds

/// Planes of the fit: those that can be reached first.
std::vector<double> StationsOf(const BalanceRequest& request) {
  std::vector<double> z_m;
  for (const CorrectionPlane& plane : request.planes.planes) z_m.push_back(plane.z_m);
  for (const plant::UnbalanceMass& mass : request.rig.plant.unbalance) {
    const bool there = std::ranges::any_of(
        z_m, [&](double other_m) { return std::abs(other_m - mass.z_m) < kSamePlaceM; });
    if (!there) z_m.push_back(mass.z_m);
  }
  return z_m;
}

RecordedPoint PointOf(const BalanceRequest& request) {
  const auto axes = static_cast<Index>(request.rig.numbers.axes());
  RecordedPoint point{Eigen::VectorXd::Zero(axes), Eigen::VectorXd::Zero(axes), 0.0};
  double count = 0.0;
  for (const RecordedRun& run : request.runs) {
    for (const analysis::TrackedWindow& window : run.windows) {
      point.position_m += window.mean_position_m;
      point.current_a += window.mean_current_a;
      count += 1.0;
    }
    point.bias_current_a = run.bias_current_a;
  }
  point.position_m /= count;
  point.current_a /= count;
  return point;
}

Eigen::VectorXcd AddedOf(const RecordedRun& run, const BalanceRequest& request, Index stations) {
  Eigen::VectorXcd added = Eigen::VectorXcd::Zero(stations);
  for (const AppliedWeight& weight : run.applied) {
    const auto& planes = request.planes.planes;
    const auto found = std::ranges::find(planes, weight.plane, &CorrectionPlane::name);
    if (found == planes.end()) {
      throw BadInput(
          fmt::format("{}: a weight was applied at plane {}, which is none of the planes "
                      "given",
                      run.name, weight.plane));
    }
    added[found - planes.begin()] += weight.added_kg_m;
  }
  return added;
}

/// Deviations along and across a complex number.
void Deviations(Complex value, Index at, const Eigen::MatrixXd& covariance, double& along,
                double& angle_rad) {
  const Index n = covariance.rows() / 2;
  Eigen::Matrix2d both;
  both << covariance(at, at), covariance(at, n + at), covariance(n + at, at),
      covariance(n + at, n + at);
  const double phase = std::arg(value);
  const Eigen::Vector2d radial(std::cos(phase), std::sin(phase));
  const Eigen::Vector2d across(-radial[1], radial[0]);
  along = std::sqrt(std::max(0.0, radial.dot(both * radial)));
  const double size = std::max(std::abs(value), 1e-300);
  angle_rad = std::min(0.5 * kTwoPi, std::sqrt(std::max(0.0, across.dot(both * across))) / size);
}

/// In the direction that the last run turns.
std::vector<double> SpeedsOf(const BalanceRequest& request) {
  const bool backwards = request.runs.back().windows.back().speed_rad_per_s < 0.0;
  const double top_rad_per_s = backwards ? -request.top_rad_per_s : request.top_rad_per_s;
  std::vector<double> speeds;
  for (int i = kSlowest; i <= kSpeeds; ++i) speeds.push_back(top_rad_per_s * i / kSpeeds);
  return speeds;
}

LawOverSpeed LawOf(const BalanceRequest& request) {
  if (request.law) return FromController(*request.law, request.rig.numbers.period_s());
  std::vector<analysis::TrackedWindow> windows;
  for (const RecordedRun& run : request.runs) {
    windows.insert(windows.end(), run.windows.begin(), run.windows.end());
  }
  return FromRecord(std::move(windows));
}

double ModalDeviation(const Eigen::VectorXd& share, const Eigen::MatrixXd& covariance) {
  const Index n = share.size();
  const double real = share.dot(covariance.topLeftCorner(n, n) * share);
  const double imaginary = share.dot(covariance.bottomRightCorner(n, n) * share);
  return std::sqrt(std::max(0.0, 0.5 * (real + imaginary)));
}

/// The moment arms of static and couple unbalance, then the bending modes that the speeds meet.
void AddModal(const BalanceRig& rig, const Eigen::VectorXcd& left, double top_rad_per_s,
              BalanceResult& made, const std::vector<double>& z_m) {
  const auto add = [&](const std::string& name, double hz, const Eigen::VectorXd& share) {
    made.modal.push_back({name, hz, share.cast<Complex>().dot(made.fit.unbalance_kg_m),
                          share.cast<Complex>().dot(left),
                          ModalDeviation(share, made.fit.covariance)});
  };
  const Index planes = rig.planes();
  add("static", 0.0, Eigen::VectorXd::Ones(planes));
  Eigen::VectorXd arm(planes);
  for (Index i = 0; i < planes; ++i) {
    arm[i] = z_m[static_cast<std::size_t>(i)] - rig.centre_z_m();
  }
  add("couple", 0.0, arm);
  const Eigen::VectorXd& w = rig.frequency_rad_per_s();
  for (Index mode = 0; mode < w.size(); ++mode) {
    if (w[mode] < 1.0) continue;
    const Eigen::VectorXd shape = rig.shapes().row(mode).transpose();
    add(fmt::format("mode {}", mode - rig.rigid_modes() + 1), w[mode] / kTwoPi,
        shape / rig.largest_deflection()[mode]);
    if (w[mode] > top_rad_per_s) break;
  }
}

double ShareLeft(const std::vector<SpeedResponse>& responses, const Eigen::VectorXcd& added) {
  double was = 0.0;
  double is = 0.0;
  for (const SpeedResponse& at : responses) {
    was += at.now_m.squaredNorm();
    is += (at.now_m + at.per_unbalance * added).squaredNorm();
  }
  return was > 0.0 ? std::sqrt(is / was) : 0.0;
}

/// The model's responses, put right by what the last weights did where there are two runs.
std::vector<SpeedResponse> ResponsesOf(const BalanceRequest& request, const BalanceRig& rig,
                                       const std::vector<TrackedRun>& runs, BalanceResult& made) {
  auto responses = ResponsesOverSpeed(rig, made.fit.place, LawOf(request), SpeedsOf(request));
  for (SpeedResponse& at : responses) at.now_m = at.per_unbalance * made.fit.unbalance_kg_m;
  if (runs.size() < 2) return responses;
  const TrackedRun& before = runs[runs.size() - 2];
  made.influence =
      UpdateInfluence(MeasuredResponse(before.windows), MeasuredResponse(runs.back().windows),
                      runs.back().added_kg_m - before.added_kg_m, made.fit.runout_m, responses);
  return responses;
}

/// Corrections as they can be placed; returns what they add, per plane of the rig.
Eigen::VectorXcd PlaceAll(const BalanceRequest& request, const Correction& correction,
                          Index stations, BalanceResult& made) {
  Eigen::VectorXcd added = Eigen::VectorXcd::Zero(stations);
  for (std::size_t i = 0; i < request.planes.planes.size(); ++i) {
    const auto at = static_cast<Index>(i);
    CorrectionResult one{request.planes.planes[i], correction.added_kg_m[at], 0.0, 0.0, {}};
    Deviations(one.added_kg_m, at, correction.covariance, one.deviation_kg_m,
               one.angle_deviation_rad);
    if (one.plane.radius_m > 0.0) {
      one.placed = PlaceWeights(one.added_kg_m, one.plane, request.planes.drill);
    } else {
      one.placed.moment_kg_m = one.added_kg_m;
    }
    added[at] = one.placed.moment_kg_m;
    made.corrections.push_back(std::move(one));
  }
  return added;
}

void TakePlanes(const std::vector<double>& z_m, BalanceResult& made) {
  for (std::size_t i = 0; i < z_m.size(); ++i) {
    const auto at = static_cast<Index>(i);
    PlaneResult one;
    one.z_m = z_m[i];
    one.unbalance_kg_m = made.fit.unbalance_kg_m[at];
    Deviations(one.unbalance_kg_m, at, made.fit.covariance, one.deviation_kg_m,
               one.angle_deviation_rad);
    if (i < made.corrections.size()) one.name = made.corrections[i].plane.name;
    made.planes.push_back(std::move(one));
  }
}

}  // namespace

BalanceResult Balance(const BalanceRequest& request) {
  CheckPlanes(request.planes, request.rig);
  const std::vector<double> z_m = StationsOf(request);
  const BalanceRig rig(request.rig, PointOf(request), z_m);
  std::vector<TrackedRun> runs;
  BalanceResult made;
  made.lowest_rad_per_s = request.top_rad_per_s;
  for (const RecordedRun& run : request.runs) {
    runs.push_back({run.windows, AddedOf(run, request, rig.planes())});
    for (const auto& window : run.windows) {
      const double speed = std::abs(window.speed_rad_per_s);
      made.lowest_rad_per_s = std::min(made.lowest_rad_per_s, speed);
      made.highest_rad_per_s = std::max(made.highest_rad_per_s, speed);
    }
  }
  Predictor predictor(rig, runs);
  made.fit = FitUnbalance(predictor);
  // What the rotor is like now.
  made.fit.unbalance_kg_m += runs.back().added_kg_m;
  made.unknowns = rig.unknowns();
  made.mass_kg = rig.mass_kg();
  made.law_known = request.law.has_value();
  const auto responses = ResponsesOf(request, rig, runs, made);
  std::vector<Index> accessible;
  for (std::size_t i = 0; i < request.planes.planes.size(); ++i) {
    accessible.push_back(static_cast<Index>(i));
  }
  const Correction correction = Correct(responses, accessible, made.fit.covariance);
  const Eigen::VectorXcd added = PlaceAll(request, correction, rig.planes(), made);
  TakePlanes(z_m, made);
  AddModal(rig, made.fit.unbalance_kg_m + added, request.top_rad_per_s, made, z_m);
  made.orbits = ForecastOrbits(responses, added, made.fit.covariance);
  made.left_share = ShareLeft(responses, added);
  return made;
}

}  // namespace levitas::balancing
