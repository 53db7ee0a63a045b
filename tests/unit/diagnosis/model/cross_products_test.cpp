// Sums of products of columns against the plain ones.

#include "diagnosis/model/cross_products.hpp"

#include <gtest/gtest.h>

#include "common/random.hpp"

namespace levitas::diagnosis {
namespace {

Eigen::MatrixXd NoiseColumns(std::uint64_t seed, Eigen::Index count) {
  Random random(seed);
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(kProductRows), count);
  for (double& value : columns.reshaped()) value = random.Normal();
  return columns;
}

/// Largest departure of the lower triangle.
double Apart(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    for (Eigen::Index k = 0; k <= i; ++k) largest = std::max(largest, std::abs(a(i, k) - b(i, k)));
  }
  return largest;
}

// Sums of 256 products of order one, in another order: 256 eps at the most.
constexpr double kRounding = 1e-12;

TEST(CrossProducts, AreThoseOfEveryPairOfColumns) {
  for (const Eigen::Index count : {4, 8, 12, 20}) {
    const Eigen::MatrixXd columns = NoiseColumns(3, count);
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(count, count);
    AddCrossProducts(columns, sum);
    EXPECT_LT(Apart(sum, columns.transpose() * columns), kRounding) << count << " columns";
  }
}

TEST(CrossProducts, AreAddedToWhatIsThere) {
  const Eigen::MatrixXd first = NoiseColumns(4, 8);
  const Eigen::MatrixXd second = NoiseColumns(5, 8);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(8, 8);
  AddCrossProducts(first, sum);
  AddCrossProducts(second, sum);
  EXPECT_LT(Apart(sum, first.transpose() * first + second.transpose() * second), kRounding);
}

}  // namespace
}  // namespace levitas::diagnosis
