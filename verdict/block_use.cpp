#include "verdict/block_use.hpp"

#include <algorithm>
#include <map>

#include "session/log/block_events.hpp"

namespace levitas::verdict {

std::vector<BlockUse> BlocksOf(std::span<const session::Event> events, std::uint64_t first_cycle,
                               std::uint64_t last_cycle, double period_s,
                               std::span<const std::string> names) {
  std::vector<BlockUse> blocks;
  std::map<std::string, std::uint64_t> acts_since;
  const auto seconds = [period_s](std::uint64_t from, std::uint64_t to) {
    return to > from ? period_s * static_cast<double>(to - from) : 0.0;
  };
  const auto of = [&blocks](const std::string& name) -> BlockUse& {
    const auto known = std::ranges::find(blocks, name, &BlockUse::name);
    if (known != blocks.end()) return *known;
    BlockUse& block = blocks.emplace_back();
    block.name = name;
    return block;
  };
  for (const session::Event& event : events) {
    const auto told = session::ReadBlockEvent(event.text);
    if (!told) continue;
    BlockUse& block = of(told->name);
    if (told->begins) {
      ++block.times;
      block.last_end.clear();
      block.angle = told->why;
      acts_since[block.name] = event.cycle;
      continue;
    }
    const auto since = acts_since.find(block.name);
    if (since == acts_since.end()) continue;
    block.acted_s += seconds(since->second, event.cycle);
    block.last_end = told->why;
    if (event.severity != session::Event::Severity::kInformation) {
      ++block.failures;
      block.last_failure = told->why;
    }
    block.last_end_s = seconds(first_cycle, event.cycle);
    acts_since.erase(since);
  }
  for (const auto& [name, since] : acts_since) of(name).acted_s += seconds(since, last_cycle);
  for (const std::string& name : names) (void)of(name);
  return blocks;
}

}  // namespace levitas::verdict
