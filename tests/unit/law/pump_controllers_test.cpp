// The shipped controllers of the turbomolecular pump against the print: H.-L. Chiu (2022), Appl.
// Sci. 12, 8556. Its text has lost the minus signs; the plus signs are left, so every lost one is a
// minus.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>

#include "configuration/rig_file.hpp"
#include "controller/law/state_space_law.hpp"

namespace levitas::law {
namespace {

using Complex = std::complex<double>;
using Polynomial = std::vector<double>;  // highest power first

Polynomial Product(const Polynomial& a, const Polynomial& b) {
  Polynomial product(a.size() + b.size() - 1, 0.0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) product[i + j] += a[i] * b[j];
  }
  return product;
}

void AddTo(Polynomial& sum, const Polynomial& term) {
  const std::size_t shift = sum.size() - term.size();
  for (std::size_t i = 0; i < term.size(); ++i) sum[shift + i] += term[i];
}

struct Transfer {
  Polynomial numerator, denominator;
};

/// C (x I - A)^-1 B of one block between one axis and itself, x either z or s.
Transfer BlockTransfer(const ModalBlock& block, std::size_t axis) {
  const double re = block.pole_real;
  const double im = block.pole_imaginary;
  const double b1 = block.first_input[axis];
  const double b2 = block.second_input[axis];
  const double c1 = block.first_output[axis];
  const double c2 = block.second_output[axis];
  if (im == 0.0) return {{c1 * b1}, {1.0, -re}};
  const double straight = c1 * b1 + c2 * b2;
  return {{straight, -re * straight + im * (c1 * b2 - c2 * b1)},
          {1.0, -2.0 * re, re * re + im * im}};
}

/// Transfer function of one axis as one fraction.
Transfer AxisTransfer(const StateSpaceConfig& law, std::size_t axis) {
  Transfer whole{{law.direct[axis][axis]}, {1.0}};
  for (const ModalBlock& block : law.blocks) {
    if (block.first_input[axis] == 0.0) continue;
    const Transfer part = BlockTransfer(block, axis);
    whole.numerator = Product(whole.numerator, part.denominator);
    AddTo(whole.numerator, Product(whole.denominator, part.numerator));
    whole.denominator = Product(whole.denominator, part.denominator);
  }
  return whole;
}

Complex At(const Polynomial& polynomial, Complex x) {
  Complex value = 0.0;
  for (const double coefficient : polynomial) value = value * x + coefficient;
  return value;
}

/// C(j w) of the controller as given, before it is discretised.
Complex Response(const StateSpaceConfig& law, std::size_t axis, double frequency_hz) {
  const Transfer transfer = AxisTransfer(law, axis);
  const Complex s{0.0, 2.0 * std::numbers::pi * frequency_hz};
  return At(transfer.numerator, s) / At(transfer.denominator, s);
}

std::string Printed(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

struct Print {
  const char* axis;
  std::array<const char*, 5> numerator;
  std::array<const char*, 5> denominator;
};

constexpr std::array kPrinted{
    Print{"ux",
          {"0.06795", "-0.4431", "0.9146", "-0.7769", "0.2373"},
          {"1", "-3.62", "4.94", "-3.009", "0.6901"}},
    Print{"uy",
          {"0.06957", "-0.452", "0.9319", "-0.7913", "0.2417"},
          {"1", "-3.619", "4.936", "-3.005", "0.6885"}},
    Print{"lx",
          {"0.1937", "-1.048", "1.961", "-1.558", "0.4515"},
          {"1", "-2.987", "3.207", "-1.422", "0.2055"}},
    Print{"ly",
          {"0.1811", "-0.9952", "1.879", "-1.502", "0.437"},
          {"1", "-2.999", "3.238", "-1.45", "0.2138"}},
};

StateSpaceConfig PumpLaw() {
  const auto rig =
      configuration::LoadRig(configuration::FindConfig("turbomolecular_pump", "rigs")).numbers;
  const auto file = configuration::FindConfig("turbomolecular_pump", "controllers");
  return configuration::LoadController(file, rig).law.state_space.value();
}

TEST(PumpControllers, HeldOverTheirPeriodGiveEveryPrintedDigitOfThePrintedTransferFunctions) {
  const StateSpaceConfig discrete = DiscretiseBlocks(PumpLaw(), 50e-6);
  for (std::size_t axis = 0; axis < kPrinted.size(); ++axis) {
    const Transfer transfer = AxisTransfer(discrete, axis);
    ASSERT_EQ(transfer.numerator.size(), 5U);
    ASSERT_EQ(transfer.denominator.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_EQ(Printed(transfer.numerator[i]), kPrinted[axis].numerator[i])
          << kPrinted[axis].axis << " numerator, z^" << 4 - i;
      EXPECT_EQ(Printed(transfer.denominator[i]), kPrinted[axis].denominator[i])
          << kPrinted[axis].axis << " denominator, z^" << 4 - i;
    }
  }
}

// The paper reads -17.1 dB and -180 degrees off its Bode plots: the feedback's minus sign is
// inside.
TEST(PumpControllers, PushBackAtRestWithTheGainOfThePaper) {
  const StateSpaceConfig law = PumpLaw();
  for (std::size_t axis = 0; axis < 4; ++axis) {
    const Complex gain = Response(law, axis, 0.0);
    EXPECT_LT(gain.real(), 0.0);
    EXPECT_EQ(gain.imag(), 0.0);
    EXPECT_NEAR(20.0 * std::log10(std::abs(gain)), -17.1, 0.1);  // one figure given for four
  }
}

TEST(PumpControllers, HaveTheirNotchesWhereThePaperSeesThem) {
  const StateSpaceConfig law = PumpLaw();
  for (std::size_t axis = 0; axis < 4; ++axis) {
    // "around 550 Hz" above, "446 Hz" below: a dip in magnitude between neighbours 100 Hz away.
    const double expected_hz = axis < 2 ? 550.0 : 446.0;
    double dip_hz = 0.0;
    double least = 1e9;
    for (double f = expected_hz - 100.0; f <= expected_hz + 100.0; f += 0.5) {
      const double magnitude = std::abs(Response(law, axis, f));
      if (magnitude < least) {
        least = magnitude;
        dip_hz = f;
      }
    }
    // Zeros of the printed models: 542, 538, 436 and 435 Hz; the paper reads its own off a measured
    // Bode plot, 2.5 % away.
    EXPECT_NEAR(dip_hz, expected_hz, 0.03 * expected_hz) << "axis " << axis;
  }
}

// -180 degrees is the push back itself; 35 degrees more is the lead that damps.
TEST(PumpControllers, UpperXLeadsBy35DegreesAt100Hz) {
  const double lead_rad = std::arg(-Response(PumpLaw(), 0, 100.0));
  EXPECT_NEAR(lead_rad * 180.0 / std::numbers::pi, 35.0, 0.5);  // two figures are given
}

}  // namespace
}  // namespace levitas::law
