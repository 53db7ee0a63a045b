#pragma once
// A second line of execution within one thread: two loops that both wait for the clock take turns.
//
// Turns    Resume runs the work until it calls Yield or returns; Yield gives the turn back.
// Thread   the one that made it. Stack: kStackBytes of its own.
// Failure  the work must not throw. It must have returned before the fiber is destroyed: what lies
//          on an abandoned stack is never destroyed, so that this ends the program (assert).

#include <ucontext.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace levitas::lives {

class Fiber {
 public:
  static constexpr std::size_t kStackBytes = 512 * 1024;

  explicit Fiber(std::function<void()> work);
  ~Fiber();
  Fiber(const Fiber&) = delete;
  Fiber& operator=(const Fiber&) = delete;

  void Resume() noexcept;
  /// From within the work only.
  void Yield() noexcept;
  [[nodiscard]] bool ended() const noexcept { return ended_; }

 private:
  static void Start(unsigned high, unsigned low) noexcept;

  std::function<void()> work_;
  std::vector<std::byte> stack_;
  ucontext_t inside_{};
  ucontext_t outside_{};
  bool ended_{false};
};

}  // namespace levitas::lives
