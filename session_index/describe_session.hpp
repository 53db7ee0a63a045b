#pragma once
// Reads a session file and says what it holds: what was run, how long, with which outcome.
//
// Cost      one pass over the file; about a second for two minutes of four axes.
// Thread    any; offline.
// Failure   BadInput when the file cannot be read or is no session.
// Not done  tags: they are the user's, and live in the catalogue alone.

#include <string>

#include "session_index/entry.hpp"

namespace levitas::verdict {
struct Verdict;
}

namespace levitas::session_index {

[[nodiscard]] Entry DescribeSession(const std::string& path);

/// The same for a run that was judged a moment ago, without reading its file once more.
[[nodiscard]] Entry DescribeRun(const std::string& path, const verdict::Verdict& verdict);

}  // namespace levitas::session_index
