#pragma once
// Whether a process does anything at all: a number that grows whenever one of its threads has run.
//
// Source    /proc/PID/task/TID: processor time (stat, in ticks) and the times a thread was switched
//           to (status), summed over the threads. A controller looks after its loop fifty times a
//           second even when nothing else happens, so a number that stands still for seconds is a
//           process that is stopped, or stuck in the kernel.
// Thread    any. Failure: nothing where the process, or /proc, is not there.

#include <sys/types.h>

#include <cstdint>
#include <optional>

namespace levitas::cli {

[[nodiscard]] std::optional<std::uint64_t> PulseOf(pid_t process);

}  // namespace levitas::cli
