#include "plant_sim/plant/train_linear.hpp"

#include "plant_sim/plant/eigen_index.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::plant {
namespace {

using Index = Eigen::Index;

/// A spring and a damper that act on the displacement row * coordinates, by the same row.
void AddElement(const PlantModel& model, const Eigen::RowVectorXd& row, double stiffness,
                double damping, Eigen::MatrixXd& a) {
  const Index count = At(model.coordinates());
  a.block(count, 0, count, count) -= stiffness * row.transpose() * row;
  a.block(count, count, count, count) -= damping * row.transpose() * row;
}

Eigen::RowVectorXd Row(const PlantModel& model, const std::vector<double>& part, Index first) {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(At(model.coordinates()));
  for (std::size_t i = 0; i < part.size(); ++i) row[first + At(i)] = part[i];
  return row;
}

}  // namespace

Eigen::RowVectorXd MeshRow(const PlantModel& model, std::size_t mesh, double x, double y) {
  const MeshModel& m = model.train().meshes[mesh];
  const Index modes = At(model.layout().modes);
  const double along_normal = x * m.law.normal.x + y * m.law.normal.y;
  return x * Row(model, m.shape, 0) + y * Row(model, m.shape, modes) +
         along_normal * Row(model, m.twist, 2 * modes);
}

void AddTrain(const PlantModel& model, Eigen::MatrixXd& a) {
  const TrainModel& train = model.train();
  if (train.shafts == 0) return;
  const Index modes = At(model.layout().modes);
  const Index count = At(model.coordinates());
  const Index twists = At(model.layout().twists);
  const auto& torsion = model.parameters().torsion;
  const auto w = torsion.frequency_rad_per_s.array();
  const Index q = 2 * modes;
  a.block(q, count + q, twists, twists).setIdentity();
  a.block(count + q, q, twists, twists).diagonal() = -w.square();
  a.block(count + q, count + q, twists, twists).diagonal() =
      -2.0 * torsion.damping_ratio.array() * w;
  for (const SupportModel& s : train.supports) {
    AddElement(model, Row(model, s.shape, 0), s.stiffness_x_n_per_m, s.damping_x_n_s_per_m, a);
    AddElement(model, Row(model, s.shape, modes), s.stiffness_y_n_per_m, s.damping_y_n_s_per_m, a);
  }
  for (const TwistDamper& damper : train.dampers) {
    AddElement(model, Row(model, damper.twist, q), 0.0, damper.damping_n_m_s_per_rad, a);
  }
  for (std::size_t m = 0; m < train.meshes.size(); ++m) {
    const gear::Vector& n = train.meshes[m].law.normal;
    const gear::LinearMesh linear = gear::Linearise(train.meshes[m].law);
    AddElement(model, MeshRow(model, m, n.x, n.y), linear.normal_n_per_m, linear.normal_n_s_per_m,
               a);
    AddElement(model, MeshRow(model, m, -n.y, n.x), linear.tangential_n_per_m,
               linear.tangential_n_s_per_m, a);
  }
}

}  // namespace levitas::plant
