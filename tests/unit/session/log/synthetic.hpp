#pragma once
// Synthetic records, sessions and files for the tests of session/: every field has a value of its
// own drawn from a written seed, so that a swapped or forgotten field shows.

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "common/random.hpp"
#include "session/log/session_reader.hpp"
#include "session/log/session_writer.hpp"

namespace levitas::session::testing {

inline SessionHeader Header() {
  return {.program_version = "0.1.0",
          .rig_yaml = "name: test\n",
          .controller_yaml = "name: law\n",
          .scenario_yaml = "",
          .pace = "lockstep",
          .seed = 7,
          .period_ns = 100'000,
          .start_utc_ns = 1'763'700'000'000'000'000,
          .machine = "test machine",
          .source = "lcm",
          .channels = {"de_x", "de_y", "nde_x", "nde_y"},
          .excerpt_of = ""};
}

inline AxisArray DrawAxes(Random& draw, double scale, std::size_t axes = 4) {
  AxisArray values{};
  for (std::size_t axis = 0; axis < axes; ++axis) values[axis] = scale * draw.Normal();
  return values;
}

/// A levitating cycle with noise in every number.
inline cycle::CycleRecord DrawRecord(Random& draw, std::uint64_t cycle) {
  cycle::CycleRecord record;
  auto& in = record.in;
  in.cycle = cycle;
  in.frame_present = true;
  in.frame = {.cycle = cycle + 3,
              .sample_time_ns = static_cast<std::int64_t>(cycle) * 100'000,
              .rig_session = 0x8000'0001U,
              .rig_status = 0,
              .held_currents = static_cast<std::uint32_t>(draw.Bits() % 5),
              .axes = 4,
              .position_m = DrawAxes(draw, 1e-6),
              .speed_rad_per_s = 100.0 + draw.Uniform(),
              .angle_rad = 6.28 * draw.Uniform()};
  in.op.excitation_a = DrawAxes(draw, 0.01);
  in.op.excitation_m = DrawAxes(draw, 1e-6);
  auto& out = record.out;
  out.mode = Mode::kLevitating;
  out.reference_m = DrawAxes(draw, 1e-7);
  out.saturated_axes = static_cast<std::uint16_t>(draw.Bits() % 16);
  out.current = {.cycle = in.frame.cycle,
                 .axes = 4,
                 .control_current_a = DrawAxes(draw, 0.3),
                 .bias_current_a = 1.0,
                 .speed_set_point_rad_per_s = 314.0 + draw.Uniform(),
                 .acceleration_limit_rad_per_s2 = 10.0 + draw.Uniform(),
                 .amplifiers_enabled = true,
                 .drive_enabled = true};
  return record;
}

inline std::vector<cycle::CycleRecord> DrawRecords(std::size_t count, std::uint64_t seed = 1) {
  Random draw{seed};
  std::vector<cycle::CycleRecord> records;
  for (std::size_t cycle = 0; cycle < count; ++cycle) records.push_back(DrawRecord(draw, cycle));
  return records;
}

inline bool SameBits(double a, double b) noexcept {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
inline bool SameBits(const AxisArray& a, const AxisArray& b) noexcept {
  return std::memcmp(a.data(), b.data(), sizeof a) == 0;
}

/// Bit for bit, so NaN equals the same NaN and 0 differs from -0.
inline bool SameBits(const cycle::CycleRecord& a, const cycle::CycleRecord& b) noexcept {
  const auto& fa = a.in.frame;
  const auto& fb = b.in.frame;
  const auto& ca = a.out.current;
  const auto& cb = b.out.current;
  return a.in.cycle == b.in.cycle && a.in.frame_present == b.in.frame_present &&
         fa.cycle == fb.cycle && fa.sample_time_ns == fb.sample_time_ns &&
         fa.rig_session == fb.rig_session && fa.rig_status == fb.rig_status &&
         fa.held_currents == fb.held_currents && fa.axes == fb.axes &&
         SameBits(fa.position_m, fb.position_m) &&
         SameBits(fa.speed_rad_per_s, fb.speed_rad_per_s) && SameBits(fa.angle_rad, fb.angle_rad) &&
         a.in.missed_deadlines == b.in.missed_deadlines && a.in.op.command == b.in.op.command &&
         SameBits(a.in.op.speed_rad_per_s, b.in.op.speed_rad_per_s) &&
         SameBits(a.in.op.acceleration_rad_per_s2, b.in.op.acceleration_rad_per_s2) &&
         SameBits(a.in.op.excitation_a, b.in.op.excitation_a) &&
         SameBits(a.in.op.excitation_m, b.in.op.excitation_m) && a.out.mode == b.out.mode &&
         a.out.fault == b.out.fault && a.out.fault_axis == b.out.fault_axis &&
         a.out.saturated_axes == b.out.saturated_axes &&
         SameBits(a.out.fault_value, b.out.fault_value) &&
         SameBits(a.out.fault_limit, b.out.fault_limit) &&
         a.out.command_refused == b.out.command_refused &&
         SameBits(a.out.reference_m, b.out.reference_m) && ca.cycle == cb.cycle &&
         ca.axes == cb.axes && SameBits(ca.control_current_a, cb.control_current_a) &&
         SameBits(ca.bias_current_a, cb.bias_current_a) &&
         SameBits(ca.speed_set_point_rad_per_s, cb.speed_set_point_rad_per_s) &&
         SameBits(ca.acceleration_limit_rad_per_s2, cb.acceleration_limit_rad_per_s2) &&
         ca.amplifiers_enabled == cb.amplifiers_enabled && ca.drive_enabled == cb.drive_enabled;
}

/// A folder of its own for each test, removed with it.
class Folder {
 public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "levitas-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] std::string operator/(const std::string& name) const {
    return (path_ / name).string();
  }

 private:
  std::filesystem::path path_;
};

inline void WriteSession(const std::string& path, const std::vector<cycle::CycleRecord>& records,
                         const SessionHeader& header = Header()) {
  SessionWriter writer(path, header);
  for (const auto& record : records) writer.Write(record);
}

inline std::string ReadFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void WriteFile(const std::string& path, const std::string& content) {
  std::ofstream file(path, std::ios::binary);
  file << content;
}

/// A MAT file of version 4: a header of five numbers, the name, the numbers column by column.
inline std::string Matrix(const std::string& name, std::int32_t rows,
                          const std::vector<double>& numbers) {
  const std::array<std::int32_t, 5> header{0, rows,
                                           static_cast<std::int32_t>(numbers.size()) / rows, 0,
                                           static_cast<std::int32_t>(name.size()) + 1};
  std::string bytes(sizeof header, '\0');
  std::memcpy(bytes.data(), header.data(), sizeof header);
  bytes += name + '\0';
  std::string data(numbers.size() * sizeof(double), '\0');
  std::memcpy(data.data(), numbers.data(), data.size());
  return bytes + data;
}

inline std::vector<cycle::CycleRecord> ReadAll(SessionReader& reader) {
  std::vector<cycle::CycleRecord> records;
  cycle::CycleRecord record;
  while (reader.Next(record)) records.push_back(record);
  return records;
}

}  // namespace levitas::session::testing
