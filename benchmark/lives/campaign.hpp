#pragma once
// Many lives, over the processor's cores, and what they come to as text.
//
// Order    rows by seed, however many jobs: the text of a campaign does not depend on them.
// Thread   RunLives starts `jobs` of its own. `on_life` is called under a lock, as lives end.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "benchmark/lives/life.hpp"

namespace levitas::lives {

struct CampaignOptions {
  std::uint64_t first{1};
  std::uint64_t seeds{2000};
  double seconds{10.0};
  unsigned jobs{1};
};

[[nodiscard]] std::vector<LifeResult> RunLives(
    const LifeRig& rig, const CampaignOptions& options,
    const std::function<void(const LifeResult&)>& on_life = nullptr);

/// One line for each harm of a life: seed, kinds, harm, when, how fast, how; and the story below.
[[nodiscard]] std::string Row(const LifeResult& life);
/// The row, and for a life without harm what it was: for one life alone.
[[nodiscard]] std::string Story(const LifeResult& life);
/// By kind: lives, failed ones, documented releases, lives with documented contacts, each harm.
[[nodiscard]] std::string Table(const std::vector<LifeResult>& lives);
[[nodiscard]] std::uint64_t Failed(const std::vector<LifeResult>& lives);

}  // namespace levitas::lives
