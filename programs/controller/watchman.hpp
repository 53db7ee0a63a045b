#pragma once
// Looks after the running loop from the main thread: signals, the rig, the guard of the enable line
// and our own threads. What calls for an end lands the rotor.
//
// Landing  asked for by a signal, by a thread that failed (also by the main thread itself), when
//          the guard has ended, and when the program that started this one has (its pipe ends). The
//          loop is ended without one when the same signal comes again, and when no rig is there.
//          How long a landing may take is the arbiter's business, in the rig's time: a wall clock
//          knows nothing of a rig that runs down slowly, or of a machine that simulates slowly.
// Quit     an emergency stop, and the end after it.
// News     what the arbiter finds at the end (command_arbiter.hpp) is said once.
// Thread   main. Failure: none.

#include <atomic>
#include <cstdint>
#include <functional>

#include "controller/loop/command_arbiter.hpp"
#include "controller/loop/control_loop.hpp"
#include "hil/libgpiod/gpiod_lines.hpp"
#include "programs/controller/controller_options.hpp"
#include "programs/controller/rig_connection.hpp"
#include "transport/partner_watch.hpp"

namespace levitas::controller_program {

class Watchman {
 public:
  /// Keeps references to all of them; `lines` may be null. `tell_news`: what port and
  /// network have to say.
  Watchman(loop::ControlLoop& loop, loop::CommandArbiter& arbiter, const ControllerOptions& options,
           const RigConnection& rig, const gpio::GpiodLines* lines,
           std::function<void()> tell_news);

  /// Until `running` is false. False: the rig stayed away.
  bool Watch(const std::atomic<bool>& running) noexcept;

 private:
  void Look();
  void LookAtGuard();
  void LookAtPartner();
  void LookAtParent();
  void TellEnd();
  void Land(const char* why);

  loop::ControlLoop& loop_;
  loop::CommandArbiter& arbiter_;
  const ControllerOptions& options_;
  const RigConnection& rig_;
  const gpio::GpiodLines* lines_;
  std::function<void()> tell_news_;
  transport::PartnerWatch partner_;
  bool landing_{false};
  bool orphaned_{false};
  bool overdue_said_{false};
  bool brake_said_{false};
  bool guarded_{true};
  bool stayed_{true};
};

}  // namespace levitas::controller_program
