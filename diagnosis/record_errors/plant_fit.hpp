#pragma once
// How well the rig's linear model foretells the readings of a record when its columns are taken for
// other ones than their names say.
//
// Equation   x' = A (x + K e) + B u, e = y - C x: the stationary observer
//            (analysis/records/observer.hpp) of the linearised plant at the mean speed, unknown
//            forces included. e is linear in every column; each column is driven through every
//            place once, and any map of columns is a sum of these responses: a hypothesis costs a
//            few additions per row.
// Ratio      mean square of e per axis, without its mean and its parts at once and twice the
//            rotation in stretches of 0.1 s (unbalance, bow and runout, which no map can make or
//            mend), over what the observer expects of a right model.
// Counts     rows that arrived, behind the observer's settling, and not within kEdge rows of a
//            break. Frames that are missing or repeated advance the model without correction.
// Cost       about 20 us a row with four axes and eight modes. Memory: rows x axes^3 x 16 bytes.
// Thread     any; immutable after construction. Failure: Problem where no observer exists.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "diagnosis/model/observer_speed.hpp"
#include "diagnosis/model/rig_view.hpp"
#include "diagnosis/record_errors/column_use.hpp"
#include "diagnosis/record_errors/columns.hpp"

namespace levitas::diagnosis {

class PlantFit {
 public:
  /// `period_factor`: the rows are so many periods of the rig apart.
  PlantFit(const RigView& rig, const Columns& columns, const ObserverSpeed& speed,
           bool every_place = true, double period_factor = 1.0);

  /// Per axis; empty where too few rows count.
  [[nodiscard]] Eigen::VectorXd Ratios(const ColumnUses& uses) const;
  /// [m^2] The same without what is expected, which for rows that are further apart is more: models
  /// of different periods are compared by these.
  [[nodiscard]] Eigen::VectorXd MeanSquares(const ColumnUses& uses) const;
  [[nodiscard]] std::size_t counted() const noexcept { return counted_; }

 private:
  static constexpr int kEdge = 8;

  void Run(const RigView& rig, const Columns& columns, const ObserverSpeed& speed,
           double period_factor);
  void MakeBasis(const Columns& columns, std::size_t rows_a_stretch);
  [[nodiscard]] std::size_t Slot(std::size_t column, std::size_t place) const noexcept {
    return every_place_ ? column * axes_ + place : column;
  }

  /// Rows [from, to) of which some count, and an orthonormal basis over all of them that is zero
  /// where a row does not count.
  struct Stretch {
    Eigen::Index from{}, to{};
    Eigen::MatrixXd basis;
  };

  [[nodiscard]] Eigen::MatrixXd Raw(const Stretch& s, const ColumnUses& uses) const;

  std::size_t axes_{};
  bool every_place_{};
  std::size_t counted_{};
  Eigen::VectorXd expected_m_;
  std::vector<Eigen::MatrixXd> of_position_, of_current_;  ///< [slot]: rows x axes
  std::vector<std::uint8_t> counts_;
  std::vector<Stretch> stretches_;
};

}  // namespace levitas::diagnosis
