// Controllers recovered from what they were given and made of it.
#include "identification/law/law_fit.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "common/problem.hpp"
#include "common/random.hpp"
#include "configuration/rig_file.hpp"
#include "controller/law/state_space_law.hpp"
#include "tests/support/paths.hpp"

namespace levitas::identification {
namespace {

using Complex = std::complex<double>;

const configuration::RigFile& Pump() {
  static const configuration::RigFile rig =
      configuration::LoadRig(test::SourceFolder() + "/config/rigs/turbomolecular_pump.yaml");
  return rig;
}

/// The four controllers of the pump that a publication gives.
const law::StateSpaceConfig& Published() {
  static const law::StateSpaceConfig law =
      *configuration::LoadController(
           test::SourceFolder() + "/config/controllers/turbomolecular_pump.yaml", Pump().numbers)
           .law.state_space;
  return law;
}

/// Output per input at zeta of the part of a law from an axis to itself.
Complex ResponseOf(const law::StateSpaceConfig& law, std::size_t axis, Complex zeta) {
  Complex sum = law.direct[axis][axis];
  for (const law::ModalBlock& block : law.blocks) {
    const Complex b(block.first_input[axis], block.second_input[axis]);
    if (block.pole_imaginary == 0.0) {
      sum += block.first_output[axis] * b.real() / (zeta - block.pole_real);
      continue;
    }
    // w = first + j second, w' = (re - j im) w + b v, and the same of the conjugate.
    const Complex c = 0.5 * Complex(block.first_output[axis], -block.second_output[axis]);
    const Complex p(block.pole_real, -block.pole_imaginary);
    sum += c * b / (zeta - p) + std::conj(c * b) / (zeta - std::conj(p));
  }
  return sum;
}

/// Logarithmic chirp from 1 to 5000 Hz in 10 s, sampled at 50 kHz: the publication's signal.
constexpr double kRateHz = 50000.0;
constexpr double kSeconds = 10.0;
constexpr double kFromHz = 1.0;
constexpr double kToHz = 5000.0;

/// Instants of the simulation per sample of the record: between them the chirp is taken as
/// straight, which is wrong by 8e-4 at 5 kHz.
constexpr Eigen::Index kFiner = 8;

const Eigen::VectorXd& FineChirp() {
  static const Eigen::VectorXd chirp = [] {
    Eigen::VectorXd out(static_cast<Eigen::Index>(kRateHz * kSeconds) * kFiner);
    const double rate = std::log(kToHz / kFromHz) / kSeconds;
    for (Eigen::Index k = 0; k < out.size(); ++k) {
      const double t = static_cast<double>(k) / (kRateHz * static_cast<double>(kFiner));
      out[k] = std::sin(2.0 * std::numbers::pi * kFromHz * std::expm1(rate * t) / rate);
    }
    return out;
  }();
  return chirp;
}

Eigen::VectorXd Chirp() {
  return FineChirp()(Eigen::seqN(Eigen::Index{0}, FineChirp().size() / kFiner, kFiner));
}

/// What an analogue axis makes of the chirp.
Eigen::VectorXd Analogue(const law::StateSpaceConfig& law, std::size_t axis) {
  constexpr double kStepS = 1.0 / (kRateHz * static_cast<double>(kFiner));
  const Eigen::VectorXd& chirp = FineChirp();
  Eigen::VectorXd output = law.direct[axis][axis] * Chirp();
  for (const law::ModalBlock& block : law.blocks) {
    const Complex b(block.first_input[axis], block.second_input[axis]);
    const Complex c(block.first_output[axis], -block.second_output[axis]);
    const Complex p(block.pole_real, -block.pole_imaginary);
    if (b == Complex{} || c == Complex{}) continue;
    const Complex step = std::exp(p * kStepS);
    const Complex held = b * (step - 1.0) / p;                  // of the value before
    const Complex rising = (held - b * kStepS) / (p * kStepS);  // of the difference to the next
    Complex w = 0.0;
    for (Eigen::Index k = 0; k < chirp.size(); ++k) {
      if (k % kFiner == 0) output[k / kFiner] += (c * w).real();
      if (k + 1 < chirp.size()) w = step * w + held * chirp[k] + rising * (chirp[k + 1] - chirp[k]);
    }
  }
  return output;
}

/// The law run sample by sample as the loop runs it.
Eigen::VectorXd Sampled(const law::StateSpaceConfig& law, std::size_t axis,
                        const Eigen::VectorXd& input) {
  Eigen::VectorXd output = law.direct[axis][axis] * input;
  for (const law::ModalBlock& block : law.blocks) {
    double first = 0.0;
    double second = 0.0;
    for (Eigen::Index k = 0; k < input.size(); ++k) {
      output[k] += block.first_output[axis] * first + block.second_output[axis] * second;
      const double next = block.pole_real * first + block.pole_imaginary * second +
                          block.first_input[axis] * input[k];
      second = -block.pole_imaginary * first + block.pole_real * second +
               block.second_input[axis] * input[k];
      first = next;
    }
  }
  return output;
}

void AddNoise(double rms, std::uint64_t seed, Eigen::VectorXd& column) {
  Random random(seed);
  for (double& value : column) value += rms * random.Normal();
}

double WorstShare(const law::StateSpaceConfig& found, const law::StateSpaceConfig& truth,
                  std::size_t axis) {
  double worst = 0.0;
  for (double f = 5.0; f < 3000.0; f *= 1.02) {
    const Complex jw(0.0, 2.0 * std::numbers::pi * f);
    const Complex exact = ResponseOf(truth, axis, jw);
    worst = std::max(worst, std::abs(ResponseOf(found, axis, jw) - exact) / std::abs(exact));
  }
  return worst;
}

TEST(LawFit, RecoversTheFourPublishedPumpControllersFromNoisyChirpsToOnePercent) {
  const Eigen::VectorXd chirp = Chirp();
  const std::vector<std::string> names{"ux", "uy", "lx", "ly"};
  for (std::size_t axis = 0; axis < names.size(); ++axis) {
    LawSignals signals{names[axis], chirp, Analogue(Published(), axis)};
    const double rms = std::sqrt(signals.output.squaredNorm() / static_cast<double>(chirp.size()));
    AddNoise(0.01 * rms, 20261126 + axis, signals.output);
    const LawFit fit = FitLaw(signals, {.period_s = 1.0 / kRateHz, .highest_hz = kToHz});
    EXPECT_EQ(fit.law.order(), 4U) << names[axis];
    law::StateSpaceConfig law;
    law.axes = 4;
    AddToLaw(fit, axis, 1.0, law);
    EXPECT_LT(WorstShare(law, Published(), axis), 0.01) << names[axis];
  }
}

TEST(LawFit, OfALawAtItsOwnRateIsExactInClosedLoopToo) {
  const law::StateSpaceConfig law = law::DiscretiseBlocks(Published(), 50e-6);
  constexpr std::size_t kAxis = 2;
  // The input is fed back from the output, and never at rest.
  Random random(7);
  Eigen::VectorXd input(40000);
  for (double& value : input) value = random.Normal();
  const Eigen::VectorXd first = Sampled(law, kAxis, input);
  for (Eigen::Index k = 1; k < input.size(); ++k) input[k] -= 0.3 * first[k - 1];
  const LawSignals signals{"lx", input, Sampled(law, kAxis, input)};
  const LawFit fit = FitLaw(signals, {.domain = LawDomain::kDiscrete, .period_s = 50e-6});
  EXPECT_EQ(fit.law.order(), 4U);
  for (const double f : {3.0, 100.0, 560.0, 4000.0, 9000.0}) {
    const Complex z = std::polar(1.0, 2.0 * std::numbers::pi * f * 50e-6);
    const Complex exact = ResponseOf(law, kAxis, z);
    EXPECT_LT(std::abs(fit.At(f) - exact), 1e-6 * std::abs(exact)) << f;
  }
}

TEST(LawFit, WithoutWhatTheLawHoldsAtTheEndsWouldLeak) {
  // A slow pole that is far from rest at the first row: half of the output is its decay.
  law::StateSpaceConfig law;
  law.axes = 1;
  law::ModalBlock slow;
  slow.pole_real = 0.9995;
  slow.first_input[0] = 1.0;
  slow.first_output[0] = 0.01;
  law.blocks = {slow};
  law.direct[0][0] = 0.5;
  Random random(3);
  Eigen::VectorXd input(6000);
  for (Eigen::Index k = 0; k < input.size(); ++k)
    input[k] = random.Normal() + (k < 2000 ? 3.0 : 0.0);
  const Eigen::VectorXd output = Sampled(law, 0, input);
  const LawSignals late{"late", input.tail(4000), output.tail(4000)};
  const LawFit fit = FitLaw(late, {.domain = LawDomain::kDiscrete, .period_s = 1e-4});
  ASSERT_EQ(fit.law.order(), 1U);
  EXPECT_NEAR(fit.law.poles[0].place.real(), 0.9995, 1e-8);
}

TEST(LawFit, IsWrittenAndReadAgainAsTheLawThatWasFound) {
  const law::StateSpaceConfig truth = law::DiscretiseBlocks(Published(), 50e-6);
  Random random(11);
  Eigen::VectorXd input(20000);
  for (double& value : input) value = random.Normal();
  configuration::ControllerFile file = configuration::LoadController(
      test::SourceFolder() + "/config/controllers/turbomolecular_pump.yaml", Pump().numbers);
  law::StateSpaceConfig law = truth;
  law.blocks.clear();
  for (std::size_t axis = 0; axis < 4; ++axis) {
    const LawSignals signals{"a", input, Sampled(truth, axis, input)};
    AddToLaw(FitLaw(signals, {.domain = LawDomain::kDiscrete, .period_s = 50e-6}), axis, 1.0, law);
  }
  file.law.state_space = law;
  const auto read = configuration::ParseController(
      configuration::WriteController(file, Pump().numbers), "c.yaml", Pump().numbers);
  for (std::size_t axis = 0; axis < 4; ++axis) {
    const Complex z = std::polar(1.0, 0.05);
    EXPECT_LT(std::abs(ResponseOf(*read.law.state_space, axis, z) - ResponseOf(truth, axis, z)),
              1e-5 * std::abs(ResponseOf(truth, axis, z)));
  }
}

TEST(LawFit, RefusesWhatNoLawComesOf) {
  const auto problem = [](const Eigen::VectorXd& input, const Eigen::VectorXd& output) {
    try {
      (void)FitLaw({"ux", input, output}, {.period_s = 1e-4});
    } catch (const BadInput& bad) {
      return std::string(bad.what());
    }
    return std::string("accepted");
  };
  const Eigen::VectorXd moving = Eigen::VectorXd::Random(1000);
  EXPECT_THAT(problem(moving, Eigen::VectorXd::Zero(1000)), testing::HasSubstr("output never"));
  EXPECT_THAT(problem(moving.head(50), moving.head(50)), testing::HasSubstr("50 rows, needed"));
  Eigen::VectorXd broken = moving;
  broken[7] = std::nan("");
  EXPECT_THAT(problem(broken, moving), testing::HasSubstr("no numbers"));
}

}  // namespace
}  // namespace levitas::identification
