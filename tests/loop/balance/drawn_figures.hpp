#pragma once
// Many outcomes as a table, and what is promised of each.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "tests/loop/balance/drawn_balance.hpp"

namespace levitas::balancing {

inline void Print(const char* what, const std::vector<Outcome>& all) {
  const auto line = [&all](const char* name, double Outcome::*figure) {
    const Spread spread = SpreadOf(all, figure);
    fmt::print("  {:<44}{:9.3f}{:9.3f}\n", name, spread.median, spread.worst);
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    fmt::print(
        "  rig {}: largest orbit {:.1f} um, left {:.2f} %, weight {:.2f} % {:.2f} deg, {:.1f} "
        "deviations\n",
        i + 1, 1e6 * all[i].before_peak_m, all[i].rms_percent, all[i].weight_percent,
        all[i].weight_deg, all[i].deviations);
  }
  fmt::print("{}, {} rigs: median, worst\n", what, all.size());
  line("response left, rms [%]", &Outcome::rms_percent);
  line("response left, largest orbit [%]", &Outcome::peak_percent);
  line("error of a weight [%]", &Outcome::weight_percent);
  line("error of a weight [deg]", &Outcome::weight_deg);
  line("the same in standard deviations", &Outcome::deviations);
  line("static unbalance before [g mm/kg]", &Outcome::before_g_mm_per_kg);
  line("static unbalance left [g mm/kg]", &Outcome::left_g_mm_per_kg);
  line("after a second run: rms [%]", &Outcome::second_rms_percent);
  line("after a second run: largest orbit [%]", &Outcome::second_peak_percent);
  line("after a second run: static [g mm/kg]", &Outcome::second_g_mm_per_kg);
  line("reduced chi-square", &Outcome::chi_square);
}

/// What one run-up has to reach; what it does reach is in docs/identification.md.
inline void ExpectBalanced(const std::vector<Outcome>& all) {
  for (const Outcome& one : all) {
    EXPECT_LT(one.rms_percent, 3.0);
    EXPECT_LT(one.weight_percent, 5.0);
    EXPECT_LT(one.weight_deg, 5.0);
    // Six numbers per rig, normal: beyond five deviations is one of a million.
    EXPECT_LT(one.deviations, 5.0);
    // Below what one run-up is measured by: a second one sees what the first has left.
    EXPECT_LT(one.second_rms_percent, 1.0);
  }
  EXPECT_LT(SpreadOf(all, &Outcome::rms_percent).median, 1.5);
}

}  // namespace levitas::balancing
