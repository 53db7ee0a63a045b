#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fstream>
#include <numbers>
#include <optional>
#include <sstream>
#include <system_error>

#include "common/problem.hpp"
#include "identification/geared/full_spectrum.hpp"

namespace levitas::identification {
namespace {

constexpr std::array<std::string_view, 11> kColumns{"pinion_speed_hz",     "line",
                                                    "frequency_hz",        "pinion_re_m",
                                                    "pinion_im_m",         "gear_re_m",
                                                    "gear_im_m",           "pinion_current_re_a",
                                                    "pinion_current_im_a", "gear_current_re_a",
                                                    "gear_current_im_a"};

std::vector<std::string> Cells(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

double Number(const std::string& cell, const std::string& where) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc{} || end != cell.data() + cell.size() || !std::isfinite(value)) {
    throw BadInput(fmt::format("{}: '{}' is no finite number", where, cell));
  }
  return value;
}

/// Of "mesh_+1", "mesh_-1" and the like; nothing else begins so.
std::optional<int> MeshHarmonic(const std::string& name) {
  if (!name.starts_with("mesh_")) return std::nullopt;
  const std::string digits = name.substr(name.starts_with("mesh_+") ? 6 : 5);
  int harmonic = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), harmonic);
  if (error != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
  return harmonic;
}

void SetKind(GearedLine& line, const std::string& name, const std::string& where) {
  if (name == "pinion_1x") {
    line.kind = GearedLine::Kind::kPinion;
  } else if (name == "gear_1x") {
    line.kind = GearedLine::Kind::kGear;
  } else if (name == "pinion_-1x" || name == "gear_+1x") {
    line.kind = GearedLine::Kind::kMirror;
  } else if (name == "mean") {
    line.kind = GearedLine::Kind::kTransmissionError;
  } else if (const auto harmonic = MeshHarmonic(name)) {
    line.kind = GearedLine::Kind::kTransmissionError;
    line.harmonic = *harmonic;
  } else {
    throw BadInput(fmt::format(
        "{}: line '{}', allowed: pinion_1x, gear_1x, pinion_-1x, gear_+1x, mean, mesh_+1, mesh_-1 "
        "...",
        where, name));
  }
}

}  // namespace

std::vector<GearedLine> ReadGearedLines(const std::string& path) {
  std::ifstream file(path);
  if (!file) {
    throw BadInput(fmt::format("{}: cannot be read: {}", path,
                               std::error_code(errno, std::generic_category()).message()));
  }
  std::string text;
  std::getline(file, text);
  const std::vector<std::string> header = Cells(text);
  if (!std::equal(header.begin(), header.end(), kColumns.begin(), kColumns.end())) {
    throw BadInput(fmt::format("{}: line 1: found '{}', needed the columns {}", path, text,
                               fmt::join(kColumns, ",")));
  }
  std::vector<GearedLine> lines;
  for (std::size_t number = 2; std::getline(file, text); ++number) {
    const std::string where = fmt::format("{}: line {}", path, number);
    const std::vector<std::string> cells = Cells(text);
    if (cells.size() != kColumns.size()) {
      throw BadInput(fmt::format("{}: {} cells, needed {}", where, cells.size(), kColumns.size()));
    }
    GearedLine line;
    SetKind(line, cells[1], where);
    const auto value = [&](std::size_t i) { return Number(cells[i], where); };
    line.speed_rad_per_s = 2.0 * std::numbers::pi * value(0);
    line.frequency_rad_per_s = 2.0 * std::numbers::pi * value(2);
    line.pinion_m = {value(3), value(4)};
    line.gear_m = {value(5), value(6)};
    line.pinion_a = {value(7), value(8)};
    line.gear_a = {value(9), value(10)};
    lines.push_back(line);
  }
  return lines;
}

}  // namespace levitas::identification
