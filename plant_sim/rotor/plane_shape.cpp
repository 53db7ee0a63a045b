#include "plant_sim/rotor/plane_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace levitas::rotor {
namespace {

constexpr double kSamePlace = 1e-9;  // as ModalRotor::ShapeAt

/// The piece of shaft that holds z, and where in it.
struct Piece {
  Eigen::Index first;
  double length_m;
  double share;
};

Piece Find(const ModalRotor& rotor, double z_m) {
  const auto& nodes = rotor.node_z_m;
  if (!(z_m >= nodes.front() - kSamePlace && z_m <= nodes.back() + kSamePlace)) {
    throw std::invalid_argument(fmt::format("rotor: z = {} m is not on the shaft, allowed {} to {}",
                                            z_m, nodes.front(), nodes.back()));
  }
  if (nodes.size() < 2) {
    throw std::invalid_argument("rotor: one plane only, so no shape between planes");
  }
  auto next = std::lower_bound(nodes.begin() + 1, nodes.end() - 1, z_m - kSamePlace);
  const double start_m = *(next - 1);
  const double length_m = *next - start_m;
  return {(next - 1) - nodes.begin(), length_m, std::clamp((z_m - start_m) / length_m, 0.0, 1.0)};
}

// Weights of deflection and slope at the first node, then at the second.
std::vector<double> Combine(const ModalRotor& rotor, const Piece& at,
                            const std::array<double, 4>& weight) {
  const Eigen::RowVectorXd row =
      weight[0] * rotor.shapes.row(at.first) + weight[1] * rotor.slopes.row(at.first) +
      weight[2] * rotor.shapes.row(at.first + 1) + weight[3] * rotor.slopes.row(at.first + 1);
  return {row.data(), row.data() + row.size()};
}

}  // namespace

std::vector<double> DeflectionAt(const ModalRotor& rotor, double z_m) {
  for (std::size_t node = 0; node < rotor.node_z_m.size(); ++node) {
    if (std::abs(rotor.node_z_m[node] - z_m) > kSamePlace) continue;
    const Eigen::RowVectorXd row = rotor.shapes.row(static_cast<Eigen::Index>(node));
    return {row.data(), row.data() + row.size()};
  }
  const Piece at = Find(rotor, z_m);
  const double t = at.share;
  const double h = at.length_m;
  return Combine(rotor, at,
                 {1.0 - t * t * (3.0 - 2.0 * t), h * t * (1.0 - t) * (1.0 - t),
                  t * t * (3.0 - 2.0 * t), -h * t * t * (1.0 - t)});
}

std::vector<double> CurvatureAt(const ModalRotor& rotor, double z_m) {
  const Piece at = Find(rotor, z_m);
  const double t = at.share;
  const double h = at.length_m;
  return Combine(rotor, at,
                 {(12.0 * t - 6.0) / (h * h), (6.0 * t - 4.0) / h, (6.0 - 12.0 * t) / (h * h),
                  (6.0 * t - 2.0) / h});
}

}  // namespace levitas::rotor
