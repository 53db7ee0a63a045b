// The enable line when its controller is killed, hangs or is stopped: with the guard, and without.
// The wire is pulled up here: the worst board, on which a line that nobody drives is active.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>
#include <thread>

#include "hil/libgpiod/gpiod_lines.hpp"
#include "hil/rig_lines/gpio_sim.hpp"
#include "rt/clock.hpp"
#include "tests/support/gpio_sim_chip.hpp"
#include "tests/support/waiting.hpp"

namespace levitas::gpio {
namespace {

using namespace std::chrono_literals;

/// Processes called amb-line-guard.
std::vector<pid_t> Guards() {
  std::vector<pid_t> found;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    std::string name;
    std::ifstream(entry.path() / "comm") >> name;
    if (name == "amb-line-guard") found.push_back(std::stoi(entry.path().filename()));
  }
  return found;
}

/// A controller in a process of its own: enables the amplifiers and runs 10 kHz cycles.
class Controller {
 public:
  explicit Controller(const LinesConfig& config) {
    std::array<int, 2> ready{};
    if (::pipe(ready.data()) != 0) std::abort();
    process_ = ::fork();
    if (process_ == 0) {
      GpiodLines lines(config);
      lines.WriteEnable(true);
      if (::write(ready[1], "r", 1) != 1) ::_exit(1);
      std::int64_t due_ns = rt::MonotonicNowNs();
      for (;;) {
        lines.CycleDone();
        due_ns += 100'000;
        const timespec until{due_ns / 1'000'000'000, due_ns % 1'000'000'000};
        ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
      }
    }
    char letter{};
    while (::read(ready[0], &letter, 1) < 0 && errno == EINTR) {
    }
    ::close(ready[0]);
    ::close(ready[1]);
  }
  ~Controller() { Signal(SIGKILL); }
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;

  void Signal(int number) const {
    ::kill(process_, number);
    if (number == SIGKILL) ::waitpid(process_, nullptr, 0);
  }
  [[nodiscard]] pid_t process() const { return process_; }

 private:
  pid_t process_{-1};
};

struct LineGuardTest : testing::Test {
  LineGuardTest() {
    config.amplifier_enable = chip.Line(1);
    config.watchdog_s = 0.02;
    enable.emplace(*config.amplifier_enable);
    enable->Pull(true);
  }
  ~LineGuardTest() override {
    for (const pid_t guard : Guards()) ::kill(guard, SIGKILL);
  }
  /// Time until the line is inactive, looked at every 50 us.
  [[nodiscard]] std::int64_t NsUntilInactive() const {
    const std::int64_t start_ns = rt::MonotonicNowNs();
    while (enable->Driven() &&
           std::chrono::nanoseconds(rt::MonotonicNowNs() - start_ns) < test::kLimit) {
      test::Pause(50us, "between two looks");
    }
    return rt::MonotonicNowNs() - start_ns;
  }

  test::GpioSimChip chip{4};
  LinesConfig config;
  std::optional<SimulatedLine> enable;
  /// In virtual time instants can be asserted, elsewhere only what happens.
  const bool exact = std::string_view(std::getenv("LEVITAS_TEST_MACHINE")) == "virtual";
};

TEST_F(LineGuardTest, AKilledControllerDropsTheEnableLine) {
  const Controller controller(config);
  ASSERT_TRUE(enable->Driven());
  controller.Signal(SIGKILL);
  const std::int64_t took_ns = NsUntilInactive();
  EXPECT_FALSE(enable->Driven());
  if (exact) {
    EXPECT_LT(took_ns, 200'000) << "two periods of 100 us";
  }
}

TEST_F(LineGuardTest, WithoutTheGuardTheLineOfAKilledControllerGoesWhereTheBoardPullsIt) {
  const Controller controller(config);
  const std::vector<pid_t> guards = Guards();
  ASSERT_EQ(guards.size(), 1U);
  ::kill(guards[0], SIGKILL);
  test::Pause(10ms, "nothing may change within this, or longer");
  ASSERT_TRUE(enable->Driven()) << "a guard that is gone changes nothing by itself";
  controller.Signal(SIGKILL);
  test::Pause(100ms, "nothing may change within this, or longer");
  EXPECT_TRUE(enable->Driven()) << "the harm: the amplifiers stay enabled without a controller";
}

TEST_F(LineGuardTest, WithoutGuardAPullDownDropsTheLineOfAKilledController) {
  enable->Pull(false);
  const Controller controller(config);
  for (const pid_t guard : Guards()) ::kill(guard, SIGKILL);
  test::Pause(10ms, "nothing may change within this, or longer");
  ASSERT_TRUE(enable->Driven());
  controller.Signal(SIGKILL);
  (void)NsUntilInactive();
  EXPECT_FALSE(enable->Driven());
}

TEST_F(LineGuardTest, AControllerThatIsStoppedDropsTheEnableLineAfterTheWatchdogsTime) {
  const Controller controller(config);
  test::Pause(100ms, "nothing may change within this, or longer");
  ASSERT_TRUE(enable->Driven()) << "a running cycle keeps the watchdog quiet";
  controller.Signal(SIGSTOP);
  const std::int64_t took_ns = NsUntilInactive();
  EXPECT_FALSE(enable->Driven());
  if (exact) {
    // Looked at four times per watchdog's time: one look early at most, one late.
    EXPECT_GE(took_ns, 15'000'000);
    EXPECT_LE(took_ns, 26'000'000);
  }
}

TEST_F(LineGuardTest, AControllerThatGoesOnAfterAHangCannotEnableAgain) {
  const Controller controller(config);
  controller.Signal(SIGSTOP);
  (void)NsUntilInactive();
  controller.Signal(SIGCONT);
  test::Pause(200ms, "nothing may change within this, or longer");
  EXPECT_FALSE(enable->Driven());
}

TEST_F(LineGuardTest, SignalsOfATerminalEndTheControllerAndNotItsGuard) {
  const Controller controller(config);
  ASSERT_EQ(Guards().size(), 1U);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) ::kill(Guards()[0], number);
  test::Pause(10ms, "nothing may change within this, or longer");
  EXPECT_EQ(Guards().size(), 1U);
  EXPECT_NE(::getsid(Guards()[0]), ::getsid(controller.process()));
}

TEST_F(LineGuardTest, AnOrderlyEndDismissesTheGuard) {
  {
    GpiodLines lines(config);
    EXPECT_TRUE(lines.guard_alive());
    EXPECT_EQ(Guards().size(), 1U);
  }
  EXPECT_TRUE(Guards().empty());
}

TEST_F(LineGuardTest, AGuardThatHasEndedIsNoticed) {
  const GpiodLines lines(config);
  ASSERT_EQ(Guards().size(), 1U);
  ::kill(Guards()[0], SIGKILL);
  EXPECT_TRUE(test::Eventually([&] { return !lines.guard_alive(); }));
}

TEST_F(LineGuardTest, TheNextControllerWaitsForTheLineOfOneThatWasKilled) {
  { const Controller killed(config); }
  GpiodLines lines(config);
  EXPECT_TRUE(lines.WriteEnable(true));
  EXPECT_TRUE(enable->Driven());
}

}  // namespace
}  // namespace levitas::gpio
