#pragma once
// The synthesis weights that make a law good by the analysis weights.
//
// Method     numerics/minimum/evolution_strategy.hpp over the logarithms of the synthesis weights;
//            each point is a synthesis (design/hinf) judged by loop_figures.hpp.
// Cost       the worst of mu/1, |S|/sensitivity, orbit/orbit_m, current/current_a, and a tenth of
//            their mean; 2 and more on top for a law with a pole that does not decay; 20 and more
//            for an unstable loop; 1000 where there is no law.
// Same seed  same law, however many processors. Interrupted: the best so far.
// Thread     that of the caller and one for every other processor; `seen` by the caller's.

#include <functional>
#include <string>

#include "design/hinf/hinf_design.hpp"
#include "design/search/loop_figures.hpp"

namespace levitas::design {

struct SearchGoals {
  double mu{1.0};
  double sensitivity{3.0};
  double orbit_m{30e-6};
  double current_a{0.6};
};

struct SearchOptions {
  std::size_t evaluations{300};
  double first_step{0.25};
  std::uint64_t seed{1};
  SearchGoals goals;
};

struct SearchResult {
  hinf::HinfWeights weights;
  double cost{};
  std::size_t evaluations{};
};

[[nodiscard]] double CostOf(const LoopFigures& figures, const SearchGoals& goals);

[[nodiscard]] SearchResult SearchWeights(const configuration::RigFile& rig,
                                         const hinf::HinfWeights& start,
                                         const hinf::HinfDesignOptions& design,
                                         const FigureMaker& figures, const SearchOptions& options,
                                         const std::function<bool(std::size_t, double)>& seen);

}  // namespace levitas::design
