#pragma once
// Looks after the running loop from the main thread: signals, the rig, the guard of the enable line
// and our own threads. What calls for an end lands the rotor.
//
// Landing  asked for by a signal, by a thread that failed (also by the main thread itself) and when
//          the guard has ended. The loop is ended without one when the same signal comes again,
//          when no rig is there, and kLandingLimitNs after the first request.
// Quit     an emergency stop, and the end after it.
// Thread   main. Failure: none.

#include <atomic>
#include <cstdint>
#include <functional>

#include "controller/loop/command_arbiter.hpp"
#include "controller/loop/control_loop.hpp"
#include "controller/program/controller_options.hpp"
#include "controller/program/rig_connection.hpp"
#include "hil/libgpiod/gpiod_lines.hpp"
#include "transport/partner_watch.hpp"

namespace levitas::controller_program {

class Watchman {
 public:
  /// The desk's own limit for a landing and the emergency stop behind it, on a machine that in
  /// lockstep may be slower than the clock. A controller that nobody looks after any more does not
  /// stay for ever.
  static constexpr std::int64_t kLandingLimitNs = 600'000'000'000;

  /// Keeps references to all of them; `lines` may be null. `tell_news`: what port and
  /// network have to say.
  Watchman(loop::ControlLoop& loop, loop::CommandArbiter& desk, const ControllerOptions& options,
           const RigConnection& rig, const gpio::GpiodLines* lines,
           std::function<void()> tell_news);

  /// Until `running` is false. False: the rig stayed away.
  bool Watch(const std::atomic<bool>& running) noexcept;

 private:
  void Look();
  void LookAtGuard();
  void LookAtPartner();
  void Land(const char* why);

  loop::ControlLoop& loop_;
  loop::CommandArbiter& desk_;
  const ControllerOptions& options_;
  const RigConnection& rig_;
  const gpio::GpiodLines* lines_;
  std::function<void()> tell_news_;
  transport::PartnerWatch partner_;
  std::int64_t landing_since_ns_{0};  ///< 0: not asked for
  bool guarded_{true};
  bool stayed_{true};
};

}  // namespace levitas::controller_program
