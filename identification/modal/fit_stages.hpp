#pragma once
// One stage of the modal fit after the other, on the same vector: what each of them has free, which
// lines it looks at, how forgiving it is. Parts of modal_fit.hpp.
//
// Thread    one; uses `threads` of the options. Start, pairing, options and fit stay the caller's.

#include <string>
#include <vector>

#include "identification/modal/line_residuals.hpp"
#include "identification/modal/modal_fit.hpp"

namespace levitas::identification {

/// A response and what its experiments make of the magnets.
struct FitData {
  const FrequencyResponse& response;
  WorkingGains gains;
};

struct StageSetup {
  std::string name;
  std::vector<const FitData*> data{};
  LineKind kind{LineKind::kComplex};
  bool robust{};
  bool rig_free{true};
  bool poles_free{true};
  bool gyroscopic_free{};
  int iterations{60};
  std::size_t stride{1};  ///< every n-th line
  /// Weights per line in decibels instead of those of the noise, for a single response.
  const std::vector<Eigen::MatrixXd>* marks{};
};

class Search {
 public:
  Search(const ModalStart& start, const Assigned& assigned, const ModalFitOptions& options,
         ModalFit& fit)
      : start_(start), assigned_(assigned), options_(options), fit_(fit) {}

  /// Moves the vector of the fit to the least cost of the stage.
  void Run(const StageSetup& setup);
  /// Cost of the stage at any vector.
  [[nodiscard]] double CostAt(const Eigen::VectorXd& vector, const StageSetup& setup) const;
  /// J^T J, its likeness from the residuals and the sum of squares of the data at the optimum.
  void Inform(const StageSetup& setup);

 private:
  [[nodiscard]] std::vector<std::size_t> Lines(const FrequencyResponse& data,
                                               std::size_t stride) const;
  [[nodiscard]] LineResiduals Residuals(const FitData& data, std::size_t line, LineKind kind) const;
  [[nodiscard]] std::vector<LineResiduals> AllLines(const StageSetup& setup) const;

  const ModalStart& start_;
  const Assigned& assigned_;
  const ModalFitOptions& options_;
  ModalFit& fit_;
};

}  // namespace levitas::identification
