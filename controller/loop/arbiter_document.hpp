#pragma once
// The chapter "Commands and the end of a run" of docs/safety.md, as it must read for the tables of
// the arbiter (end_table.hpp, signal_table.hpp). A test compares the two.

#include <string>

namespace levitas::loop {

/// From its heading on, up to the next chapter's.
[[nodiscard]] std::string ArbiterDocument();

}  // namespace levitas::loop
