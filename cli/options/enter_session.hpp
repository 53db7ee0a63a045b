#pragma once
// A session just written goes into the catalogue of sessions, where there is one.
//
// Failure  never that of the command: the session itself is safe, so what is wrong with the
//          catalogue is said on standard error and the work goes on.

#include <string>
#include <vector>

namespace levitas::verdict {
struct Verdict;
}

namespace levitas::cli {

/// A run that was judged.
void EnterRun(const std::string& path, const verdict::Verdict& verdict,
              const std::vector<std::string>& tags) noexcept;

/// Any other session; reads it once.
void EnterSession(const std::string& path, const std::vector<std::string>& tags) noexcept;

}  // namespace levitas::cli
