#pragma once
// The levitated rows of a record as matrices, in few spans: what statistics over columns read.
//
// Rows       at most `most_rows`: all of a shorter record, else kSpans spans evenly over it, and
//            one more for every axis whose test signal is in none of them: which of two columns is
//            reversed, only a test signal tells.
// Missing    cycles between two rows: 0 where a row is the sample after the row before it. A row
//            that begins a span has kNewSpan.
// Repeated   rows whose readings of all axes are those before, bit for bit: a frame that was lost,
//            whose last readings were held, or chance.
// Frame      bearing frame, SI units. Thread: plain data; ColumnsOf is pure.

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "diagnosis/model/model_run.hpp"
#include "diagnosis/model/rig_view.hpp"

namespace levitas::diagnosis {

inline constexpr std::uint64_t kNewSpan = std::numeric_limits<std::uint64_t>::max();

struct Columns {
  std::string name;                                     ///< of the record
  Eigen::MatrixXd position_m, current_a, excitation_a;  ///< rows x axes
  Eigen::VectorXd angle_rad, speed_rad_per_s;
  std::vector<std::uint64_t> missing;
  std::vector<std::uint8_t> repeated;
  double mean_speed_rad_per_s{};

  [[nodiscard]] Eigen::Index rows() const noexcept { return position_m.rows(); }
  [[nodiscard]] Eigen::Index axes() const noexcept { return position_m.cols(); }
};

/// Control current at which a coil of the axis is at zero or at its largest current [A].
[[nodiscard]] double CurrentLimit(const RigView& rig, std::size_t axis);

[[nodiscard]] Columns ColumnsOf(const Record& record, const RigView& rig, std::size_t most_rows);

}  // namespace levitas::diagnosis
