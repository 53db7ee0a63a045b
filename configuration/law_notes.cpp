#include "configuration/law_notes.hpp"

#include <fmt/core.h>

#include <cmath>

#include "common/rotational_speed.hpp"
#include "controller/law/hidden_states.hpp"

namespace levitas::configuration {
namespace {

bool IsIntegrator(const law::ModalBlock& block, bool discrete) {
  const double real = discrete ? block.pole_real - 1.0 : block.pole_real;
  return block.pole_imaginary == 0.0 && std::abs(real) <= law::kOnCircle;
}

std::string PoleText(const law::ModalBlock& block, bool discrete) {
  const std::string pair =
      block.pole_imaginary == 0.0 ? "" : fmt::format(" +- {:.6g}j", std::abs(block.pole_imaginary));
  return fmt::format("{} = {:.6g}{}{}", discrete ? "z" : "s", block.pole_real, pair,
                     discrete ? "" : " 1/s");
}

}  // namespace

std::vector<std::string> LawNotes(const law::LawConfig& law) {
  std::vector<std::string> notes;
  if (!law.schedule.empty()) {
    notes.push_back(fmt::format("a schedule: {} laws from rest to {:.0f} rpm",
                                law.schedule.size() + 1,
                                RadPerSToRpm(law.schedule.back().speed_rad_per_s)));
    for (const law::LawAtSpeed& at : law.schedule) {
      if (!at.exchange) continue;
      notes.push_back(
          fmt::format("another law takes over at {:.0f} rpm", RadPerSToRpm(at.speed_rad_per_s)));
    }
  }
  if (!law.state_space) return notes;
  const law::StateSpaceConfig& blocks = *law.state_space;
  int integrators = 0;
  for (const law::GrowingBlock& growing : law::GrowingBlocks(blocks)) {
    const law::ModalBlock& block = blocks.blocks[growing.block];
    if (IsIntegrator(block, blocks.discrete)) {
      ++integrators;
      continue;
    }
    notes.push_back(
        fmt::format("block {} of the law is unstable by itself (pole {}): only the loop holds it",
                    growing.block + 1, PoleText(block, blocks.discrete)));
  }
  if (integrators > 0) {
    notes.push_back(fmt::format("{} block{} of the law integrate{}", integrators,
                                integrators == 1 ? "" : "s", integrators == 1 ? "s" : ""));
  }
  return notes;
}

}  // namespace levitas::configuration
