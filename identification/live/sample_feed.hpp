#pragma once
// Batches of a levitated rotor's samples, row by row into the recursion.
//
// Levitated  batches do not say in which mode the rotor was; states do, a hundred times a second. A
//            row is passed on when the states before and after it both say levitating, spinning
//            or coast-down; until the later one is here, it waits. Rows left out are a pause, rows
//            that never came a gap (online_recursion.hpp).
// Waiting    of at most kMostWaiting batches; the oldest are dropped then, as missing.
// Frame      bearing frame (session/log/record_frame.hpp). Inputs are the commanded control
//            currents, test signal included, outputs the positions read in the same cycle.
// Units      SI. Thread one. Failure: a batch of other axes than the rig's is refused.
// Not done   a cycle whose frame did not arrive repeats the reading before it: no batch says so.

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <levitas_msg/sample_batch_t.hpp>
#include <optional>

#include "common/enums.hpp"
#include "common/rig_numbers.hpp"
#include "identification/nonlinear/online_recursion.hpp"
#include "session/log/record_frame.hpp"

namespace levitas::identification {

class SampleFeed {
 public:
  static constexpr std::size_t kMostWaiting = 256;

  SampleFeed(const RigNumbers& rig, OnlineRecursion& recursion);

  /// False when the batch does not fit the rig.
  bool Take(levitas_msg::sample_batch_t batch);
  /// The rotor was in `mode` at `cycle`.
  void Take(std::uint64_t cycle, Mode mode);

  /// Whether the newest state is one of a levitated rotor.
  [[nodiscard]] bool levitated() const noexcept { return levitated_from_.has_value(); }

 private:
  /// Passes on, leaves out or keeps what waits, in its order.
  void Release();
  void Pass(const levitas_msg::sample_batch_t& batch, std::int32_t sample);

  session::RecordFrame frame_;
  std::size_t axes_;
  OnlineRecursion& recursion_;
  std::deque<levitas_msg::sample_batch_t> waiting_;
  std::int32_t next_sample_{};                   ///< of the first batch that waits
  std::optional<std::uint64_t> levitated_from_;  ///< first state of those without another between
  std::uint64_t known_to_{};                     ///< cycle of the newest state
  bool any_state_{};
  Eigen::VectorXd u_, y_;
};

}  // namespace levitas::identification
