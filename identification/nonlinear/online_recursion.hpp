#pragma once
// The recursion of hammerstein_wiener.hpp beside a running loop: rows as they come, gaps among
// them, and how far the parameters have come to rest.
//
// Scales    rms of each signal over the first window of rows, which are then learnt like all
//           others. When a later window is kSwell times larger in a signal, as far as it has
//           come at each tenth of it, scales and recursion begin anew with it: powers of such
//           numbers would leave no digits for the rest.
// Gap       the past of the signals is cleared; the next MemoryRows rows fill it and teach nothing.
//           A row that is not finite counts as missing.
// Point     after every window of rows that were learnt. Change: largest |theta - theta before| of
//           an output over its largest |theta|, as FitHammersteinWiener compares two passes (Chiu
//           2022 ends at 1 %). Error and fit: of the predictions made with the parameters that held
//           at each row, before it was learnt; fit = 100 (1 - |v - p|/|v - mean v|).
// Converged the change is within `tolerance`, and kRowsPerRegressor rows per regressor were learnt:
//           the change of any mean falls with time, also of one that has seen too little.
// Bits      the same rows give the same parameters bit for bit, however they arrive.
// Units     those of the rows; errors in the unit of the outputs.
// Thread    one. `on_point` is called from Take. Failure: std::invalid_argument for sizes that do
//           not fit; parameters that are no longer finite are thrown away and begun anew.
// Not done  whether the rows say enough: without a test signal the loop's own noise is all there
//           is, and what it does not excite comes to rest anywhere.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "identification/nonlinear/hammerstein_wiener.hpp"

namespace levitas::identification {

struct OnlineOptions {
  HammersteinWienerOptions model;
  Eigen::Index inputs{}, outputs{};
  double period_s{};
  Eigen::Index window_rows{};  ///< of a point; about a second of them
};

/// How the recursion stands at the end of a window.
struct ConvergencePoint {
  std::uint64_t cycle{};        ///< of the window's last row
  std::uint64_t rows{};         ///< learnt since the recursion began, or began anew
  double change{};              ///< largest relative change of a parameter over the window
  Eigen::Index regressor{};     ///< which parameter that was
  Eigen::Index output{};        ///< and of which output
  Eigen::VectorXd error_rms;    ///< per output
  Eigen::VectorXd fit_percent;  ///< per output
  bool converged{};
};

/// Rows that did not come, and what became of them.
struct RowCounts {
  std::uint64_t learnt{};      ///< in all
  std::uint64_t filled{};      ///< that only filled the past after a gap or a pause
  std::uint64_t gaps{};        ///< places at which rows are missing
  std::uint64_t missing{};     ///< rows that are
  std::uint64_t pauses{};      ///< places at which rows were held back on purpose
  std::uint64_t begun_anew{};  ///< times that the recursion began anew
};

class OnlineRecursion {
 public:
  static constexpr double kSwell = 10.0;
  static constexpr std::uint64_t kRowsPerRegressor = 10;

  explicit OnlineRecursion(OnlineOptions options,
                           std::function<void(const ConvergencePoint&)> on_point = {});

  /// The row of `cycle`: inputs commanded from the outputs read in it.
  void Take(std::uint64_t cycle, const Eigen::VectorXd& u, const Eigen::VectorXd& y);
  /// What is missing before the next row was held back on purpose.
  void Pause() noexcept { paused_ = true; }
  /// No more rows: what waits for its scales is learnt.
  void Finish();

  /// Null before the first window is full.
  [[nodiscard]] const HammersteinWienerModel* model() const noexcept {
    return recursion_ ? &recursion_->model() : nullptr;
  }
  [[nodiscard]] const RowCounts& counts() const noexcept { return counts_; }
  [[nodiscard]] std::optional<std::uint64_t> first_cycle() const noexcept { return first_cycle_; }
  [[nodiscard]] std::optional<std::uint64_t> last_cycle() const noexcept { return last_cycle_; }
  /// Rows learnt, since the recursion began, at the first point that was converged.
  [[nodiscard]] std::optional<std::uint64_t> rows_to_converge() const noexcept {
    return rows_to_converge_;
  }
  [[nodiscard]] const std::optional<ConvergencePoint>& newest() const noexcept { return newest_; }

 private:
  struct Row {
    std::uint64_t cycle{};
    bool after_pause{};
    Eigen::VectorXd u, y;
  };
  /// Sums over the rows of a window, in scaled units; outputs about the window's first row.
  struct Sums {
    Eigen::Index rows{};
    Eigen::VectorXd origin, shifted, shifted_square, error_square, u_square, v_square;
  };

  void Begin(const Eigen::VectorXd& input_scale, const Eigen::VectorXd& output_scale);
  void BeginWithKept();
  void BeginAnew();
  void Learn(const Row& row);
  void CountGap(const Row& row) noexcept;
  void Add(const Eigen::VectorXd& u, const Eigen::VectorXd& error) noexcept;
  void ClearSums() noexcept;
  void Close();
  [[nodiscard]] ConvergencePoint Point() const;
  [[nodiscard]] bool Swollen() const noexcept;

  OnlineOptions options_;
  std::function<void(const ConvergencePoint&)> on_point_;
  std::vector<Row> kept_;  ///< the first window's rows; reserved once
  std::size_t kept_rows_{};
  Row row_;
  bool paused_{};
  std::optional<RecursiveHammersteinWiener> recursion_;
  Eigen::Index memory_rows_{}, to_fill_{};
  std::uint64_t rows_since_begin_{};
  Eigen::MatrixXd theta_before_;
  Sums sums_;
  RowCounts counts_;
  std::optional<std::uint64_t> first_cycle_, last_cycle_, rows_to_converge_;
  std::optional<ConvergencePoint> newest_;
};

/// "position ux, section 2", "current uy^3, section 1", "constant": what the regressor is of.
[[nodiscard]] std::string RegressorName(const HammersteinWienerModel& model, Eigen::Index regressor,
                                        const std::vector<std::string>& axes);

}  // namespace levitas::identification
