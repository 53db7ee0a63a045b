#include "identification/nonlinear/narx.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <random>

#include "numerics/dense/factorisations.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

/// Units offered to FROLS for each one that is kept.
constexpr std::size_t kUnitsOffered = 8;
/// Ridge of the least squares against collinear lags, relative to the mean of the diagonal.
constexpr double kRidge = 1e-13;

struct Scaled {
  Eigen::MatrixXd input, output, error;
};

/// Values of `features` on the rows `from`, `from + stride` ...
Eigen::MatrixXd Design(const LaggedModel& model, const Scaled& data,
                       const std::vector<Feature>& features, Index stride) {
  const Index from = model.layout.Memory();
  const Index rows = (data.output.rows() - from + stride - 1) / stride;
  Eigen::MatrixXd design(rows, static_cast<Index>(features.size()));
  Eigen::VectorXd window(model.layout.size());
  for (Index n = 0; n < rows; ++n) {
    FillWindow(model, data.input, data.output, data.error, from + n * stride, window);
    for (std::size_t j = 0; j < features.size(); ++j) {
      design(n, static_cast<Index>(j)) = features[j].Value(window);
    }
  }
  return design;
}

Eigen::VectorXd Target(const LaggedModel& model, const Scaled& data, Index output, Index stride) {
  const Index from = model.layout.Memory();
  const Index rows = (data.output.rows() - from + stride - 1) / stride;
  Eigen::VectorXd target(rows);
  for (Index n = 0; n < rows; ++n) target[n] = data.output(from + n * stride, output);
  return target;
}

Eigen::VectorXd LeastSquares(const Eigen::MatrixXd& design, const Eigen::VectorXd& target) {
  Eigen::MatrixXd normal = design.transpose() * design;
  normal.diagonal().array() += kRidge * normal.diagonal().mean();
  return normal.ldlt().solve(design.transpose() * target);
}

void AddProducts(Index entries, int degree, Index first, std::vector<Index>& product,
                 std::vector<Feature>& terms) {
  terms.push_back({.factors = product});
  if (degree == 0) return;
  for (Index entry = first; entry < entries; ++entry) {
    product.push_back(entry);
    AddProducts(entries, degree - 1, entry, product, terms);
    product.pop_back();
  }
}

/// tanh units whose argument has a spread between a half and two over the data.
std::vector<Feature> NetworkUnits(const LaggedModel& model, std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Feature> units(count);
  const Index entries = model.layout.error_at();
  for (Feature& unit : units) {
    unit.weights = Eigen::VectorXd::Zero(model.layout.size());
    for (Index i = 0; i < entries; ++i) unit.weights[i] = normal(random);
    unit.weights *=
        std::exp2(2.0 * std::uniform_real_distribution<>(-0.5, 0.5)(random)) / unit.weights.norm();
    unit.bias = normal(random);
  }
  return units;
}

std::vector<Feature> Candidates(const LaggedModel& model, const NarxOptions& options) {
  if (options.network_units == 0) return PolynomialTerms(options.layout, options.degree);
  std::vector<Feature> features = PolynomialTerms(options.layout, 1);
  const auto units = NetworkUnits(model, kUnitsOffered * options.network_units, options.seed);
  features.insert(features.end(), units.begin(), units.end());
  return features;
}

FrolsOptions Selection(const NarxOptions& options) {
  FrolsOptions selection{options.most_terms, options.least_ratio, {}};
  if (options.network_units == 0) return selection;
  const Index linear = 1 + options.layout.error_at();
  for (Index j = 0; j < linear; ++j) selection.compulsory.push_back(j);
  selection.most_terms = static_cast<std::size_t>(linear) + options.network_units;
  return selection;
}

/// Coefficients of the chosen terms on all rows, with the errors' lags among them.
void EstimateAll(const Series& series, const NarxOptions& options, Scaled& data,
                 LaggedModel& model) {
  const WindowLayout& at = model.layout;
  for (std::size_t o = 0; at.error_lags > 0 && o < model.features.size(); ++o) {
    for (Index lag = 0; lag < at.error_lags; ++lag) {
      const Index own = at.error_at() + static_cast<Index>(o) * at.error_lags + lag;
      model.features[o].push_back({.factors = {own}});
    }
    model.theta[o] = Eigen::VectorXd::Zero(static_cast<Index>(model.features[o].size()));
  }
  const int passes = at.error_lags > 0 ? options.passes : 1;
  for (int pass = 0; pass <= passes; ++pass) {
    for (std::size_t o = 0; o < model.features.size(); ++o) {
      std::vector<Feature> used = model.features[o];
      // No errors yet: their lags would be columns of zeros.
      if (pass == 0) used.resize(used.size() - static_cast<std::size_t>(at.error_lags));
      const Eigen::VectorXd theta =
          LeastSquares(Design(model, data, used, 1), Target(model, data, static_cast<Index>(o), 1));
      model.theta[o].setZero(static_cast<Index>(model.features[o].size()));
      model.theta[o].head(theta.size()) = theta;
    }
    if (at.error_lags == 0) return;
    const Prediction before = PredictOneStep(model, series);
    data.error = (series.output - before.output) * model.output_scale.cwiseInverse().asDiagonal();
  }
}

}  // namespace

std::vector<Feature> PolynomialTerms(const WindowLayout& layout, int degree) {
  std::vector<Feature> terms;
  std::vector<Index> product;
  AddProducts(layout.error_at(), degree, 0, product, terms);
  std::ranges::stable_sort(terms, {},
                           [](const Feature& feature) { return feature.factors.size(); });
  return terms;
}

NarxFit FitNarx(const Series& series, const NarxOptions& options) {
  RefuseUnfit(series, options.most_terms + options.network_units);
  NarxFit fit{EmptyModel(options.layout, series), {}};
  LaggedModel& model = fit.model;
  Scaled data{series.input * model.input_scale.cwiseInverse().asDiagonal(),
              series.output * model.output_scale.cwiseInverse().asDiagonal(),
              Eigen::MatrixXd::Zero(series.rows(), series.outputs())};
  const std::vector<Feature> candidates = Candidates(model, options);
  const Index stride = std::max<Index>(1, series.rows() / static_cast<Index>(options.most_rows));
  const Eigen::MatrixXd design = Design(model, data, candidates, stride);
  for (std::size_t o = 0; o < model.features.size(); ++o) {
    const FrolsResult chosen =
        SelectTerms(design, Target(model, data, static_cast<Index>(o), stride), Selection(options));
    for (const Index j : chosen.chosen) {
      model.features[o].push_back(candidates[static_cast<std::size_t>(j)]);
    }
    fit.ratio.push_back(chosen.ratio);
    model.theta[o] = chosen.theta;
  }
  EstimateAll(series, options, data, model);
  return fit;
}

}  // namespace levitas::identification
