#include "rt/thread_trouble.hpp"

#include <fmt/core.h>

#include <atomic>

#include "rt/say.hpp"

namespace levitas::rt {
namespace {
constexpr int kMostSaid = 20;
std::atomic<int> troubles{0};
}  // namespace

void NoteTrouble(const char* thread, const char* what) noexcept {
  if (troubles.fetch_add(1, std::memory_order_relaxed) >= kMostSaid) return;
  try {
    Say(fmt::format("thread {}: unexpected: {}", thread, Quoted(what)));
  } catch (const std::exception&) {  // no memory for the text
    Say("a thread ran out of memory");
  }
}

int Troubles() noexcept { return troubles.load(std::memory_order_relaxed); }

}  // namespace levitas::rt
