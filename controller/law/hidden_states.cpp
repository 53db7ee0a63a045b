#include "controller/law/hidden_states.hpp"

#include <array>
#include <cmath>
#include <complex>

namespace levitas::law {
namespace {

constexpr double kSamePole = 1e-9;  // of the pole's size: printed with nine digits or more

using Column = std::array<std::complex<double>, kMaxAxes>;

bool Grows(const ModalBlock& block, bool discrete) {
  if (!discrete) return block.pole_real >= 0.0;
  return std::hypot(block.pole_real, block.pole_imaginary) >= 1.0 - kOnCircle;
}

bool SamePole(const ModalBlock& a, const ModalBlock& b) {
  const double size = std::hypot(a.pole_real, a.pole_imaginary);
  const double apart = std::hypot(a.pole_real - b.pole_real, a.pole_imaginary - b.pole_imaginary);
  return apart <= kSamePole * size;
}

// [re im; -im re] has the eigenvector (1, j) for the pole re + j im, and (1, -j) on the left.
Column Complex(const AxisArray& first, const AxisArray& second) {
  Column column{};
  for (std::size_t i = 0; i < kMaxAxes; ++i) column[i] = {first[i], second[i]};
  return column;
}

double Length(const Column& column) {
  double square = 0.0;
  for (const auto& value : column) square += std::norm(value);
  return std::sqrt(square);
}

/// Takes out of `column` what `unit` (of length 1) says already.
void Subtract(Column& column, const Column& unit) {
  std::complex<double> along{};
  for (std::size_t i = 0; i < kMaxAxes; ++i) along += std::conj(unit[i]) * column[i];
  for (std::size_t i = 0; i < kMaxAxes; ++i) column[i] -= along * unit[i];
}

/// Whether `column` says something that `said` does not; then it is added to it.
bool Adds(Column column, std::vector<Column>& said) {
  const double whole = Length(column);
  for (const Column& unit : said) Subtract(column, unit);
  const double left = Length(column);
  if (!(left > kDependent * whole)) return false;
  for (auto& value : column) value /= left;
  said.push_back(column);
  return true;
}

}  // namespace

std::vector<GrowingBlock> GrowingBlocks(const StateSpaceConfig& config) {
  std::vector<GrowingBlock> found;
  for (std::size_t k = 0; k < config.blocks.size(); ++k) {
    const ModalBlock& block = config.blocks[k];
    if (!Grows(block, config.discrete)) continue;
    std::vector<Column> outputs;
    std::vector<Column> inputs;
    for (std::size_t before = 0; before < k; ++before) {
      const ModalBlock& other = config.blocks[before];
      if (!SamePole(block, other)) continue;
      (void)Adds(Complex(other.first_output, other.second_output), outputs);
      (void)Adds(Complex(other.first_input, other.second_input), inputs);
    }
    found.push_back({k, Adds(Complex(block.first_output, block.second_output), outputs),
                     Adds(Complex(block.first_input, block.second_input), inputs)});
  }
  return found;
}

}  // namespace levitas::law
