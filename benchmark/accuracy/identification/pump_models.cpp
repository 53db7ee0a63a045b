// How well each model predicts the pump's record: see pump_trial.hpp for what is judged.

#include <algorithm>
#include <chrono>
#include <cmath>

#include "benchmark/accuracy/identification/pump_trial.hpp"
#include "identification/nonlinear/known_loop.hpp"
#include "identification/nonlinear/narx.hpp"
#include "identification/nonlinear/refine.hpp"
#include "identification/nonlinear/suspended_rotor_fit.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::accuracy {
namespace {

using namespace identification;
using Index = Eigen::Index;

constexpr double kMost = 1000.0;  // scales: a run that has left stays bounded

/// Free run of a model of lags in the loop, from rest.
Eigen::MatrixXd RunLags(const LaggedModel& model, Index rows, const Feedback& feedback) {
  Eigen::MatrixXd input = Eigen::MatrixXd::Zero(rows, model.layout.inputs);
  Eigen::MatrixXd output = Eigen::MatrixXd::Zero(rows, model.layout.outputs);
  const Eigen::MatrixXd none = output;
  Eigen::VectorXd window(model.layout.size());
  Eigen::VectorXd current_a(model.layout.inputs);
  for (Index k = 0; k < rows; ++k) {
    for (Index o = 0; k >= model.layout.Memory() && o < model.layout.outputs; ++o) {
      if (o == 0) FillWindow(model, input, output, none, k, window);
      const auto& features = model.features[static_cast<std::size_t>(o)];
      double sum = 0.0;
      for (std::size_t f = 0; f < features.size(); ++f) {
        sum += model.theta[static_cast<std::size_t>(o)][static_cast<Index>(f)] *
               features[f].Value(window);
      }
      output(k, o) = std::clamp(sum, -kMost, kMost);
    }
    feedback(k, output.row(k).transpose().cwiseProduct(model.output_scale), current_a);
    input.row(k) = current_a.cwiseQuotient(model.input_scale).transpose();
  }
  return output * model.output_scale.asDiagonal();
}

class Clock {
 public:
  [[nodiscard]] double s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  }

 private:
  std::chrono::steady_clock::time_point began_{std::chrono::steady_clock::now()};
};

}  // namespace

identification::Series PumpTrial::Fitted() const {
  return Slice(record_.series, {0, static_cast<std::size_t>(plan_.fitted)});
}

PumpScore PumpTrial::SuspendedRotor(Index iron) const {
  const KnownLoop loop(controller_.law, rig_.numbers, {record_.excitation_m, {}});
  const Clock clock;
  auto start = DesignOf(plant::Reduce(nominal_.plant), iron);
  for (std::size_t axis = 0; axis < start.sensor.size(); ++axis) {
    start.sensor[axis] = CharacteristicOf(plan_, axis);
  }
  const auto fit = FitSuspendedRotor(start, Fitted(), [&] { return loop.AtRest(); });
  const double time_s = clock.s();
  const auto run = RunFree(fit.model, record_.series.rows(), loop.AtRest());
  return {"suspended rotor", {}, Fit(run.output), {}, time_s};
}

/// The judged rows, from outputs measured so many rows before each.
template <typename Model>
std::vector<Eigen::VectorXd> PumpTrial::Ahead(const Model& model) const {
  std::vector<Eigen::VectorXd> fits;
  fits.reserve(plan_.horizons.size());
  for (const Index steps : plan_.horizons) {
    const Index from = record_.series.rows() - kJudged;
    fits.push_back(Fit(PredictAhead(model, record_.series, steps, from).output));
  }
  return fits;
}

PumpScore PumpTrial::HammersteinWiener(bool products) const {
  constexpr double kMemoryHz = 400.0;  // above the rigid modes, below the bending mode
  const KnownLoop loop(controller_.law, rig_.numbers, {record_.excitation_m, {}});
  HammersteinWienerOptions options;
  options.bandwidth_hz = kMemoryHz;
  options.products = products;
  options.degree = products ? 1 : 3;
  options.input_lag_hz = nominal_.plant.bearings.front().amplifier.bandwidth_hz;
  options.input_delay = std::lround(nominal_.plant.delay_samples);
  for (std::size_t axis = 0; axis < rig_.numbers.axes(); ++axis) {
    options.sensors.push_back(CharacteristicOf(plan_, axis));
  }
  const Clock clock;
  const auto fit = FitHammersteinWiener(Fitted(), options);
  const double time_s = clock.s();
  const Feedback feedback = plan_.inputs == PumpInputs::kCommanded ? loop.AtRest() : Feedback{};
  return {products ? "Hammerstein-Wiener, products" : "Hammerstein-Wiener",
          Fit(PredictOneStep(fit.model, record_.series).output),
          Fit(SimulateFreeRun(fit.model, record_.series, feedback).output), Ahead(fit.model),
          time_s};
}

PumpScore PumpTrial::Scored(const char* name, const NarxOptions& options) const {
  const Clock clock;
  LaggedModel model = FitNarx(Fitted(), options).model;
  if (plan_.free_run_steps > 0) {
    const Index rows = std::min(plan_.free_run_rows, plan_.fitted);
    const Series last = Slice(record_.series, {static_cast<std::size_t>(plan_.fitted - rows),
                                               static_cast<std::size_t>(plan_.fitted)});
    constexpr Index kSettling = 300;  // rows in which the loop forgets how the part began
    model = RefineFreeRun(model, last, {.most_iterations = plan_.free_run_steps, .skip = kSettling})
                .model;
  }
  const double time_s = clock.s();
  const Eigen::VectorXd one_step = Fit(PredictOneStep(model, record_.series).output);
  if (plan_.inputs == PumpInputs::kTestSignals) {
    const Prediction free = SimulateFreeRun(model, record_.series);
    return {name, one_step, Fit(free.output), Ahead(model), time_s, free.diverged_at.has_value()};
  }
  const KnownLoop loop(controller_.law, rig_.numbers, {record_.excitation_m, {}});
  const Eigen::MatrixXd free = RunLags(model, record_.series.rows(), loop.AtRest());
  const auto most = free.cwiseAbs().colwise().maxCoeff().transpose();
  const bool diverged = (most.array() >= kMost * model.output_scale.array()).any();
  return {name, one_step, Fit(free), Ahead(model), time_s, diverged};
}

PumpScore PumpTrial::Narx() const {
  const auto axes = static_cast<Index>(rig_.numbers.axes());
  NarxOptions options{.layout = {axes, axes, 4, 4, 1, 0}, .degree = 2, .most_terms = 200};
  options.network_units = 10;
  return Scored("NARX", options);
}

PumpScore PumpTrial::Narmax() const {
  const auto axes = static_cast<Index>(rig_.numbers.axes());
  return Scored("NARMAX", {.layout = {axes, axes, 4, 4, 1, 3}, .degree = 2, .most_terms = 14});
}

}  // namespace levitas::accuracy
