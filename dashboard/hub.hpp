#pragma once
// The newest messages for the viewers: one place, overwritten, never a queue.
//
// A viewer remembers what it has seen and takes what is newer. One that is slow finds a later tick
// when it comes back and has lost those between; nothing waits for it and nothing grows.
//
// Thread    any. Wait blocks until there is something new, the hub is closed, or `limit` is over.
// Failure   none; Wait returns nothing when closed or late.

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace levitas::dashboard {

/// Kinds of which only the newest counts; names are those of the page's events.
enum class Topic : std::uint8_t { kRig, kTick, kSpectrum, kTiming, kScope, kConvergence, kEnd };
inline constexpr std::size_t kTopics = 7;
inline constexpr std::array<const char*, kTopics> kTopicNames{
    "rig", "tick", "spectrum", "timing", "scope", "convergence", "end"};

/// What one viewer has seen.
struct Seen {
  std::array<std::uint64_t, kTopics> topic{};
  std::uint64_t event{};
};

class Hub {
 public:
  static constexpr std::size_t kEvents = 200;

  void Put(Topic topic, std::string json);
  /// What was told of `topic` is old: the next viewer waits for news of it.
  void Forget(Topic topic);
  /// `number` counts up.
  void PutEvent(std::uint64_t number, std::string json);
  void Close();
  [[nodiscard]] bool closed() const;

  /// The next part of an event stream ("event: tick\ndata: ...\n\n" ...), and `seen` brought up to
  /// date. Empty when nothing new came within `limit`, or closed.
  [[nodiscard]] std::string Wait(Seen& seen, std::chrono::milliseconds limit);

 private:
  [[nodiscard]] bool News(const Seen& seen) const;

  struct Latest {
    std::uint64_t version{0};
    std::string json;  ///< empty: nothing to tell
    [[nodiscard]] bool NewTo(std::uint64_t seen) const { return version > seen && !json.empty(); }
  };
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::array<Latest, kTopics> latest_;
  std::deque<std::pair<std::uint64_t, std::string>> events_;
  bool closed_{false};
};

}  // namespace levitas::dashboard
