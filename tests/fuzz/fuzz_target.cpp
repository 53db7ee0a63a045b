#include "tests/fuzz/fuzz_target.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>

#include "tests/fuzz/verify.hpp"

namespace levitas::fuzz {
namespace {

namespace fs = std::filesystem;

class Scratch {
 public:
  Scratch() : path_(fmt::format("/dev/shm/levitas-fuzz-{}", ::getpid())) {
    fs::create_directory(path_);
  }
  ~Scratch() {
    if (::getpid() != owner_) return;  // a process that the target started, and that broke
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
  pid_t owner_{::getpid()};
};

void WriteSeeds(const fs::path& folder) {
  int number = 0;
  for (const std::string& seed : Seeds()) {
    std::ofstream(folder / fmt::format("seed-{}", number++), std::ios::binary) << seed;
  }
}

}  // namespace

const std::string& ScratchFolder() {
  static const Scratch kScratch;
  return kScratch.path();
}

std::string AsFile(const std::string& name, std::span<const std::uint8_t> input) {
  std::string path = ScratchFolder() + "/" + name;
  std::ofstream file(path, std::ios::binary);
  file << AsText(input);
  Verify(file.flush().good(), "the input is in its file");
  return path;
}

std::string Content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace levitas::fuzz

/// `TARGET --seeds=FOLDER` writes the seeds and ends.
// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerInitialize(const int* count, char*** arguments) {
  constexpr std::string_view kOption = "--seeds=";
  for (int i = 1; i < *count; ++i) {
    const std::string_view word = (*arguments)[i];
    if (!word.starts_with(kOption)) continue;
    levitas::fuzz::WriteSeeds(word.substr(kOption.size()));
    std::exit(0);
  }
  return 0;
}
