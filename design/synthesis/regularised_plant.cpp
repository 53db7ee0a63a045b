#include "design/synthesis/regularised_plant.hpp"

#include <cmath>
#include <stdexcept>

namespace levitas::synthesis {

GeneralisedPlant Regularised(const GeneralisedPlant& plant, double weight) {
  if (!(weight > 0.0) || !std::isfinite(weight)) {
    throw std::invalid_argument("a regularising weight must be above zero");
  }
  CheckShapes(plant.system);
  const StateSpace& from = plant.system;
  const Eigen::Index n = from.states();
  const Eigen::Index w = plant.disturbances();
  const Eigen::Index z = plant.errors();
  const Eigen::Index u = plant.controls;
  const Eigen::Index y = plant.measurements;
  GeneralisedPlant to{
      {from.A, Eigen::MatrixXd::Zero(n, w + y + u), Eigen::MatrixXd::Zero(z + u + y, n),
       Eigen::MatrixXd::Zero(z + u + y, w + y + u)},
      u,
      y};
  to.system.B.leftCols(w) = from.B.leftCols(w);
  to.system.B.rightCols(u) = from.B.rightCols(u);
  to.system.C.topRows(z) = from.C.topRows(z);
  to.system.C.bottomRows(y) = from.C.bottomRows(y);
  Eigen::MatrixXd& D = to.system.D;
  D.topLeftCorner(z, w) = from.D.topLeftCorner(z, w);
  D.topRightCorner(z, u) = from.D.topRightCorner(z, u);
  D.bottomLeftCorner(y, w) = from.D.bottomLeftCorner(y, w);
  D.bottomRightCorner(y, u) = from.D.bottomRightCorner(y, u);
  D.block(z, w + y, u, u).diagonal().setConstant(weight);
  D.block(z + u, w, y, y).diagonal().setConstant(weight);
  return to;
}

}  // namespace levitas::synthesis
