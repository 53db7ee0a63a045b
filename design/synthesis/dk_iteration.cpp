#include "design/synthesis/dk_iteration.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <utility>

#include "common/problem.hpp"
#include "design/synthesis/magnitude_fit.hpp"
#include "design/synthesis/structured_singular_value.hpp"

namespace levitas::synthesis {

namespace {

using Eigen::Index;

/// Full complex blocks that hold the given ones.
UncertaintyBlocks AsFullBlocks(const UncertaintyBlocks& blocks) {
  UncertaintyBlocks out;
  for (const auto& block : blocks) {
    if (block.kind == BlockKind::kFullComplex) {
      out.push_back(block);
    } else {
      out.insert(out.end(), static_cast<std::size_t>(block.rows), UncertaintyBlock{});
    }
  }
  return out;
}

/// One system per block, repeated over its rows (or columns).
StateSpace Repeated(const std::vector<StateSpace>& scalings, const UncertaintyBlocks& full,
                    bool rows, Index rest) {
  StateSpace out = Gain(Eigen::MatrixXd(0, 0));
  for (std::size_t i = 0; i < full.size(); ++i)
    for (Index k = 0; k < (rows ? full[i].rows : full[i].columns); ++k)
      out = Append(out, rows ? scalings[i] : Inverse(scalings[i]));
  return Append(out, Gain(Eigen::MatrixXd::Identity(rest, rest)));
}

GeneralisedPlant Scaled(const GeneralisedPlant& plant, const std::vector<StateSpace>& scalings,
                        const UncertaintyBlocks& full) {
  GeneralisedPlant out = plant;
  const StateSpace before = Repeated(scalings, full, false, plant.controls);
  const StateSpace after = Repeated(scalings, full, true, plant.measurements);
  out.system = Series(Series(before, plant.system), after);
  return out;
}

/// The scalings of the upper bound at each frequency, relative to the last block's, as systems.
std::vector<StateSpace> FitScalings(const StateSpace& loop, const UncertaintyBlocks& full,
                                    const MuPeak& peak, const DkOptions& options) {
  std::vector<double> at;
  for (const auto& point : peak.grid)
    if (point.rad_per_s > 0.0 && std::isfinite(point.rad_per_s) &&
        (at.empty() || point.rad_per_s > at.back() * 1.001))
      at.push_back(point.rad_per_s);
  const auto points = static_cast<Index>(at.size());
  Eigen::VectorXd w(points), weights(points);
  Eigen::MatrixXd magnitudes(points, static_cast<Index>(full.size()));
  for (Index i = 0; i < points; ++i) {
    w(i) = at[static_cast<std::size_t>(i)];
    const MuUpper upper = MuUpperBound(Response(loop, w(i)), full, true);
    weights(i) = upper.value;
    Index row = 0;
    for (std::size_t k = 0; k < full.size(); ++k) {
      magnitudes(i, static_cast<Index>(k)) = std::sqrt(upper.scaling.rows(row, row).real());
      row += full[k].rows;
    }
  }
  // A scaling matters where mu is near its peak.
  weights = (weights / weights.maxCoeff()).cwiseMax(0.05);
  std::vector<StateSpace> out;
  const Eigen::VectorXd last = magnitudes.rightCols(1);
  for (Index k = 0; k + 1 < magnitudes.cols(); ++k)
    out.push_back(FitMagnitudeUpTo(w, magnitudes.col(k).cwiseQuotient(last), weights,
                                   options.largest_order, options.fit_error)
                      .system);
  out.push_back(Gain(Eigen::MatrixXd::Ones(1, 1)));
  return out;
}

}  // namespace

DkResult IterateDk(const GeneralisedPlant& plant, const UncertaintyBlocks& blocks,
                   const DkOptions& options) {
  CheckBlocks(blocks, plant.errors(), plant.disturbances());
  const UncertaintyBlocks full = AsFullBlocks(blocks);
  std::vector<StateSpace> scalings(full.size(), Gain(Eigen::MatrixXd::Ones(1, 1)));
  DkResult best;
  HinfOptions hinf = options.hinf;
  for (int turn = 0; turn < options.turns; ++turn) {
    std::optional<HinfController> made;
    try {
      made = Synthesise(Scaled(plant, scalings, full), hinf);
    } catch (const Problem&) {
      if (turn == 0) throw;
      break;  // the scaled plant is beyond the method's digits: the best so far stands
    }
    hinf.first_gamma = made->gamma;
    const StateSpace loop = LowerFeedback(plant.system, made->controller);
    if (!IsStable(Balanced(loop))) break;
    MuPeak peak = PeakOfMu(loop, blocks, options.peak);
    const double before = best.turns.empty() ? INFINITY : best.peak.upper;
    best.turns.push_back({made->gamma, peak.upper, made->controller.states()});
    if (turn + 1 < options.turns) scalings = FitScalings(loop, full, peak, options);
    const bool settled = !(peak.upper < before * (1.0 - options.settled));
    if (peak.upper < before) {
      best.controller = std::move(made->controller);
      best.peak = std::move(peak);
    }
    if (settled) break;
  }
  return best;
}

}  // namespace levitas::synthesis
