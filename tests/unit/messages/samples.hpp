#pragma once
// One well-formed message of every type, and its bytes.

#include <cstdint>
#include <levitas_msg/command_answer_t.hpp>
#include <levitas_msg/controller_state_t.hpp>
#include <levitas_msg/convergence_t.hpp>
#include <levitas_msg/current_frame_t.hpp>
#include <levitas_msg/cycle_record_t.hpp>
#include <levitas_msg/event_t.hpp>
#include <levitas_msg/excitation_request_t.hpp>
#include <levitas_msg/loop_histogram_t.hpp>
#include <levitas_msg/loop_timing_t.hpp>
#include <levitas_msg/operator_command_t.hpp>
#include <levitas_msg/sample_batch_t.hpp>
#include <levitas_msg/sensor_frame_t.hpp>
#include <levitas_msg/session_header_t.hpp>
#include <levitas_msg/torsion_batch_t.hpp>
#include <string>
#include <tuple>
#include <vector>

namespace levitas::message::testing {

using Bytes = std::vector<std::uint8_t>;

using EveryMessage = std::tuple<
    levitas_msg::command_answer_t, levitas_msg::controller_state_t, levitas_msg::convergence_t,
    levitas_msg::current_frame_t, levitas_msg::cycle_record_t, levitas_msg::event_t,
    levitas_msg::excitation_request_t, levitas_msg::loop_histogram_t, levitas_msg::loop_timing_t,
    levitas_msg::operator_command_t, levitas_msg::sample_batch_t, levitas_msg::sensor_frame_t,
    levitas_msg::session_header_t, levitas_msg::torsion_batch_t>;
constexpr std::size_t kEveryMessageCount = std::tuple_size_v<EveryMessage>;

template <class Message>
Bytes Encoded(const Message& message) {
  Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

constexpr int kAxes = 4;

inline void Fill(levitas_msg::command_answer_t& m) { m.text = "command lift (cycle 4711)"; }
inline void Fill(levitas_msg::controller_state_t& m) {
  m.axes = kAxes;
  m.position_m = m.reference_m = m.control_current_a = {0.1, 0.2, 0.3, 0.4};
}
inline void Fill(levitas_msg::convergence_t& m) {
  m.outputs = kAxes;
  m.error_rms_m = {1e-7, 2e-7, 3e-7, 4e-7};
  m.fit_percent = {99.1, 99.2, 99.3, 99.4};
  m.changed = "position ux, section 1 for uy";
}
inline void Fill(levitas_msg::current_frame_t& m) {
  m.axes = kAxes;
  m.control_current_a = {0.1, 0.2, 0.3, 0.4};
}
inline void Fill(levitas_msg::cycle_record_t& m) {
  m.axes = kAxes;
  m.position_m = m.excitation_a = m.excitation_m = {0.1, 0.2, 0.3, 0.4};
  m.reference_m = m.control_current_a = {0.1, 0.2, 0.3, 0.4};
  m.coils = 2 * kAxes;
  m.coil_current_a.assign(2 * kAxes, 1.0);
}
inline void Fill(levitas_msg::event_t& m) { m.text = "levitating -> spinning"; }
inline void Fill(levitas_msg::excitation_request_t& m) { m.step_yaml = "hold_s: 1\n"; }
inline void Fill(levitas_msg::loop_histogram_t& m) {
  m.bins = 5;
  m.edge_ns = {1, 2, 4, 8, 16};
  m.wakeup = m.compute = m.latency = {0, 1, 2, 3, 4};
}
inline void Fill(levitas_msg::loop_timing_t& m) { m.cycle = 5; }
inline void Fill(levitas_msg::operator_command_t& m) { m.command = 1; }
inline void Fill(levitas_msg::sample_batch_t& m) {
  m.axes = kAxes;
  m.samples = 3;
  m.values = 3 * kAxes;
  m.position_m.assign(3 * kAxes, 1e-6F);
  m.control_current_a.assign(3 * kAxes, 0.5F);
  m.speed_rad_per_s = m.angle_rad = {1.0F, 2.0F, 3.0F};
}
inline void Fill(levitas_msg::sensor_frame_t& m) {
  m.axes = kAxes;
  m.position_m = {0.1, 0.2, 0.3, 0.4};
}
inline void Fill(levitas_msg::session_header_t& m) {
  m.format_version = 1;
  m.program_version = "0.1.0";
  m.rig_yaml = "name: test\n";
  m.pace = "lockstep";
  m.channels = kAxes;
  m.channel = {"de_x", "de_y", "nde_x", "nde_y"};
}

inline void Fill(levitas_msg::torsion_batch_t& m) {
  m.couplings = 2;
  m.samples = 3;
  m.values = 6;
  m.torque_n_m.assign(6, 0.5);
  m.twist_rad.assign(6, 1e-4);
}

template <class Message>
Message Sample() {
  Message message{};
  Fill(message);
  return message;
}

}  // namespace levitas::message::testing
