#pragma once
// A recorded session or a measured CSV file as columns: what every identification starts from.
//
// Frame    bearing frame: probe and amplifier polarity of the rig file are undone.
// Units    SI. Currents are the total command of a row's sample, excitation included.
// Rows     one per sample and consecutive within a piece; `cycle` shows the gaps.
// Thread   any.
// Failure  BadInput: unreadable file, other channels or period than the rig.

#include <cstdint>
#include <string>
#include <vector>

#include "config/rig_file.hpp"

namespace levitas::identification {

using Column = std::vector<double>;

struct Record {
  std::string name;  ///< path, for messages
  double period_s{};
  std::vector<std::string> channels;
  double sensor_range_m{};   ///< positions at this are clipped
  Column sensor_ranges_m;    ///< per axis; empty: sensor_range_m everywhere
  double current_limit_a{};  ///< |control current| that the coils leave
  std::vector<std::uint64_t> cycle;
  std::vector<std::uint8_t> levitated;
  Column speed_rad_per_s;
  Column angle_rad;
  std::vector<Column> position_m;  ///< per axis
  std::vector<Column> current_a;
  std::vector<Column> excitation_a;

  [[nodiscard]] std::size_t rows() const noexcept { return cycle.size(); }
  [[nodiscard]] double SensorRangeOf(std::size_t axis) const noexcept {
    return axis < sensor_ranges_m.size() ? sensor_ranges_m[axis] : sensor_range_m;
  }
  [[nodiscard]] std::size_t axes() const noexcept { return channels.size(); }
};

/// A session, or a .csv / .csv.xz file of the contract in docs/formats.md.
[[nodiscard]] Record ReadRecord(const std::string& path, const config::RigFile& rig);

}  // namespace levitas::identification
