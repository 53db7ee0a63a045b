#pragma once
// Who may look and who may command.
//
// Loopback   the default. Other pages in the same browser must not command the rig: a command
//            needs a header that a foreign page cannot send without being asked for permission
//            (which is never given), and the Host header must name this machine (against names
//            that are made to point here).
// Elsewhere  every request needs the token that was printed at the start.
// Thread     any. Failure: none; what is malformed is refused.

#include <string>
#include <string_view>

namespace levitas::dashboard {

/// 127.0.0.0/8, ::1 or localhost.
[[nodiscard]] bool IsLoopback(std::string_view address);

/// Whether a Host header ("127.0.0.1:8970") names this machine's loopback.
[[nodiscard]] bool HostIsLoopback(std::string_view host_header);

/// Takes the same time wherever the two differ.
[[nodiscard]] bool TokenMatches(std::string_view given, std::string_view wanted);

/// 32 hexadecimal digits of the system's random numbers.
[[nodiscard]] std::string NewToken();

}  // namespace levitas::dashboard
