#include "design/hinf/hinf_design.hpp"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "common/problem.hpp"
#include "design/hinf/generalised_plant.hpp"
#include "design/synthesis/discretisation.hpp"
#include "design/synthesis/order_reduction.hpp"

namespace levitas::hinf {

namespace {

using Eigen::Index;
using synthesis::StateSpace;

/// y [um] -> u [A], the minus sign inside: as state_space_law.hpp wants it.
law::StateSpaceConfig BlocksOf(const StateSpace& controller, double period_s) {
  const auto modal = synthesis::ModalForm(synthesis::Tustin(controller, period_s).matrices);
  law::StateSpaceConfig out;
  out.axes = static_cast<std::size_t>(controller.outputs());
  out.discrete = true;
  for (std::size_t i = 0; i < out.axes; ++i) {
    out.input_v_per_m[i] = 1e6;  // one volt per micrometre
    out.output_a_per_v[i] = 1.0;
    for (std::size_t j = 0; j < out.axes; ++j)
      out.direct[i][j] = modal.D(static_cast<Index>(i), static_cast<Index>(j));
  }
  for (const auto& part : modal.parts) {
    law::ModalBlock block;
    const bool pair = part.B.rows() == 2;
    block.pole_real = part.pole.real();
    block.pole_imaginary = pair ? part.pole.imag() : 0.0;
    for (std::size_t i = 0; i < out.axes; ++i) {
      const auto at = static_cast<Index>(i);
      block.first_input[i] = part.B(0, at);
      block.first_output[i] = part.C(at, 0);
      if (!pair) continue;
      block.second_input[i] = part.B(1, at);
      block.second_output[i] = part.C(at, 1);
    }
    out.blocks.push_back(block);
  }
  return out;
}

}  // namespace

HinfDesign DesignHinf(const plant::PlantConfig& rig, double current_limit_a,
                      const HinfWeights& weights, const HinfDesignOptions& options) {
  const WeightedPlant weighted = BuildPlant(rig, weights, options.speed_rad_per_s);
  synthesis::DkOptions dk;
  dk.turns = options.turns;
  dk.largest_order = 0;
  dk.peak.points = 40;
  dk.peak.tolerance = 0.03;
  dk.hinf.relaxation = 1.05;
  const synthesis::DkResult made = IterateDk(weighted.plant, weighted.blocks, dk);
  const auto mu_of = [&](const StateSpace& controller) {
    const StateSpace loop = LowerFeedback(weighted.plant.system, controller);
    if (!IsStable(Balanced(loop))) return static_cast<double>(INFINITY);
    return PeakOfMu(loop, weighted.blocks, dk.peak).upper;
  };
  const auto most = static_cast<Index>(law::StateSpaceConfig::kMaxStates);
  const auto balanced = synthesis::Balance(made.controller);
  StateSpace controller = balanced.Truncated(std::min(most, balanced.states()));
  const double allowed = made.peak.upper * (1.0 + options.allowed_loss);
  const double mu = mu_of(controller);
  if (!(mu <= allowed) || controller.states() > most)
    throw Problem(ExitStatus::kOther,
                  fmt::format("the controller has {} states, and with the {} that a law may have "
                              "mu rises from {:.3g} to {:.3g}: lower mode_hz, or the rig's modes",
                              made.controller.states(), most, made.peak.upper, mu));
  HinfDesign out;
  out.law.period_s = weighted.period_s;
  out.law.current_limit_a = current_limit_a;
  out.law.state_space = BlocksOf(controller, weighted.period_s);
  out.mu = mu;
  out.states = controller.states();
  out.turns = made.turns;
  return out;
}

}  // namespace levitas::hinf
