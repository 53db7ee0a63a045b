#pragma once
// What a fuzz target has besides LLVMFuzzerTestOneInput: seeds of its own, made by the program
// itself, and a place for an input that is read as a file.
//
// A target's file defines Seeds() and LLVMFuzzerTestOneInput. Whatever the input, the target may
// throw what the program reports (BadInput, Problem); anything else, a crash, a finding of a
// sanitizer, 10 s for one input or 2 GiB are a failure. tests/fuzz/run.py runs them.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace levitas::fuzz {

/// Small inputs that reach deep; each target defines it.
std::vector<std::string> Seeds();

/// A folder in memory for this process, removed at its end.
const std::string& ScratchFolder();

/// The path in ScratchFolder() of a file `name` that holds the input.
std::string AsFile(const std::string& name, std::span<const std::uint8_t> input);
/// What a file holds; empty when there is none.
std::string Content(const std::string& path);

inline std::string AsText(std::span<const std::uint8_t> input) {
  return {input.begin(), input.end()};
}

}  // namespace levitas::fuzz
