#pragma once
// Who may look and who may command.
//
// Loopback   the default. Other pages in the same browser must not command the rig: a command
//            needs a header that a foreign page cannot send without being asked for permission
//            (which is never given), and the Host header must name this machine (against names
//            that are made to point here).
// Foreign    what a browser says comes from another page is refused on every path.
// Elsewhere  every request needs the token that was printed at the start.
// Token      at least kLeastTokenLength letters, digits and - . _ ~ (it is part of an address).
// Thread     any. Failure: what is malformed is refused; Problem (exit status 2) for a token that
//            is no token, BadInput for a file that cannot be read or that others may read.

#include <cstddef>
#include <string>
#include <string_view>

namespace levitas::dashboard {

/// 127.0.0.0/8, ::1 or localhost.
[[nodiscard]] bool IsLoopback(std::string_view address);

/// Whether a Host header ("127.0.0.1:8970") names this machine's loopback.
[[nodiscard]] bool HostIsLoopback(std::string_view host_header);

/// Whether a browser says that another page sent it: an Origin that is not http(s)://`host`, or a
/// Sec-Fetch-Site of another site. Programs send neither.
[[nodiscard]] bool FromAnotherPage(std::string_view host, std::string_view origin,
                                   std::string_view fetch_site);

/// Takes the same time wherever the two differ.
[[nodiscard]] bool TokenMatches(std::string_view given, std::string_view wanted);

/// 32 hexadecimal digits of the system's random numbers.
[[nodiscard]] std::string NewToken();

inline constexpr std::size_t kLeastTokenLength = 16;

/// `source` is named in the problem: "--token".
void CheckToken(std::string_view token, const std::string& source);

/// The first line of a file that only its owner (this user or root) may read or write.
[[nodiscard]] std::string ReadToken(const std::string& path);

}  // namespace levitas::dashboard
