#pragma once
// What a thread does not expect ends neither the thread's program nor the control: it is said, and
// counted, and who looks after the loop lands the rotor.
//
// Thread   any but the loop's.
// Failure  none.

#include <exception>

namespace levitas::rt {

/// Says that `thread` met `what`, at most kMostSaid times in all, and counts it.
void NoteTrouble(const char* thread, const char* what) noexcept;
/// Noted so far.
[[nodiscard]] int Troubles() noexcept;

/// Runs `body`; true when it came to its end. What it throws is noted.
template <class Body>
bool Guarded(const char* thread, const Body& body) noexcept {
  try {
    body();
    return true;
  } catch (const std::exception& error) {
    NoteTrouble(thread, error.what());
  } catch (...) {
    NoteTrouble(thread, "something unknown");
  }
  return false;
}

}  // namespace levitas::rt
