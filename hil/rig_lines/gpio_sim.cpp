#include "hil/rig_lines/gpio_sim.hpp"

#include <fcntl.h>
#include <gpiod.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <string_view>

#include "common/problem.hpp"

namespace levitas::gpio {

namespace {

std::string ChipName(const LinePlace& place) {
  const std::unique_ptr<gpiod_chip, void (*)(gpiod_chip*)> chip(
      gpiod_chip_open_lookup(place.chip.c_str()), gpiod_chip_close);
  if (!chip) {
    throw Problem(ExitStatus::kOther, "line " + std::to_string(place.offset) + " of " + place.chip +
                                          ": no such chip: " + std::strerror(errno));
  }
  return gpiod_chip_name(chip.get());
}

int OpenAttribute(const LinePlace& place, const std::string& chip, const char* name, int how) {
  const std::string path =
      "/sys/bus/gpio/devices/" + chip + "/sim_gpio" + std::to_string(place.offset) + "/" + name;
  const int file = ::open(path.c_str(), how | O_CLOEXEC);
  if (file >= 0) return file;
  throw Problem(ExitStatus::kOther, "line " + std::to_string(place.offset) + " of " + place.chip +
                                        " is not simulated: " + path + ": " + std::strerror(errno));
}

}  // namespace

SimulatedLine::SimulatedLine(const LinePlace& place) : active_high_(place.active_high) {
  const std::string chip = ChipName(place);
  value_file_ = OpenAttribute(place, chip, "value", O_RDONLY);
  pull_file_ = OpenAttribute(place, chip, "pull", O_WRONLY);
}

SimulatedLine::~SimulatedLine() {
  ::close(value_file_);
  ::close(pull_file_);
}

bool SimulatedLine::Driven() const noexcept {
  char level{};
  if (::pread(value_file_, &level, 1, 0) != 1) return false;
  return (level == '1') == active_high_;
}

bool SimulatedLine::Pull(bool active) noexcept {
  const std::string_view word = active == active_high_ ? "pull-up" : "pull-down";
  return ::pwrite(pull_file_, word.data(), word.size(), 0) == static_cast<ssize_t>(word.size());
}

}  // namespace levitas::gpio
