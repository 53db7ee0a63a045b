#include "diagnosis/model/train_coupling.hpp"

#include "plant_sim/plant/train_linear.hpp"

namespace levitas::diagnosis {
namespace {

using Index = Eigen::Index;

/// Elements along the normal of a mesh and across it, each by its row.
Eigen::MatrixXd MeshMatrix(const plant::PlantModel& model, std::size_t mesh, double normal,
                           double tangential) {
  const gear::Vector& n = model.train().meshes[mesh].law.normal;
  const Eigen::RowVectorXd along = plant::MeshRow(model, mesh, n.x, n.y);
  const Eigen::RowVectorXd across = plant::MeshRow(model, mesh, -n.y, n.x);
  return normal * along.transpose() * along + tangential * across.transpose() * across;
}

}  // namespace

TrainCoupling CouplingOf(const RigView& rig, const LinearChange& change) {
  if (!rig.geared()) return {};
  const plant::PlantModel& model = *rig.model;
  const auto count = static_cast<Index>(model.coordinates());
  const auto size = static_cast<Index>(model.layout().size);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(size, size);
  plant::AddTrain(model, a);
  TrainCoupling out{-a.block(count, 0, count, count), -a.block(count, count, count, count)};
  for (std::size_t m = 0; m < rig.meshes.size(); ++m) {
    const auto linear = gear::Linearise(model.train().meshes[m].law);
    const LinearChange::Mesh& ratio = change.mesh[m];
    out.stiffness += (ratio.stiffness - 1.0) *
                     MeshMatrix(model, m, linear.normal_n_per_m, linear.tangential_n_per_m);
    out.damping += (ratio.damping - 1.0) *
                   MeshMatrix(model, m, linear.normal_n_s_per_m, linear.tangential_n_s_per_m);
  }
  return out;
}

}  // namespace levitas::diagnosis
