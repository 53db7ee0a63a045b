#pragma once
// Limits on a process (ulimit) that would end it in the middle of its work without a word.
//
// Processor time  The kernel sends SIGXCPU at the soft limit, which lands the rotor
//                 (stop_signal.hpp), and SIGKILL at the hard one; where the two are equal,
//                 as `ulimit -t` makes them, SIGKILL alone (setrlimit(2)). So the soft limit is
//                 lowered: what lies between is for the landing.
// Stack           of main and of threads that ask for no size of their own, as large as the soft
//                 limit. Below kLeastStack it is raised; where the hard limit forbids that, a
//                 sentence takes the place of a segmentation fault.
// Thread          main, before any other is started. Failure: see each function.
// Not done        a stack of less than about 48 KiB: the loader ends before main.

#include <sys/resource.h>

#include <string>

namespace levitas::rt {

/// At most so much processor time is kept for a landing [s]; of a short limit, half.
inline constexpr rlim_t kLandingReserveS = 300;

struct CpuTimePlan {
  rlim_t soft_s{};   ///< to be set
  bool enough{};     ///< SIGXCPU comes before SIGKILL
  std::string said;  ///< empty where nothing is limited
};

/// From the limits as getrlimit gives them [s].
[[nodiscard]] CpuTimePlan PlanCpuTime(const rlimit& limit);

/// Lowers the limit where that is needed. Returns what there is to say; throws Problem where no
/// time is left for a landing.
[[nodiscard]] std::string ReserveCpuTime();

/// Several times what `amb modes` needs (it runs in 200 KiB, and not in 128) and what a thread of
/// real time prefaults (256 KiB, real_time.hpp) [bytes]; diagnosis and design run in it as well.
inline constexpr rlim_t kLeastStack = rlim_t{1} << 20;

struct StackPlan {
  rlim_t soft{};  ///< to be set [bytes]
  bool enough{};
};

[[nodiscard]] StackPlan PlanStack(const rlimit& limit);

/// First thing in main. False when the stack is too small and may not grow: said on standard error.
[[nodiscard]] bool EnsureStack(const char* program) noexcept;

}  // namespace levitas::rt
