#include "benchmark/lives/fiber.hpp"

#include <cstdint>
#include <cstdlib>
#include <utility>

namespace levitas::lives {

Fiber::Fiber(std::function<void()> work) : work_(std::move(work)), stack_(kStackBytes) {
  if (getcontext(&inside_) != 0) std::abort();
  inside_.uc_stack.ss_sp = stack_.data();
  inside_.uc_stack.ss_size = kStackBytes;
  inside_.uc_link = &outside_;
  // makecontext passes whole numbers of 32 bits only.
  const auto self = reinterpret_cast<std::uintptr_t>(this);
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): the type that makecontext asks for
  makecontext(&inside_, reinterpret_cast<void (*)()>(&Fiber::Start), 2,
              static_cast<unsigned>(self >> 32U), static_cast<unsigned>(self & 0xFFFFFFFFU));
}

Fiber::~Fiber() {
  if (!ended_) std::abort();
}

void Fiber::Start(unsigned high, unsigned low) noexcept {
  const std::uintptr_t self = static_cast<std::uintptr_t>(high) << 32U | low;
  auto* const fiber = reinterpret_cast<Fiber*>(self);
  fiber->work_();
  fiber->ended_ = true;
}

void Fiber::Resume() noexcept {
  if (!ended_ && swapcontext(&outside_, &inside_) != 0) std::abort();
}

void Fiber::Yield() noexcept {
  if (swapcontext(&inside_, &outside_) != 0) std::abort();
}

}  // namespace levitas::lives
