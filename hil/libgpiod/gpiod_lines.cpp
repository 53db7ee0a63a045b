#include "hil/libgpiod/gpiod_lines.hpp"

#include <fcntl.h>
#include <gpiod.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <thread>

#include "common/problem.hpp"
#include "hil/libgpiod/line_guard.hpp"

namespace levitas::gpio {

namespace {

constexpr const char* kConsumer = "amb-controller";
constexpr int kBusyAttempts = 10;
constexpr auto kBusyPause = std::chrono::milliseconds(100);
constexpr std::size_t kEventsAtOnce = 16;  // what the kernel keeps for a line

struct ChipCloser {
  void operator()(gpiod_chip* chip) const noexcept { gpiod_chip_close(chip); }
};

// The chips of the lines, each opened once; collects what went wrong instead of stopping at it.
class LineDesk {
 public:
  // `safe_active`: the level that means "stop" when nobody drives the line.
  gpiod_line* Take(const char* function, const LinePlace& place, int type, bool safe_active) {
    gpiod_chip* chip = Chip(place.chip);
    if (chip == nullptr) return Refuse(function, place, "no such chip");
    gpiod_line* line = gpiod_chip_get_line(chip, place.offset);
    if (line == nullptr) return Refuse(function, place, "no such line on the chip");
    int flags = place.active_high ? 0 : GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW;
    if (place.bias == Bias::kInternal) {
      // A pull is a matter of the wire, not of what the level means.
      flags |= safe_active == place.active_high ? GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP
                                                : GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN;
    }
    if (!Request(line, {kConsumer, type, flags})) {
      const int error = errno;
      const char* consumer = gpiod_line_consumer(line);
      return Refuse(function, place,
                    error == EBUSY && consumer != nullptr ? std::string("in use by ") + consumer
                                                          : std::strerror(error));
    }
    return line;
  }
  [[nodiscard]] const std::string& problems() const noexcept { return problems_; }

 private:
  // The guard of a controller that was killed holds its line for half a second.
  static bool Request(gpiod_line* line, const gpiod_line_request_config& request) {
    for (int attempt = 0;; ++attempt) {
      if (gpiod_line_request(line, &request, 0) == 0) return true;
      if (errno != EBUSY || attempt == kBusyAttempts) return false;
      std::this_thread::sleep_for(kBusyPause);
    }
  }
  gpiod_chip* Chip(const std::string& name) {
    auto& chip = chips_[name];
    if (!chip) chip.reset(gpiod_chip_open_lookup(name.c_str()));
    return chip.get();
  }
  gpiod_line* Refuse(const char* function, const LinePlace& place, const std::string& why) {
    problems_ += std::string(problems_.empty() ? "" : "\n") + "lines." + function + ": " +
                 place.chip + " line " + std::to_string(place.offset) + ": " + why;
    return nullptr;
  }

  std::map<std::string, std::unique_ptr<gpiod_chip, ChipCloser>> chips_;
  std::string problems_;
};

}  // namespace

struct GpiodLines::Impl {
  explicit Impl(const LinesConfig& config) {
    const auto input = [&](const char* function, const auto& place, bool safe_active) {
      return place ? desk.Take(function, *place, GPIOD_LINE_REQUEST_DIRECTION_INPUT, safe_active)
                   : nullptr;
    };
    constexpr int kOutput = GPIOD_LINE_REQUEST_DIRECTION_OUTPUT;
    // A broken wire must read as an open chain, and as a fault.
    stop = input("emergency_stop", config.emergency_stop, false);
    fault = input("amplifier_fault", config.amplifier_fault, true);
    if (config.amplifier_enable) {
      enable = desk.Take("amplifier_enable", *config.amplifier_enable, kOutput, false);
    }
    if (config.heartbeat)
      heartbeat = desk.Take("heartbeat", config.heartbeat->line, kOutput, false);
    if (config.key_phasor) {
      pulses = desk.Take("key_phasor", config.key_phasor->line,
                         GPIOD_LINE_REQUEST_EVENT_RISING_EDGE, false);
    }
    if (!desk.problems().empty()) throw Problem(ExitStatus::kOther, desk.problems());
    if (pulses != nullptr) {
      pulse_file = gpiod_line_event_get_fd(pulses);
      ::fcntl(pulse_file, F_SETFL, ::fcntl(pulse_file, F_GETFL) | O_NONBLOCK);
    }
    if (enable != nullptr) {
      guard.emplace([this] { return gpiod_line_set_value(enable, 0) == 0; },
                    static_cast<std::int64_t>(config.watchdog_s * 1e9));
    }
  }

  LineDesk desk;
  gpiod_line* stop{};
  gpiod_line* fault{};
  gpiod_line* enable{};
  gpiod_line* heartbeat{};
  gpiod_line* pulses{};
  int pulse_file{-1};
  std::optional<LineGuard> guard;
};

GpiodLines::GpiodLines(const LinesConfig& config) : impl_(std::make_unique<Impl>(config)) {}

GpiodLines::~GpiodLines() {
  WriteEnable(false);
  WriteHeartbeat(false);
}

InputLevels GpiodLines::ReadInputs() noexcept {
  InputLevels levels;
  const auto read = [&](gpiod_line* line, bool absent) {
    if (line == nullptr) return absent;
    const int value = gpiod_line_get_value(line);
    levels.readable = levels.readable && value >= 0;
    return value == 1;
  };
  levels.stop_chain_closed = read(impl_->stop, true);
  levels.amplifier_fault = read(impl_->fault, false);
  return levels;
}

std::size_t GpiodLines::ReadPulses(std::span<std::int64_t> time_ns) noexcept {
  if (impl_->pulse_file < 0) return 0;
  std::array<gpiod_line_event, kEventsAtOnce> events{};
  const auto wanted = static_cast<unsigned>(std::min(time_ns.size(), events.size()));
  if (wanted == 0) return 0;
  const int count = gpiod_line_event_read_fd_multiple(impl_->pulse_file, events.data(), wanted);
  if (count <= 0) return 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    time_ns[i] = std::int64_t{events.at(i).ts.tv_sec} * 1'000'000'000 + events.at(i).ts.tv_nsec;
  }
  return static_cast<std::size_t>(count);
}

bool GpiodLines::WriteEnable(bool active) noexcept {
  if (impl_->enable == nullptr) return true;
  if (active && !impl_->guard->Arm()) return false;
  const bool written = gpiod_line_set_value(impl_->enable, active ? 1 : 0) == 0;
  if (!active) impl_->guard->Disarm();
  return written;
}

bool GpiodLines::WriteHeartbeat(bool active) noexcept {
  return impl_->heartbeat == nullptr || gpiod_line_set_value(impl_->heartbeat, active ? 1 : 0) == 0;
}

void GpiodLines::CycleDone() noexcept {
  if (impl_->guard) impl_->guard->Beat();
}

bool GpiodLines::guard_alive() const noexcept { return !impl_->guard || impl_->guard->alive(); }

}  // namespace levitas::gpio
