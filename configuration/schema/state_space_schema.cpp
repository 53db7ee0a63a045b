// Table of the state-space law of a controller file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "configuration/schema/schema.hpp"
#include "controller/law/hidden_states.hpp"

namespace levitas::configuration {
namespace {

using namespace unit;

constexpr double kLargest = 1e12;  // of a coefficient: rubbish is found, no law is refused

/// What a block has to do with one channel: a row of B, or a column of C.
struct Coupling {
  std::size_t axis{};
  double first{};
  double second{};
};

void DescribeCouplings(Visitor& v, const ListField& field, const RigNumbers& rig, bool pair,
                       AxisArray& first, AxisArray& second) {
  std::vector<Coupling> couplings;
  for (std::size_t i = 0; i < rig.axes(); ++i) {
    if (first[i] != 0.0 || second[i] != 0.0) couplings.push_back({i, first[i], second[i]});
  }
  first = second = {};
  v.List(field, couplings, [&](Coupling& coupling, std::size_t) {
    DescribeAxis(v, "channel", "axis of the rig", rig, coupling.axis);
    v.Number({"first", kOne, -kLargest, kLargest, kRequired, "coefficient of the first state"},
             coupling.first);
    v.Number({"second", kOne, -kLargest, kLargest, 0, "coefficient of the second state"},
             coupling.second);
    v.RefuseIf(!pair && coupling.second != 0.0, "second",
               "a block with a real pole has one state only");
    v.RefuseIf(first[coupling.axis] != 0.0 || second[coupling.axis] != 0.0, "channel",
               "this channel has been given already");
    first[coupling.axis] = coupling.first;
    second[coupling.axis] = coupling.second;
  });
}

void DescribeBlock(Visitor& v, law::ModalBlock& block, bool discrete, const RigNumbers& rig) {
  double decay_1_per_s = -block.pole_real;
  v.When(!discrete, "with time: continuous", [&] {
    v.Number({"decay", kPerSecond, -1e6, 1e6, kRequired, "s of the poles -s + j w and -s - j w"},
             decay_1_per_s);
    v.Number({"turning", kRadPerSecond, 0, 1e6, 0, "w of the poles; 0: one state, a real pole"},
             block.pole_imaginary);
    block.pole_real = -decay_1_per_s;
  });
  v.When(discrete, "with time: discrete", [&] {
    v.Number({"pole_real", kOne, -1, 1, kRequired, "real part of the poles in z"}, block.pole_real);
    v.Number({"pole_imaginary", kOne, 0, 1, 0, "imaginary part; 0: one state, a real pole"},
             block.pole_imaginary);
  });
  const bool pair = block.pole_imaginary != 0.0;
  DescribeCouplings(v, {"inputs", 0, kMaxAxes, "what drives the block (a row of B each)"}, rig,
                    pair, block.first_input, block.second_input);
  DescribeCouplings(v, {"outputs", 0, kMaxAxes, "what the block drives (a column of C each)"}, rig,
                    pair, block.first_output, block.second_output);
}

// A growing state must be seen by the currents and reached by the sensors: no feedback holds it
// else.
void RefuseHiddenGrowth(Visitor& v, const law::StateSpaceConfig& law) {
  for (const law::GrowingBlock& growing : law::GrowingBlocks(law)) {
    if (growing.seen && growing.reached) continue;
    const law::ModalBlock& block = law.blocks[growing.block];
    const double hz = block.pole_imaginary / (2.0 * static_cast<double>(kPi));
    const std::string pole =
        law.discrete ? fmt::format("a pole at {:.6g} in z",
                                   std::hypot(block.pole_real, block.pole_imaginary))
                     : fmt::format("a pole at {:+.6g} 1/s and {:.6g} Hz", block.pole_real, hz);
    v.RefuseIf(
        true, fmt::format("blocks[{}]", growing.block),
        fmt::format("{} does not decay, and {}; without feedback it grows until the currents "
                    "are no numbers. Give it {} of its own, or leave the block out",
                    pole, growing.seen ? "no position drives it" : "no current shows it",
                    growing.seen ? "inputs" : "outputs"));
  }
}

struct Direct {
  std::size_t output{};
  std::size_t input{};
  double gain{};
};

void DescribeDirect(Visitor& v, law::StateSpaceConfig& law, const RigNumbers& rig) {
  std::vector<Direct> entries;
  for (std::size_t i = 0; i < rig.axes(); ++i) {
    for (std::size_t j = 0; j < rig.axes(); ++j) {
      if (law.direct[i][j] != 0.0) entries.push_back({i, j, law.direct[i][j]});
    }
  }
  law.direct = {};
  v.List({"direct", 0, kMaxAxes * kMaxAxes, "what passes at once (an element of D each)"}, entries,
         [&](Direct& entry, std::size_t) {
           DescribeAxis(v, "output", "axis driven", rig, entry.output);
           DescribeAxis(v, "input", "axis read", rig, entry.input);
           v.Number({"gain", kOne, -kLargest, kLargest, kRequired, "of this path"}, entry.gain);
           double& element = law.direct[entry.output][entry.input];
           v.RefuseIf(element != 0.0, "input", "this path has been given already");
           element = entry.gain;
         });
}

}  // namespace

void Describe(Visitor& v, law::StateSpaceConfig& law, const RigNumbers& rig) {
  law.axes = rig.axes();
  constexpr std::array<std::string_view, 2> kTimes{"continuous", "discrete"};
  std::size_t time = law.discrete ? 1 : 0;
  v.Choice({"time", kTimes, "continuous",
            "continuous: poles in s, discretised by zero-order hold; discrete: poles in z"},
           time);
  law.discrete = time == 1;
  v.Group("signals", "scale of each axis of the rig", [&] {
    for (std::size_t i = 0; i < rig.axes(); ++i) {
      v.Group(rig.channels[i], "law of this axis: current = output x law(input x position)", [&] {
        v.Number({"input", kVoltPerMillimetre, 1e-6, 1e6, kRequired,
                  "signal that the law was made for, per displacement"},
                 law.input_v_per_m[i]);
        v.Number({"output", kAmperePerVolt, 1e-6, 1e6, kRequired,
                  "control current per output of the law"},
                 law.output_a_per_v[i]);
      });
    }
  });
  v.List({"blocks", 0, law::StateSpaceConfig::kMaxStates,
          "states that stand alone, one or two: w' = [-s w; -w -s] w + B v"},
         law.blocks,
         [&](law::ModalBlock& block, std::size_t) { DescribeBlock(v, block, law.discrete, rig); });
  v.RefuseIf(law.states() > law::StateSpaceConfig::kMaxStates, "blocks",
             fmt::format("found {} states, allowed 0 to {}", law.states(),
                         law::StateSpaceConfig::kMaxStates));
  DescribeDirect(v, law, rig);
  RefuseHiddenGrowth(v, law);
}

}  // namespace levitas::configuration
