#pragma once
// Watches the plant during a life and finds what must not happen; see life.hpp.
//
// Thread   the life's. Sampled allocates only when it finds a harm.

#include <cstdint>

#include "benchmark/lives/life.hpp"
#include "controller/cycle/cycle_io.hpp"
#include "plant_sim/plant/plant.hpp"

namespace levitas::lives {

/// What the controller last made of it.
struct ControllerView {
  bool there{};
  std::int64_t since_ns{};  ///< there since
  cycle::CycleOutputs out;
  cycle::OperatorInput asked;
  Fault released{Fault::kNone};  ///< why the magnets let go
};

class Judge {
 public:
  // A little more than the protection's 20 ms, which sees sensors and not the bearing.
  static constexpr std::int64_t kContactNs = 25'000'000;

  Judge(const LifePlan& plan, double standstill_rad_per_s, std::int64_t period_ns,
        LifeResult& result)
      : plan_(plan),
        turning_rad_per_s_(2.0 * standstill_rad_per_s),
        period_ns_(period_ns),
        result_(result) {}

  /// After each period of the rig.
  void Sampled(std::int64_t now_ns, const plant::Plant& plant, bool energised,
               const ControllerView& controller);
  /// The controller has ended by itself.
  void Ended(std::int64_t now_ns, const plant::Plant& plant);
  /// The life is over.
  void Finish();

 private:
  void Released(const ControllerView& controller);
  void Touched(double contact_n, const ControllerView& controller);
  void NoteSignals(double contact_n, const ControllerView& controller);
  [[nodiscard]] bool Documented(const ControllerView& controller, bool by_the_rig) const;
  void Found(Harm harm, const std::string& how);
  [[nodiscard]] bool CurrentsStayedAway() const;
  [[nodiscard]] bool ContactIsDocumented(const ControllerView& controller) const;
  /// The controller was late by at least so much, or is recovering from it.
  [[nodiscard]] bool Stalled(std::int64_t shortest_ns, std::int64_t after_ns) const;
  [[nodiscard]] bool Misread(std::int64_t after_ns) const;  ///< positions
  [[nodiscard]] bool Did(Deed deed) const;

  const LifePlan& plan_;
  double turning_rad_per_s_;
  std::int64_t period_ns_;
  LifeResult& result_;
  std::int64_t now_ns_{0};
  double speed_rpm_{0.0};
  bool energised_{false};
  std::uint64_t free_periods_{0};
  std::int64_t excited_ns_{0};
  std::int64_t touch_first_ns_{0};  ///< of contacts that no release has explained yet
  std::uint64_t touch_periods_{0};
  double touch_rpm_{0.0};
  std::uint64_t borne_periods_{0};  // of documented contact, those without counted back
  double touch_most_n_{0.0};
};

}  // namespace levitas::lives
