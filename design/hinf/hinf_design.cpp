#include "design/hinf/hinf_design.hpp"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/problem.hpp"
#include "design/hinf/plane_plant.hpp"
#include "design/synthesis/central_controller.hpp"
#include "design/synthesis/discretisation.hpp"
#include "design/synthesis/order_reduction.hpp"

namespace levitas::hinf {

namespace {

using Eigen::Index;
using synthesis::StateSpace;

struct Made {
  StateSpace controller;
  double gamma{};
};

/// Central controller a little above the smallest gamma, which bisection finds to 3 %.
Made Relaxed(const synthesis::GeneralisedPlant& plant) {
  constexpr double kWidth = 1.03;
  constexpr double kAbove = 1.05;
  constexpr double kMost = 1e6;
  const synthesis::NormalPlant normal = synthesis::Normalise(plant);
  synthesis::Solved solved;
  const auto possible = [&](double gamma) {
    return synthesis::Solve(normal, gamma, solved) == synthesis::Verdict::kSolved;
  };
  double high = std::max(4.0, 1.1 * synthesis::DirectLimit(normal));
  double low = synthesis::DirectLimit(normal);
  while (!possible(high)) {
    low = high;
    high *= 4.0;
    if (high > kMost)
      throw Problem(ExitStatus::kOther,
                    fmt::format("no controller keeps the weighted gain below {:g}: {}", kMost,
                                TextOf(synthesis::Solve(normal, high, solved))));
  }
  while (high > kWidth * low && high > 1e-6) {
    const double middle = low > 0.05 * high ? std::sqrt(low * high) : 0.3 * high;
    (possible(middle) ? high : low) = middle;
  }
  for (const double above : {kAbove, 1.1, 1.3})
    if (possible(above * high))
      return {synthesis::Controller(normal, solved, above * high), above * high};
  throw Problem(ExitStatus::kOther,
                fmt::format("the Riccati equations lose their solution above gamma {:.3g}: scale "
                            "the weights to like size",
                            high));
}

/// Puts the blocks of one plane's controller between its axes. y [um] -> u [A], the minus inside.
void Place(const synthesis::ModalSystem& modal, const std::vector<std::size_t>& axes,
           law::StateSpaceConfig& out) {
  for (std::size_t i = 0; i < axes.size(); ++i)
    for (std::size_t j = 0; j < axes.size(); ++j)
      out.direct[axes[i]][axes[j]] = modal.D(static_cast<Index>(i), static_cast<Index>(j));
  for (const auto& part : modal.parts) {
    law::ModalBlock block;
    const bool pair = part.B.rows() == 2;
    block.pole_real = part.pole.real();
    block.pole_imaginary = pair ? part.pole.imag() : 0.0;
    for (std::size_t i = 0; i < axes.size(); ++i) {
      const auto at = static_cast<Index>(i);
      block.first_input[axes[i]] = part.B(0, at);
      block.first_output[axes[i]] = part.C(at, 0);
      if (!pair) continue;
      block.second_input[axes[i]] = part.B(1, at);
      block.second_output[axes[i]] = part.C(at, 1);
    }
    out.blocks.push_back(block);
  }
}

}  // namespace

HinfDesign MakeLaw(const plant::PlantConfig& rig, const HinfWeights& weights,
                   const HinfDesignOptions& options) {
  const auto planes = BuildPlanes(rig, weights, options.top_speed_rad_per_s);
  const double period_s = static_cast<double>(rig.period_ns) * 1e-9;
  std::size_t copies = 0;
  for (const auto& plane : planes) copies += 1 + plane.same_as.size() / plane.axes.size();
  const std::size_t most = std::min(options.most_states, law::StateSpaceConfig::kMaxStates);
  const auto each = static_cast<Index>(most / copies);
  HinfDesign out;
  out.law.period_s = period_s;
  out.law.current_limit_a = options.current_limit_a;
  out.slowest_pole_1_per_s = std::numeric_limits<double>::infinity();
  law::StateSpaceConfig blocks;
  blocks.discrete = true;
  for (const auto& plane : planes) {
    const Made made = Relaxed(plane.plant);
    const double decay = -synthesis::Poles(made.controller).real().maxCoeff();
    out.slowest_pole_1_per_s = std::min(out.slowest_pole_1_per_s, decay);
    const auto balanced = synthesis::Balance(made.controller);
    const StateSpace kept = balanced.Truncated(std::min(each, balanced.states()));
    const auto modal = synthesis::ModalForm(synthesis::Tustin(kept, period_s).matrices);
    out.gamma = std::max(out.gamma, made.gamma);
    std::vector<std::size_t> all = plane.axes;
    all.insert(all.end(), plane.same_as.begin(), plane.same_as.end());
    for (std::size_t first = 0; first < all.size(); first += plane.axes.size()) {
      Place(modal,
            {all.begin() + static_cast<std::ptrdiff_t>(first),
             all.begin() + static_cast<std::ptrdiff_t>(first + plane.axes.size())},
            blocks);
      out.full_states += static_cast<std::size_t>(made.controller.states());
    }
    blocks.axes += all.size();
  }
  for (std::size_t i = 0; i < blocks.axes; ++i) {
    blocks.input_v_per_m[i] = 1e6;  // one volt per micrometre
    blocks.output_a_per_v[i] = 1.0;
  }
  out.states = blocks.states();
  out.law.state_space = std::move(blocks);
  return out;
}

HinfDesign DesignHinf(const plant::PlantConfig& rig, const HinfWeights& weights,
                      const HinfDesignOptions& options) {
  for (const auto& plane : BuildPlanes(rig, weights, options.top_speed_rad_per_s))
    synthesis::CheckSolvable(plane.plant);
  HinfDesign out = MakeLaw(rig, weights, options);
  if (!(out.slowest_pole_1_per_s > 0.0))
    throw Problem(ExitStatus::kOther,
                  fmt::format("the law itself grows by {:.3g} 1/s: it winds up wherever a current "
                              "is at its limit. Ask for less: a larger position_m, or a smaller "
                              "control_hz or disturbance_a",
                              -out.slowest_pole_1_per_s));
  return out;
}

}  // namespace levitas::hinf
