#include "dashboard/dashboard.hpp"

#include <atomic>
#include <exception>
#include <optional>
#include <thread>
#include <utility>

#include "dashboard/announced_rig.hpp"
#include "dashboard/command_api.hpp"
#include "dashboard/convergence.hpp"
#include "dashboard/first_order.hpp"
#include "dashboard/full_spectrum.hpp"
#include "dashboard/history.hpp"
#include "dashboard/live_run.hpp"
#include "dashboard/scope_controller.hpp"
#include "dashboard/snapshot.hpp"
#include "dashboard/spectrum_range.hpp"
#include "rt/clock.hpp"
#include "transport/lcm_packet.hpp"

namespace levitas::dashboard {
namespace {

constexpr std::chrono::milliseconds kHelloEvery{250};  // a challenge serves for eight of these

constexpr std::int64_t Ns(std::chrono::nanoseconds duration) { return duration.count(); }

}  // namespace

struct Dashboard::Impl {
  Impl(const transport::LcmNetwork& network, const WebOptions& web,
       std::chrono::milliseconds patience)
      : receiver(network, transport::Direction::kTelemetry),
        commander(network, patience),
        server(web, hub, Routes(), Stops()),
        thread([this] { Run(); }) {}

  ~Impl() {
    stopping.store(true);
    thread.join();
  }

  std::vector<Route> Routes() {
    return {
        {true, "/api/command",
         [this](const std::string& body) {
           return AnswerCommand(body, [this](const auto& asked) { return commander.Send(asked); });
         }},
        {true, "/api/excitation",
         [this](const std::string& body) {
           return AnswerExcitation(body, rig.Get(), [this](const std::string& step_yaml) {
             return commander.SendExcitation(step_yaml);
           });
         }},
        {true, "/api/spectrum", [this](const std::string& body) { return range.Ask(body); }},
        {false, "/api/history",
         [this](const std::string&) {
           return HttpAnswer{kHttpOk, history.Bytes(), "application/octet-stream"};
         }},
        {true, "/api/scope", [this](const std::string& body) { return scope.Ask(body); }},
        {false, "/api/scope.json", [this](const std::string&) { return scope.CaptureJson(); }},
        {false, "/api/scope.csv", [this](const std::string&) { return scope.CaptureCsv(); }},
    };
  }

  StopRoute Stops() {
    return {AsksForStop, [this](StopRoute::Done done) {
              commander.Stop(
                  [done = std::move(done)](const CommandReply& reply) { done(Told(reply)); });
            }};
  }

  void Run() {
    hub.Put(Topic::kRig, RigJson(run, started_ns));
    receiver.HearUnproven();
    std::int64_t next_tick_ns = rt::MonotonicNowNs();
    std::int64_t next_hello_ns = next_tick_ns;
    while (!stopping.load()) {
      const auto received = receiver.Receive(next_tick_ns);
      const std::int64_t now_ns = rt::MonotonicNowNs();
      if (!received.datagram.empty()) HearAnything(received, now_ns);
      if (now_ns >= next_hello_ns) {
        next_hello_ns = now_ns + Ns(kHelloEvery);
        commander.SayHello();
      }
      if (now_ns < next_tick_ns) continue;
      next_tick_ns = now_ns + Ns(kTick);
      Publish(now_ns);
    }
  }

  /// No datagram ends this thread, and with it the page and its emergency stop.
  void HearAnything(const transport::Received& received, std::int64_t now_ns) {
    try {
      Hear(received, now_ns);
    } catch (const std::exception&) {
      run.Refuse();
    }
  }

  void Hear(const transport::Received& received, std::int64_t now_ns) {
    const transport::Packet packet = transport::ParsePacket(received.datagram);
    if (packet.kind != transport::PacketKind::kShort) return;
    if (packet.channel == transport::channel::kChallenge) return HearChallenge(received, packet);
    if (!received.proven) return;
    if (packet.channel == transport::channel::kAnswer) {
      if (const auto answer = transport::ReadAnswer(packet.payload)) commander.Saw(*answer);
      return;
    }
    const std::uint64_t event_before = run.newest_event();
    run.Take(packet.channel, packet.payload, now_ns);
    if (run.newest_event() != event_before) {
      const session::Event& event = run.events().back().event;
      if (event.severity == session::Event::Severity::kTrip) scope.Tripped(event.cycle);
      hub.PutEvent(run.newest_event(), EventJson(run.events().back()));
    }
    if (packet.channel == transport::channel::kHistogram) hub.Put(Topic::kTiming, TimingJson(run));
    if (packet.channel == transport::channel::kConvergence) HearConvergence(packet.payload);
    if (packet.channel == transport::channel::kSamples && run.samples()) {
      scope.Advance(*run.samples());
    }
    if (run.run_number() != told_run) {
      told_run = run.run_number();
      rig.Set(*run.rig());
      scope.RunIs(*run.rig());
      history.Clear(run.rig()->axes());
      convergence.RunIs(run.header().start_utc_ns, run.rig()->period_s());
      hub.Put(Topic::kConvergence, convergence.Json());
      hub.Put(Topic::kRig, RigJson(run, started_ns));
    }
  }

  void HearConvergence(std::span<const std::uint8_t> payload) {
    bool told = false;
    if (!convergence.Take(payload, told)) run.Refuse();
    if (told) hub.Put(Topic::kConvergence, convergence.Json());
  }

  /// A controller whose clock differs from ours is known by its answer to our question.
  void HearChallenge(const transport::Received& received, const transport::Packet& packet) {
    const auto challenge = transport::ReadChallenge(packet.payload);
    if (!challenge) return;
    if (!received.proven && !commander.Asked(*challenge)) return;
    if (!received.proven) receiver.Trust();
    commander.Heard(*challenge);
  }

  void Publish(std::int64_t now_ns) {
    if (server.viewers() == 0) {
      // The next viewer would begin with figures from when somebody last looked.
      hub.Forget(Topic::kTick);
      hub.Forget(Topic::kSpectrum);
      return;
    }
    hub.Put(Topic::kTick, TickJson(run, now_ns));
    if (auto news = scope.News()) hub.Put(Topic::kScope, *std::move(news));
    if (now_ns < next_spectrum_ns || !run.samples()) return;
    next_spectrum_ns = now_ns + Ns(kSpectrumEvery);
    if (run.samples()->count() == spectrum_count) return;
    spectrum_count = run.samples()->count();
    if (const auto spectrum = SpectrumOf(*run.samples(), range.highest_hz())) {
      const auto first_order = FirstOrderOf(*run.samples());
      hub.Put(Topic::kSpectrum,
              SpectrumJson(*spectrum, first_order.value_or(std::vector<std::complex<double>>{})));
    }
  }

  const std::int64_t started_ns{rt::MonotonicNowNs()};
  Hub hub;
  transport::MulticastReceiver receiver;
  Commander commander;
  History history;
  SpectrumRange range{kHighestSpectrumHz};
  LiveRun run{[this](const Envelope& bucket) { history.Add(bucket); }};  ///< our own thread's
  AnnouncedRig rig;
  ScopeController scope;
  ConvergenceHistory convergence;
  std::uint64_t told_run{0};
  std::int64_t next_spectrum_ns{0};
  std::uint64_t spectrum_count{0};
  std::atomic<bool> stopping{false};
  WebServer server;
  std::thread thread;
};

Dashboard::Dashboard(const transport::LcmNetwork& network, const WebOptions& web,
                     std::chrono::milliseconds patience)
    : impl_(std::make_unique<Impl>(network, web, patience)) {}

Dashboard::~Dashboard() = default;

std::string Dashboard::Url() const { return impl_->server.Url(); }

void Dashboard::RunEnded(const std::string& how) { impl_->hub.Put(Topic::kEnd, EndJson(how)); }

}  // namespace levitas::dashboard
