// Table of what a healthy rig may differ by from its file.
#include "configuration/schema/schema.hpp"

namespace levitas::configuration {
namespace {

using namespace unit;

void Describe(Visitor& v, Tolerances& t) {
  const auto share = [&v](std::string_view stem, double usual, std::string_view meaning,
                          double& value) {
    v.Number({stem, kOne, 1e-4, 1, usual, meaning}, value);
  };
  share("current_gain", 0.03, "ki, every axis by itself", t.current_gain);
  share("displacement_stiffness", 0.03, "ks, every axis by itself", t.displacement_stiffness);
  share("amplifier_bandwidth", 0.05, "every axis by itself", t.amplifier_bandwidth);
  share("sensor_gain", 0.01, "every axis by itself", t.sensor_gain);
  share("sensor_bandwidth", 0.05, "every axis by itself", t.sensor_bandwidth);
  v.Number({"sensor_offset", kMicrometre, 0.001, 1000, 10, "every axis by itself"},
           t.sensor_offset_m);
  v.Number({"sensor_position", kMillimetre, 0.001, 100, 0.5, "along the shaft, every bearing"},
           t.sensor_position_m);
  v.Number({"sensor_runout", kMicrometre, 0.001, 1000, 1,
            "once per turn; each of its two parts, every axis by itself"},
           t.sensor_runout_m);
  v.Number({"delay", kOne, 1e-4, 10, 0.05, "of the loop, in sampling periods"}, t.delay_samples);
  share("modal_frequency", 0.01, "every bending mode", t.modal_frequency);
  share("modal_damping", 0.3, "every bending mode", t.modal_damping);
  share("modal_shape", 0.02,
        "of its rms along the shaft, every bending mode at every sensor and magnet", t.modal_shape);
  share("rotor_mass", 0.005, "of the whole rotor", t.rotor_mass);
  share("gyroscopic_inertia", 0.02, "of the whole rotor", t.gyroscopic_inertia);
  v.Number({"unbalance", kGramMillimetre, 0.001, 1e6, 3, "each of its two parts, every plane"},
           t.unbalance_kg_m);
  v.Number({"static_load", kNewton, 0.001, 1e6, 1, "every axis by itself"}, t.static_load_n);
  share("shaft_stiffness", 0.02, "geared shafts: bending and supports", t.shaft_stiffness);
  share("shaft_damping", 0.2, "geared shafts", t.shaft_damping);
  share("mesh_stiffness", 0.03, "geared shafts: every pair of wheels", t.mesh_stiffness);
  share("mesh_damping", 0.2, "geared shafts: every pair of wheels", t.mesh_damping);
  v.Number({"transmission_error", kMicrometre, 0.001, 1000, 0.3,
            "geared shafts: each of its two parts, every order"},
           t.transmission_error_m);
  v.Number({"gear_runout", kMicrometre, 0.001, 1000, 1,
            "geared shafts: each of its two parts, every wheel"},
           t.gear_runout_m);
}

}  // namespace

void DescribeTolerances(Visitor& v, std::optional<Tolerances>& tolerances) {
  bool present = tolerances.has_value();
  v.OptionalGroup("tolerances",
                  "standard deviations by which this rig, when healthy, may differ from its file; "
                  "amb diagnose calibrates within them. Ratios are shares of the file's number. "
                  "Left out: the defaults",
                  present, [&] {
                    if (!tolerances) tolerances.emplace();
                    Describe(v, *tolerances);
                  });
}

}  // namespace levitas::configuration
