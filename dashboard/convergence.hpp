#pragma once
// How far an online identification beside the loop has come, as its messages tell, and the picture
// of it for the page.
//
// History   the newest kMost points of the run that is shown, ten minutes of them; a recursion that
//           began anew, or another listener, begins another history.
// Thread    one at a time: the owner's. Failure: a message that cannot be decoded is refused; one
//           of another run than the announced one, or before its header, is left out.

#include <cstdint>
#include <deque>
#include <levitas_msg/convergence_t.hpp>
#include <span>
#include <string>

namespace levitas::dashboard {

class ConvergenceHistory {
 public:
  static constexpr std::size_t kMost = 600;

  /// The messages that follow are of this run.
  void RunIs(std::int64_t start_utc_ns, double period_s);
  /// False when the message cannot be decoded; `told` says whether there is news for the page.
  bool Take(std::span<const std::uint8_t> payload, bool& told);
  /// Points, and how the newest stands; numbers that are none are null.
  [[nodiscard]] std::string Json() const;

 private:
  std::int64_t start_utc_ns_{};
  double period_s_{};
  std::deque<levitas_msg::convergence_t> points_;
};

}  // namespace levitas::dashboard
