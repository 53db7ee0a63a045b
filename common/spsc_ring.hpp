#pragma once
// Wait-free ring between exactly one writer thread and one reader thread.
//
// Full means lost, lost means counted: the writer never waits. Storage is made once, at
// construction. T must be trivially copyable.

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace levitas {

template <class T>
class SpscRing {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  /// Room for at least `capacity` records (rounded up to a power of two). Allocates; may throw.
  explicit SpscRing(std::size_t capacity)
      : slots_(std::bit_ceil(capacity)), mask_(slots_.size() - 1) {}

  /// Writer thread only. Returns false, and counts, when the reader is a full ring behind.
  bool Post(const T& record) noexcept {
    const std::uint64_t head = head_.load(std::memory_order_relaxed);
    if (Full()) {
      lost_.fetch_add(1, std::memory_order_relaxed);
      return false;
    }
    slots_[head & mask_] = record;
    head_.store(head + 1, std::memory_order_release);
    return true;
  }

  /// Writer thread only: the next Post would be lost.
  [[nodiscard]] bool Full() const noexcept {
    return head_.load(std::memory_order_relaxed) - tail_.load(std::memory_order_acquire) ==
           slots_.size();
  }

  /// Reader thread only. Returns false when the ring is empty.
  bool Take(T& record) noexcept {
    const std::uint64_t tail = tail_.load(std::memory_order_relaxed);
    if (tail == head_.load(std::memory_order_acquire)) return false;
    record = slots_[tail & mask_];
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }

  /// Any thread.
  [[nodiscard]] std::uint64_t lost() const noexcept {
    return lost_.load(std::memory_order_relaxed);
  }
  [[nodiscard]] std::size_t capacity() const noexcept { return slots_.size(); }

 private:
  std::vector<T> slots_;
  std::uint64_t mask_;
  alignas(64) std::atomic<std::uint64_t> head_{0};
  alignas(64) std::atomic<std::uint64_t> tail_{0};
  std::atomic<std::uint64_t> lost_{0};
};

}  // namespace levitas
