// A law of one's own holds the shipped rotor: the cycle around it, with its protections, is the
// product's. `own_law none` shows what they are for: a law that does nothing.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <string_view>

#include "configuration/rig_file.hpp"
#include "controller/cycle/control_cycle.hpp"
#include "plant_sim/plant/command_of.hpp"
#include "plant_sim/plant/plant.hpp"
#include "progressive_law.hpp"

using namespace levitas;

namespace {

class NoLaw final : public law::OwnLaw {
 public:
  void Start() noexcept override {}
  [[nodiscard]] AxisArray Step(const law::LawInputs&) noexcept override { return {}; }
};

std::unique_ptr<law::OwnLaw> Chosen(std::string_view word, double period_s) {
  if (word == "none") return std::make_unique<NoLaw>();
  return std::make_unique<ProgressiveLaw>(period_s);
}

}  // namespace

int main(int count, char** words) try {
  const auto rig = configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  // Sequence and protections are those of a controller file; its law is not used.
  const auto controller = configuration::LoadController(
      configuration::FindConfig("flexible_rotor_commissioned", "controllers"), rig.numbers);
  cycle::ControlCycle control({rig.numbers, {}, controller.supervisor},
                              Chosen(count > 1 ? words[1] : "", rig.numbers.period_s()));
  plant::Plant plant(rig.plant, /*seed=*/1);
  plant.RestInTouchdown();

  cycle::CycleInputs in{.cycle = 1, .frame_present = true};
  cycle::CycleOutputs out;
  double largest_m = 0.0;
  double contact_n = 0.0;
  for (; in.cycle <= 50'000 && out.mode != Mode::kTripped; ++in.cycle) {  // 5 s
    in.op.command = in.cycle == 1 ? OperatorCommand::kLift : OperatorCommand::kNone;
    in.frame = plant.Sample();
    out = control.Step(in);
    plant.Advance(plant::CommandOf(out.current));
    if (in.cycle <= 20'000) continue;  // lifted and settled
    for (std::size_t x = 0; x < in.frame.axes; x += 2) {
      largest_m =
          std::max(largest_m, std::hypot(in.frame.position_m[x], in.frame.position_m[x + 1]));
    }
    contact_n = std::max(contact_n, plant.ContactForce());
  }
  if (out.mode == Mode::kTripped) {
    std::printf("tripped: %s after %.2f s\n", Name(out.fault).data(),
                static_cast<double>(in.cycle) * rig.numbers.period_s());
    return 4;
  }
  std::printf("%s: largest orbit %.1f um, contact %.1f N\n", Name(out.mode).data(), 1e6 * largest_m,
              contact_n);
  return 0;
} catch (const std::exception& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
