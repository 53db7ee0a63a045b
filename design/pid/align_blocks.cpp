#include "design/pid/align_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

namespace levitas::design {
namespace {

using Complex = std::complex<double>;
using law::ModalBlock;

/// Poles of blocks that keep im < 0 are those of im > 0 with the second state turned around.
ModalBlock Upright(ModalBlock block) {
  if (block.pole_imaginary >= 0.0) return block;
  block.pole_imaginary = -block.pole_imaginary;
  for (double& value : block.second_input) value = -value;
  for (double& value : block.second_output) value = -value;
  return block;
}

/// w1 - j w2 of a block [re im; -im re] has the pole re + j im.
Complex Input(const ModalBlock& block, std::size_t axis) {
  return {block.first_input[axis], -block.second_input[axis]};
}

ModalBlock Scaled(const ModalBlock& block, Complex by) {
  ModalBlock out = block;
  for (std::size_t i = 0; i < kMaxAxes; ++i) {
    const Complex input = by * Input(block, i);
    // Output: Re of (c1 + j c2)(w1 - j w2), which must stay as it is.
    const Complex output = Complex(block.first_output[i], block.second_output[i]) / by;
    out.first_input[i] = input.real();
    out.second_input[i] = -input.imag();
    out.first_output[i] = output.real();
    out.second_output[i] = output.imag();
  }
  if (block.pole_imaginary == 0.0) out.second_input = out.second_output = {};
  return out;
}

/// Cosine of the angle between the inputs of two blocks, whatever turn and scale of their states.
double Alike(const ModalBlock& a, const ModalBlock& b) {
  Complex along{};
  double size_a = 0.0;
  double size_b = 0.0;
  for (std::size_t i = 0; i < kMaxAxes; ++i) {
    along += std::conj(Input(a, i)) * Input(b, i);
    size_a += std::norm(Input(a, i));
    size_b += std::norm(Input(b, i));
  }
  if (!(size_a > 0.0) || !(size_b > 0.0)) return 1.0;
  return std::min(std::abs(along) / std::sqrt(size_a * size_b), 1.0);
}

/// How far two blocks are from being the same state: their poles, and where poles are as near, as
/// those of x and y or of all integrators, what they read.
double Distance(const ModalBlock& a, const ModalBlock& b) {
  constexpr double kTurned = 10.0;  // by so much farther seems a pole that reads other axes
  constexpr double kSamePole = 1e-9;
  const double apart = std::hypot(a.pole_real - b.pole_real,
                                  std::abs(a.pole_imaginary) - std::abs(b.pole_imaginary));
  const double unlike = 1.0 - Alike(a, b);
  return apart * (1.0 + kTurned * unlike) + kSamePole * unlike;
}

ModalBlock Aligned(const ModalBlock& reference, const ModalBlock& block) {
  Complex along{};
  double size = 0.0;
  for (std::size_t i = 0; i < kMaxAxes; ++i) {
    along += std::conj(Input(block, i)) * Input(reference, i);
    size += std::norm(Input(block, i));
  }
  if (block.pole_imaginary == 0.0) along = along.real();
  constexpr double kAcross = 1e-6;  // they read nothing in common: there is nothing to align
  if (!(size > 0.0) || Alike(reference, block) < kAcross) return block;
  return Scaled(block, along / size);
}

struct Pair {
  double distance{};
  std::size_t reference{}, other{};
};

}  // namespace

law::StateSpaceConfig AlignBlocks(const law::StateSpaceConfig& reference,
                                  const law::StateSpaceConfig& other) {
  const std::size_t count = reference.blocks.size();
  if (other.blocks.size() != count) return other;
  std::vector<ModalBlock> from;
  for (const ModalBlock& block : other.blocks) from.push_back(Upright(block));
  std::vector<Pair> pairs;
  for (std::size_t r = 0; r < count; ++r) {
    const ModalBlock& to = reference.blocks[r];
    for (std::size_t o = 0; o < count; ++o) {
      if ((to.pole_imaginary == 0.0) != (from[o].pole_imaginary == 0.0)) continue;
      pairs.push_back({Distance(Upright(to), from[o]), r, o});
    }
  }
  std::ranges::stable_sort(pairs, {}, &Pair::distance);
  law::StateSpaceConfig out = other;
  std::vector<bool> filled(count);
  std::vector<bool> taken(count);
  std::size_t done = 0;
  for (const Pair& pair : pairs) {
    if (filled[pair.reference] || taken[pair.other]) continue;
    filled[pair.reference] = taken[pair.other] = true;
    ++done;
    // The reference keeps its sign of im: an entry of a table is aligned to the one before.
    const ModalBlock& to = reference.blocks[pair.reference];
    const bool down = to.pole_imaginary < 0.0;
    ModalBlock block = Aligned(Upright(to), from[pair.other]);
    if (down) {
      block.pole_imaginary = -block.pole_imaginary;
      for (double& value : block.second_input) value = -value;
      for (double& value : block.second_output) value = -value;
    }
    out.blocks[pair.reference] = block;
  }
  return done == count ? out : other;
}

}  // namespace levitas::design
