#include "benchmark/lives/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <thread>

namespace levitas::lives {
namespace {

std::string Kinds(const LifeResult& life) {
  std::string text;
  for (const Kind kind : life.kinds) {
    if (!text.empty()) text.push_back('+');
    text += Name(kind);
  }
  return text;
}

Kind RowOf(const LifeResult& life) { return life.kinds.size() > 1 ? Kind::kTwo : life.kinds[0]; }

struct KindCount {
  std::uint64_t lives{}, failed{}, releases{}, contacts{};
  std::array<std::uint64_t, kHarmCount> harms{};
};

std::string Line(std::string_view name, const KindCount& count) {
  std::string line = fmt::format("{:<20} {:>6} {:>8} {:>9} {:>9}", name, count.lives, count.failed,
                                 count.releases, count.contacts);
  for (const std::uint64_t harm : count.harms) line += fmt::format(" {:>9}", harm);
  return line + '\n';
}

}  // namespace

std::vector<LifeResult> RunLives(const LifeRig& rig, const CampaignOptions& options,
                                 const std::function<void(const LifeResult&)>& on_life) {
  std::vector<LifeResult> lives(options.seeds);
  std::atomic<std::uint64_t> next{0};
  std::mutex told;
  const auto work = [&] {
    for (std::uint64_t i = next++; i < options.seeds; i = next++) {
      lives[i] = RunLife(rig, DrawLife(options.first + i, options.seconds, rig.config.rig));
      if (!on_life) continue;
      const std::lock_guard lock(told);
      on_life(lives[i]);
    }
  };
  std::vector<std::thread> threads;
  for (unsigned n = 1; n < options.jobs; ++n) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  return lives;
}

std::string Row(const LifeResult& life) {
  std::string text;
  for (const HarmFound& found : life.harms) {
    text += fmt::format("seed {} ({}): {} at {:.4f} s, {:.0f} rpm: {}\n", life.seed, Kinds(life),
                        Name(found.harm), found.at_s, found.speed_rpm, found.how);
  }
  return text.empty() ? text : text + "    " + life.story + '\n';
}

std::string Story(const LifeResult& life) {
  if (!life.harms.empty()) return Row(life);
  return fmt::format("seed {} ({}): no harm, first fault {}, up to {:.0f} rpm\n    {}\n", life.seed,
                     Kinds(life), Name(life.fault), life.highest_rpm, life.story);
}

std::string Table(const std::vector<LifeResult>& lives) {
  std::array<KindCount, kKindCount> kinds{};
  KindCount all;
  for (const LifeResult& life : lives) {
    for (KindCount* count : {&kinds[static_cast<std::size_t>(RowOf(life))], &all}) {
      ++count->lives;
      if (!life.harms.empty()) ++count->failed;
      count->releases += life.releases;
      if (life.documented_contacts > 0) ++count->contacts;
      for (const HarmFound& found : life.harms) {
        ++count->harms[static_cast<std::size_t>(found.harm)];
      }
    }
  }
  std::string text = fmt::format("{:<20} {:>6} {:>8} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n",
                                 "disturbance", "lives", "failed", "released", "contacts",
                                 "touched", "let go", "landed", "left", "unbraked");
  for (std::size_t k = 0; k < kKindCount; ++k) {
    if (kinds[k].lives > 0) text += Line(Name(static_cast<Kind>(k)), kinds[k]);
  }
  return text + Line("all", all);
}

std::uint64_t Failed(const std::vector<LifeResult>& lives) {
  return static_cast<std::uint64_t>(std::count_if(
      lives.begin(), lives.end(), [](const LifeResult& life) { return !life.harms.empty(); }));
}

}  // namespace levitas::lives
