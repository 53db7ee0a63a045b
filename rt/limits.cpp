#include "rt/limits.hpp"

#include <fmt/core.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "common/problem.hpp"

namespace levitas::rt {

CpuTimePlan PlanCpuTime(const rlimit& limit) {
  CpuTimePlan plan{.soft_s = limit.rlim_cur, .enough = true, .said = {}};
  if (limit.rlim_max != RLIM_INFINITY) {
    const rlim_t reserve_s = std::min((limit.rlim_max + 1) / 2, kLandingReserveS);
    plan.soft_s = std::min(plan.soft_s, limit.rlim_max - reserve_s);
    plan.enough = plan.soft_s > 0;  // the kernel takes 0 for 1
  }
  if (plan.soft_s == RLIM_INFINITY) return plan;
  plan.said = plan.enough ? fmt::format(
                                "processor time is limited (ulimit -t): the rotor is landed after "
                                "{} s of it",
                                plan.soft_s)
                          : fmt::format(
                                "processor time is limited to {} s (ulimit -t), which leaves none "
                                "for a landing. Raise the limit",
                                limit.rlim_max);
  return plan;
}

std::string ReserveCpuTime() {
  rlimit limit{RLIM_INFINITY, RLIM_INFINITY};
  if (::getrlimit(RLIMIT_CPU, &limit) != 0) return {};
  const CpuTimePlan plan = PlanCpuTime(limit);
  if (!plan.enough) throw Problem(ExitStatus::kOther, plan.said);
  limit.rlim_cur = plan.soft_s;
  static_cast<void>(::setrlimit(RLIMIT_CPU, &limit));  // to lower it is always allowed
  return plan.said;
}

StackPlan PlanStack(const rlimit& limit) {
  if (limit.rlim_cur >= kLeastStack) return {.soft = limit.rlim_cur, .enough = true};
  return {.soft = std::min(limit.rlim_max, kLeastStack), .enough = limit.rlim_max >= kLeastStack};
}

// Little of the stack is used here: of an exception, too, it may be too small.
bool EnsureStack(const char* program) noexcept {
  rlimit limit{};
  if (::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= kLeastStack) return true;
  const StackPlan plan = PlanStack(limit);
  if (!plan.enough) {
    std::array<char, 256> text{};
    const int length = std::snprintf(
        text.data(), text.size(),
        "%s: the stack is limited to %llu KiB (ulimit -s), %llu KiB are needed. Raise the limit\n",
        program, static_cast<unsigned long long>(limit.rlim_max >> 10U),
        static_cast<unsigned long long>(kLeastStack >> 10U));
    [[maybe_unused]] const ssize_t written =
        ::write(STDERR_FILENO, text.data(), static_cast<std::size_t>(length));
    return false;
  }
  limit.rlim_cur = plan.soft;
  static_cast<void>(::setrlimit(RLIMIT_STACK, &limit));
  // The C library has taken the size of threads from the limit before main.
  pthread_attr_t attributes;
  if (::pthread_attr_init(&attributes) != 0) return true;
  if (::pthread_attr_setstacksize(&attributes, plan.soft) == 0) {
    static_cast<void>(::pthread_setattr_default_np(&attributes));
  }
  ::pthread_attr_destroy(&attributes);
  return true;
}

}  // namespace levitas::rt
