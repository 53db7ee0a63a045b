#include "analysis/sampled_loop.hpp"
#include "controller/law/state_space_law.hpp"

namespace levitas::analysis {
namespace {

using Index = Eigen::Index;

/// Rows of B and columns of C of one block, signal scales and the loop's minus sign included.
struct Ports {
  Eigen::Matrix<double, 2, Eigen::Dynamic> in;
  Eigen::Matrix<double, Eigen::Dynamic, 2> out;
};

Ports PortsOf(const law::StateSpaceConfig& law, const law::ModalBlock& block) {
  const auto axes = static_cast<Index>(law.axes);
  Ports ports{Eigen::MatrixXd::Zero(2, axes), Eigen::MatrixXd::Zero(axes, 2)};
  for (std::size_t i = 0; i < law.axes; ++i) {
    const auto at = static_cast<Index>(i);
    ports.in(0, at) = block.first_input[i] * law.input_v_per_m[i];
    ports.in(1, at) = block.second_input[i] * law.input_v_per_m[i];
    ports.out(at, 0) = -law.output_a_per_v[i] * block.first_output[i];
    ports.out(at, 1) = -law.output_a_per_v[i] * block.second_output[i];
  }
  return ports;
}

}  // namespace

CoupledModel ModelOf(const law::StateSpaceConfig& law, double period_s) {
  CoupledModel model;
  model.blocks = law::DiscretiseBlocks(law, period_s);
  const auto axes = static_cast<Index>(law.axes);
  const auto order = static_cast<Index>(law.states());
  model.a = Eigen::MatrixXd::Zero(order, order);
  model.b = Eigen::MatrixXd::Zero(order, axes);
  model.c = Eigen::MatrixXd::Zero(axes, order);
  model.d = Eigen::MatrixXd::Zero(axes, axes);
  Index at = 0;
  for (const law::ModalBlock& block : model.blocks.blocks) {
    const Index size = block.pole_imaginary == 0.0 ? 1 : 2;
    Eigen::Matrix2d a;
    a << block.pole_real, block.pole_imaginary, -block.pole_imaginary, block.pole_real;
    const Ports ports = PortsOf(law, block);
    model.a.block(at, at, size, size) = a.topLeftCorner(size, size);
    model.b.middleRows(at, size) = ports.in.topRows(size);
    model.c.middleCols(at, size) = ports.out.leftCols(size);
    at += size;
  }
  for (std::size_t i = 0; i < law.axes; ++i) {
    for (std::size_t j = 0; j < law.axes; ++j) {
      model.d(static_cast<Index>(i), static_cast<Index>(j)) =
          -law.output_a_per_v[i] * law.direct[i][j] * law.input_v_per_m[j];
    }
  }
  return model;
}

Eigen::MatrixXcd CoupledModel::At(std::complex<double> z) const {
  Eigen::MatrixXcd value = d.cast<std::complex<double>>();
  for (const law::ModalBlock& block : blocks.blocks) {
    const Ports ports = PortsOf(blocks, block);
    const std::complex<double> p = z - block.pole_real;
    const double q = block.pole_imaginary;
    if (q == 0.0) {
      value += (ports.out.col(0) * ports.in.row(0)).cast<std::complex<double>>() / p;
      continue;
    }
    Eigen::Matrix2cd inverse;  // of z I - [re im; -im re]
    inverse << p, q, -q, p;
    value += ports.out.cast<std::complex<double>>() * (inverse / (p * p + q * q)) *
             ports.in.cast<std::complex<double>>();
  }
  return value;
}

}  // namespace levitas::analysis
