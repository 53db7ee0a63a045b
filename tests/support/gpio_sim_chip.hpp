#pragma once
// A chip of the kernel's gpio-sim for one test: made at construction, gone at its end.
//
// Needs    root, configfs, gpio-sim: the place hardware tests run in (CONTRIBUTING.md).
// Failure  std::runtime_error.

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "hil/gpio/line_config.hpp"

namespace levitas::test {

class GpioSimChip {
 public:
  explicit GpioSimChip(int lines, std::string name = "levitas_test")
      : folder_("/sys/kernel/config/gpio-sim/" + name) {
    std::filesystem::create_directories(folder_ / "bank0");
    Write(folder_ / "bank0" / "num_lines", std::to_string(lines));
    Write(folder_ / "live", "1");
    std::ifstream(folder_ / "bank0" / "chip_name") >> chip_;
    if (chip_.empty()) throw std::runtime_error("gpio-sim gave no chip");
  }
  ~GpioSimChip() {
    std::ofstream(folder_ / "live") << "0";
    std::error_code ignored;
    std::filesystem::remove(folder_ / "bank0", ignored);
    std::filesystem::remove(folder_, ignored);
  }
  GpioSimChip(const GpioSimChip&) = delete;
  GpioSimChip& operator=(const GpioSimChip&) = delete;

  [[nodiscard]] const std::string& name() const { return chip_; }
  [[nodiscard]] gpio::LinePlace Line(std::uint32_t offset, bool active_high = true) const {
    return {.chip = chip_, .offset = offset, .active_high = active_high};
  }

 private:
  static void Write(const std::filesystem::path& file, const std::string& text) {
    std::ofstream out(file);
    out << text << std::flush;
    if (!out) throw std::runtime_error("cannot write " + file.string());
  }

  std::filesystem::path folder_;
  std::string chip_;
};

}  // namespace levitas::test
