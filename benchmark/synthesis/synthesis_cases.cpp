// Plants and matrices with the library's gamma, norm and mu, as JSON on stdout, for an independent
// implementation to repeat: slycot_peer.py beside this file.

#include <fmt/core.h>

#include <Eigen/Dense>
#include <nlohmann/json.hpp>

#include "design/synthesis/hinf_norm.hpp"
#include "design/synthesis/hinf_synthesis.hpp"
#include "design/synthesis/structured_singular_value.hpp"
#include "plants.hpp"

namespace levitas::synthesis {
namespace {

using Json = nlohmann::ordered_json;

Json Rows(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(matrix(i, j));
    rows.push_back(std::move(row));
  }
  return rows;
}

Json Matrices(const StateSpace& system) {
  return {
      {"A", Rows(system.A)}, {"B", Rows(system.B)}, {"C", Rows(system.C)}, {"D", Rows(system.D)}};
}

Json PlantCase(const std::string& name, const GeneralisedPlant& plant) {
  const HinfController made = Synthesise(plant, {.tolerance = 1e-4, .relaxation = 1.001});
  return {{"name", name},
          {"plant", Matrices(plant.system)},
          {"controls", plant.controls},
          {"measurements", plant.measurements},
          {"controller", Matrices(made.controller)},
          {"gamma", made.gamma},
          {"limit", made.limit}};
}

Json MuCase(Random& random, const UncertaintyBlocks& blocks) {
  Eigen::Index size = 0;
  Json sizes = Json::array();
  Json types = Json::array();
  for (const auto& block : blocks) {
    size += block.rows;
    sizes.push_back(block.rows);
    types.push_back(block.kind == BlockKind::kRepeatedReal ? 1 : 2);  // as SLICOT counts them
  }
  const Eigen::MatrixXd real = DrawMatrix(random, size, size);
  const Eigen::MatrixXd imaginary = DrawMatrix(random, size, size);
  const Eigen::MatrixXcd M = real + std::complex<double>(0.0, 1.0) * imaginary;
  return {{"real", Rows(real)},
          {"imaginary", Rows(imaginary)},
          {"sizes", sizes},
          {"types", types},
          {"upper", MuUpperBound(M, blocks).value},
          {"lower", MuLowerBound(M, blocks)}};
}

Json Cases() {
  constexpr UncertaintyBlock kReal{BlockKind::kRepeatedReal, 1, 1};
  constexpr UncertaintyBlock kScalar{BlockKind::kFullComplex, 1, 1};
  constexpr UncertaintyBlock kTwo{BlockKind::kFullComplex, 2, 2};
  Json out;
  out["plants"].push_back(PlantCase("first order", ScalarPlant(1.0)));
  out["plants"].push_back(PlantCase("flexible axis with delay", FlexibleAxis()));
  Random random(20261201);
  for (int trial = 0; trial < 20; ++trial)
    out["plants"].push_back(
        PlantCase(fmt::format("drawn {}", trial), DrawPlant(random, 2 + trial % 9)));
  for (int trial = 0; trial < 10; ++trial) {
    out["mu"].push_back(MuCase(random, UncertaintyBlocks(5, kScalar)));
    out["mu"].push_back(MuCase(random, {kTwo, kTwo, kScalar, kTwo}));
    out["mu"].push_back(MuCase(random, {kReal, kReal, kTwo}));
    out["mu"].push_back(MuCase(random, {kReal, kReal, kReal, kScalar, kScalar, kTwo}));
  }
  return out;
}

}  // namespace
}  // namespace levitas::synthesis

int main() {
  fmt::print("{}\n", levitas::synthesis::Cases().dump());
  return 0;
}
