#pragma once
// One direction of the line between controller and rig, in virtual time, with all that may happen
// to a message on its way.
//
// Order     messages arrive by their time; a later one may overtake. A reader gets the last one
//           that has arrived, as from a socket. With `keeps_order` one with a smaller number than
//           the last that arrived is dropped, as a sealed network and a CAN bus do it.
// Random    from a seed: the same life loses the same messages.
// Thread    one; allocates while the queue grows.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "common/random.hpp"

namespace levitas::lives {

/// What happens to messages that leave between two instants.
struct LineTrouble {
  std::int64_t from_ns{};
  std::int64_t to_ns{};
  double lost{};                ///< share that never arrives, drawn one by one
  std::uint32_t burst{};        ///< of each `burst_of` messages the first so many are lost
  std::uint32_t burst_of{};     ///< 0: no bursts
  std::int64_t delay_ns{};      ///< every message takes so much longer
  std::int64_t jitter_ns{};     ///< and between nothing and so much more
  double twice{};               ///< share that arrives a second time, 40 us later
  double old{};                 ///< share behind which an older message arrives again
  std::uint32_t old_periods{};  ///< how much older
};

template <class Message>
class Mailbox {
 public:
  static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
  static constexpr std::size_t kMemory = 64;

  Mailbox(std::int64_t way_ns, bool keeps_order, std::uint64_t seed)
      : way_ns_(way_ns), keeps_order_(keeps_order), draw_(seed), sent_(kMemory) {}

  void Disturb(const LineTrouble& trouble) { troubles_.push_back(trouble); }

  /// `number`: the message's own, that the order is judged by.
  void Send(const Message& message, std::uint64_t number, std::int64_t now_ns) {
    std::int64_t arrival_ns = now_ns + way_ns_;
    bool lost = false;
    bool twice = false;
    std::uint32_t older = 0;
    for (const LineTrouble& t : troubles_) {
      if (now_ns < t.from_ns || now_ns >= t.to_ns) continue;
      lost = lost || draw_.Uniform() < t.lost || (t.burst_of > 0 && count_ % t.burst_of < t.burst);
      arrival_ns += t.delay_ns;
      if (t.jitter_ns > 0) {
        arrival_ns += static_cast<std::int64_t>(draw_.Uniform() * static_cast<double>(t.jitter_ns));
      }
      twice = twice || draw_.Uniform() < t.twice;
      if (draw_.Uniform() < t.old) older = t.old_periods;
    }
    const Letter letter{arrival_ns, number, message};
    sent_[count_ % kMemory] = letter;
    ++count_;
    if (!lost) Put(letter);
    if (twice) Put({arrival_ns + 40'000, number, message});
    if (older > 0 && older < std::min<std::uint64_t>(count_, kMemory)) {
      const Letter& old = sent_[(count_ - 1 - older) % kMemory];
      Put({arrival_ns + 5'000, old.number, old.message});
    }
  }

  /// When the next one arrives; kNever when none is under way.
  [[nodiscard]] std::int64_t NextArrival() const noexcept {
    return under_way_.empty() ? kNever : under_way_.back().arrival_ns;
  }

  /// The next that has arrived.
  bool TakeNext(std::int64_t now_ns, Message& message) {
    while (!under_way_.empty() && under_way_.back().arrival_ns <= now_ns) {
      const Letter letter = under_way_.back();
      under_way_.pop_back();
      if (keeps_order_ && any_ && letter.number < last_number_) continue;
      any_ = true;
      last_number_ = letter.number;
      message = letter.message;
      return true;
    }
    return false;
  }
  /// The last that has arrived.
  bool TakeLast(std::int64_t now_ns, Message& message) {
    bool found = false;
    while (TakeNext(now_ns, message)) found = true;
    return found;
  }
  /// The sender has begun anew, with numbers from the start; what is under way is lost.
  void Forget() {
    under_way_.clear();
    any_ = false;
  }

 private:
  struct Letter {
    std::int64_t arrival_ns{};
    std::uint64_t number{};
    Message message;
  };

  // Sorted by arrival, the next one last; equal arrivals in the order of sending.
  void Put(const Letter& letter) {
    const auto at = std::lower_bound(
        under_way_.begin(), under_way_.end(), letter.arrival_ns,
        [](const Letter& there, std::int64_t when_ns) { return there.arrival_ns > when_ns; });
    under_way_.insert(at, letter);
  }

  std::int64_t way_ns_;
  bool keeps_order_;
  Random draw_;
  std::vector<LineTrouble> troubles_;
  std::vector<Letter> sent_;
  std::vector<Letter> under_way_;
  std::uint64_t count_{0};
  std::uint64_t last_number_{0};
  bool any_{false};
};

}  // namespace levitas::lives
