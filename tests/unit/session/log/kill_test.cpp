// kill -9 of a recording process at a moment drawn from a written seed: what was posted more than
// 100 ms before is in the file, bit for bit.

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <new>
#include <thread>

#include "session/log/recorder.hpp"
#include "tests/support/waiting.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using namespace testing;
using Clock = std::chrono::steady_clock;
constexpr auto kPeriod = std::chrono::microseconds(100);

struct Shared {
  std::atomic<std::uint64_t> posted{0};
};

/// The child: posts records at 10 kHz until it is killed.
[[noreturn]] void Record(const std::string& path, std::uint64_t seed, Shared& shared) {
  RecorderOptions options;
  options.session_path = path;
  options.header = Header();
  Recorder recorder(std::move(options));
  Random draw{seed};
  const auto start = Clock::now();
  for (std::uint64_t cycle = 0;; ++cycle) {
    recorder.Post(DrawRecord(draw, cycle));
    shared.posted.store(cycle + 1);
    std::this_thread::sleep_until(start + cycle * kPeriod);
  }
}

/// Cycles posted, but not found in the file after a kill.
std::uint64_t LostByKill(Random& draw, std::uint64_t seed, Shared& shared, const char* name) {
  const Folder folder;
  const std::string path = folder / name;
  shared.posted.store(0);
  const pid_t child = ::fork();
  if (child == 0) Record(path, seed, shared);
  // The moment is counted in cycles: 0.1 to 0.4 s of the child's own time.
  const auto moment = static_cast<std::uint64_t>(1000 + 3000 * draw.Uniform());
  EXPECT_TRUE(levitas::test::Eventually([&] { return shared.posted.load() >= moment; }));
  const std::uint64_t posted = shared.posted.load();
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);

  SessionReader reader(path);
  const auto read = ReadAll(reader);
  Random again{seed};
  for (std::uint64_t cycle = 0; cycle < read.size(); ++cycle) {
    EXPECT_TRUE(SameBits(read[cycle], DrawRecord(again, cycle))) << cycle;
  }
  EXPECT_EQ(reader.damage().missing_cycles, 0U);
  return posted > read.size() ? posted - read.size() : 0;
}

/// How many of at most 100 trials, which end with the second, were within the bound.
int TrialsWithinAHundredMilliseconds(const char* name) {
  void* memory =
      ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return 0;
  auto* shared = new (memory) Shared;
  Random draw{20261121};
  // 100 ms are 1000 cycles. A machine that gives the recorder's thread no time for longer than that
  // breaks the bound in a trial; a recorder that holds data back breaks it in all.
  int within = 0;
  constexpr int kTrials = 100;
  for (int trial = 0; trial < kTrials && within < 2; ++trial) {
    const std::uint64_t lost =
        LostByKill(draw, 100 + static_cast<std::uint64_t>(trial), *shared, name);
    ::testing::Test::RecordProperty("lost_cycles_" + std::to_string(trial), static_cast<int>(lost));
    if (lost <= 1000) ++within;
  }
  ::munmap(memory, sizeof(Shared));
  return within;
}

TEST(Kill, LosesAtMostTheLastHundredMilliseconds) {
  EXPECT_EQ(TrialsWithinAHundredMilliseconds("s.lcmlog"), 2);
}

TEST(Kill, LosesNoMoreOfAPackedSession) {
  EXPECT_EQ(TrialsWithinAHundredMilliseconds("s.lcm.zst"), 2);
}

}  // namespace
}  // namespace levitas::session
