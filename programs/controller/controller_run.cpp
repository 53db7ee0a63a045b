#include "programs/controller/controller_run.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <thread>

#include "configuration/law_notes.hpp"
#include "configuration/rig_file.hpp"
#include "controller/loop/command_arbiter.hpp"
#include "controller/loop/control_loop.hpp"
#include "hil/guarded_port/guarded_port.hpp"
#include "hil/libgpiod/gpiod_lines.hpp"
#include "levitas_version.hpp"
#include "programs/controller/command_answers.hpp"
#include "programs/controller/command_intake.hpp"
#include "programs/controller/loop_outlet.hpp"
#include "programs/controller/report.hpp"
#include "programs/controller/rig_connection.hpp"
#include "programs/controller/watchman.hpp"
#include "rt/real_time.hpp"
#include "rt/say.hpp"
#include "rt/thread_trouble.hpp"
#include "session/log/record_codec.hpp"
#include "session/log/recorder.hpp"
#include "transport/command_policy.hpp"
#include "transport/operator_receiver.hpp"
#include "transport/sample_batcher.hpp"
#include "transport/statistics_json.hpp"
#include "transport/telemetry.hpp"

namespace levitas::controller_program {

namespace {

constexpr int kBelowTheLoop = 5;  // priority of the thread that hears the emergency stop

struct Files {
  configuration::RigFile rig;
  configuration::ControllerFile controller;
  std::optional<scenario::ScenarioConfig> scenario;
};

Files Load(const ControllerOptions& options) {
  Files files;
  files.rig = configuration::LoadRig(configuration::FindConfig(options.rig, "rigs"));
  ApplyPort(options, files.rig);
  files.controller = configuration::LoadController(
      configuration::FindConfig(options.controller, "controllers"), files.rig.numbers);
  if (!options.scenario.empty()) {
    files.scenario = configuration::LoadScenario(
        configuration::FindConfig(options.scenario, "scenarios"), files.rig.numbers);
  }
  return files;
}

session::SessionHeader Header(const ControllerOptions& options, const Files& files,
                              const std::vector<rt::RealTimeFact>& facts) {
  session::SessionHeader header;
  header.program_version = LEVITAS_VERSION;
  header.rig_yaml = configuration::WriteRig(files.rig);
  header.controller_yaml = configuration::WriteController(files.controller, files.rig.numbers);
  if (files.scenario) header.scenario_yaml = configuration::WriteScenario(*files.scenario);
  header.pace = options.realtime ? "realtime" : "lockstep";
  header.seed = options.seed;
  header.period_ns = files.rig.numbers.period_ns;
  header.start_utc_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(
                            std::chrono::system_clock::now().time_since_epoch())
                            .count();
  header.machine = rt::MachineText() + '\n' + rt::Text(facts);
  header.source = options.port;
  header.channels = files.rig.numbers.channels;
  header.synchronous.angle_from = files.controller.synchronous.angle.source;
  for (const auto& block : files.controller.synchronous.blocks) {
    header.synchronous.blocks.push_back(block.name);
  }
  return header;
}

// Tells people and the network what the recorder found worth saying.
void Announce(const session::Event& event, transport::Telemetry& telemetry) {
  rt::Say(fmt::format("amb-controller: cycle {}: {}", event.cycle, rt::Quoted(event.text)));
  session::Bytes encoded;
  session::EncodeEvent(event, encoded);
  telemetry.PostEvent(std::move(encoded));
}

/// A landing beyond its limit is no trip of the rig's, though it ends in one.
ExitStatus Status(const RunFacts& facts, const loop::EndNews& end, bool partner_stayed) {
  if (end.overdue) return ExitStatus::kOther;
  if (facts.trips > 0) return ExitStatus::kTripped;
  const bool done = partner_stayed && facts.scenario_problem.empty() && !end.brake_fails;
  return done ? ExitStatus::kDone : ExitStatus::kOther;
}

std::unique_ptr<rt::RealTimeGuard> PrepareRealTime(const ControllerOptions& options,
                                                   const rt::RealTimeOptions& wanted) {
  if (!options.realtime) return nullptr;
  auto guard = std::make_unique<rt::RealTimeGuard>(wanted);
  if (guard->complete()) return guard;
  if (options.require_realtime) {
    throw Problem(ExitStatus::kOther,
                  "real time is refused by this machine:\n" + rt::Text(guard->facts()));
  }
  rt::Say("amb-controller: real time is degraded:\n" + rt::Text(guard->facts()));
  return guard;
}

// The rig file's lines; none in lockstep, where time is not the machine's.
std::unique_ptr<gpio::GpiodLines> OpenLines(const ControllerOptions& options,
                                            const gpio::LinesConfig& config) {
  if (config.empty()) return nullptr;
  if (options.no_lines || !options.realtime) {
    rt::Say(fmt::format("amb-controller: the rig's lines are not used ({})",
                        options.no_lines ? "--no-lines" : "lockstep"));
    return nullptr;
  }
  return std::make_unique<gpio::GpiodLines>(config);
}

// Everything a run consists of, made in the order it is needed and taken down in reverse.
class Session {
 public:
  Session(const ControllerOptions& options, const Files& files, gpio::GpiodLines* lines)
      : options_(options),
        lines_(lines),
        numbers_(files.rig.numbers),
        wanted_{.processor = options.processor},
        guard_(PrepareRealTime(options, wanted_)),
        network_(TelemetryNetwork(options)),
        rig_(Connect(options, files.rig)),
        policy_(transport::DecideCommands(options.commands, network_, !rig_->virtual_rig())),
        telemetry_(network_),
        header_(Header(options, files, Facts())),
        batcher_(numbers_.axes(), [this](auto batch) { telemetry_.PostSamples(std::move(batch)); }),
        recorder_(
            {.session_path = options.record,
             .trip_folder = options.trip_folder,
             .header = header_,
             .trip_budget = {options.trip_budget[0], std::uintmax_t{options.trip_budget[1]} << 20U},
             .waits_for_room = !options.realtime,
             .on_event = [this](const auto& event) { Heard(event); },
             .on_record = [this](const auto& record) { Saw(record); }}),
        outlet_(recorder_, telemetry_, numbers_.period_ns),
        cycle_({numbers_, files.controller.law, files.controller.supervisor,
                files.controller.synchronous, files.controller.bias}),
        sequence_(files.controller.supervisor.sequence),
        signal_limits_(scenario::LimitsOf(numbers_, files.controller.law.current_limit_a)) {
    if (files.scenario) {
      player_.emplace(*files.scenario, numbers_.period_s(), sequence_.standstill_rad_per_s);
    }
    for (const std::string& note : configuration::LawNotes(files.controller.law)) {
      rt::Say("amb-controller: " + note);
    }
    if (lines_ != nullptr) guarded_.emplace(rig_->port(), *lines_, files.rig.lines);
    session::Bytes announcement;
    session::EncodeHeader(header_, announcement);
    telemetry_.Announce(std::move(announcement));
  }

  ExitStatus Run() {
    loop::CommandArbiter arbiter(ArbiterLimits(), player_ ? &*player_ : nullptr,
                                 {&intake_.commands(), &intake_.stops(), &answers_.given()});
    rt::Say("amb-controller: who may command: " + policy_.who);
    std::optional<transport::OperatorReceiver> receiver;
    if (policy_.open) {
      transport::OperatorHandlers handlers = intake_.Handlers([this] { EnterStopThread(); });
      handlers.challenge = [this](const auto& challenge) {
        telemetry_.PostChallenge(transport::EncodeChallenge(challenge));
      };
      receiver.emplace(network_, intake_.stops(), std::move(handlers));
    }
    loop::ControlLoop loop(
        {.pace = options_.realtime ? loop::Pace::kRealtime : loop::Pace::kLockstep,
         .period_ns = numbers_.period_ns,
         .phase_ns = rig_->phase_ns()},
        Port(), cycle_, arbiter, outlet_, clock_);
    std::atomic<bool> running{true};
    Watchman watchman(loop, arbiter, options_, *rig_, lines_, [&] {
      TellNews(rig_->TakeNews());
      scenario::GuardNotice notice;
      while (arbiter.TakeNotice(notice)) TellNews(scenario::Text(notice, numbers_));
      if (receiver) TellNews(receiver->TakeNews());
    });
    std::thread thread([&] {
      if (guard_) rt::Guarded("loop", [this] { rt::EnterThread(wanted_); });
      loop.Run();
      running.store(false);
    });
    const bool stayed = watchman.Watch(running);
    thread.join();
    // Also after an end without a landing: with lines, the enable line falls here.
    Port().SayGoodbye(Goodbye(loop.last().in.frame, arbiter.standing()));
    recorder_.Finish();  // the report names the trip's file and comes after the last event
    return Tell(loop.statistics(), receiver ? receiver->counts() : transport::OperatorCounts{},
                arbiter.news(), arbiter.signals_reduced(), stayed);
  }

 private:
  [[nodiscard]] double StopRate() const {
    return std::min(sequence_.trip_acceleration_rad_per_s2, numbers_.max_acceleration_rad_per_s2);
  }

  [[nodiscard]] loop::ArbiterOptions ArbiterLimits() const {
    return {.period_s = numbers_.period_s(),
            .stop_acceleration_rad_per_s2 = StopRate(),
            .standstill_rad_per_s = sequence_.standstill_rad_per_s,
            .landing_ramp_s = sequence_.landing_ramp_s,
            .duration_s = options_.duration_s,
            .excitation = signal_limits_};
  }

  /// Amplifiers off, and the drive brakes a rotor that is not known to stand.
  [[nodiscard]] CurrentFrame Goodbye(const SensorFrame& newest, bool standing) const {
    return {.cycle = newest.cycle,
            .axes = static_cast<std::uint32_t>(numbers_.axes()),
            .acceleration_limit_rad_per_s2 = StopRate(),
            .drive_enabled = !standing};
  }

  void Heard(const session::Event& event) {
    answers_.Heard(event);
    Announce(event, telemetry_);
  }

  void Saw(const cycle::CycleRecord& record) {
    answers_.Saw(record);
    batcher_.Add(record, rt::MonotonicNowNs());
  }

  /// Below the loop, above everything else of ours.
  void EnterStopThread() const {
    rt::RealTimeOptions wanted = wanted_;
    wanted.priority -= kBelowTheLoop;
    wanted.processor = -1;  // the loop's own is the one where it would have to wait
    if (guard_) rt::EnterThread(wanted);
  }

  void Warn(const std::string& text) {
    Announce({.cycle = outlet_.cycle(),
              .time_ns = static_cast<std::int64_t>(outlet_.cycle()) * numbers_.period_ns,
              .severity = session::Event::Severity::kWarning,
              .text = text},
             telemetry_);
  }

  void TellNews(const std::string& news) {
    if (!news.empty()) Warn(news);
  }

  /// What the loop faces: the connection, with the rig's lines beside it where it has any.
  [[nodiscard]] port::RigPort& Port() noexcept {
    if (guarded_) return *guarded_;
    return rig_->port();
  }

  [[nodiscard]] const std::vector<rt::RealTimeFact>& Facts() const {
    static const std::vector<rt::RealTimeFact> kNone;
    return guard_ ? guard_->facts() : kNone;
  }

  ExitStatus Tell(const loop::LoopStatistics& statistics, const transport::OperatorCounts& commands,
                  const loop::EndNews& end, const scenario::GuardCounts& signals_reduced,
                  bool stayed) {
    const RunFacts facts{.options = options_,
                         .statistics = statistics,
                         .port = Port().counters(),
                         .transport = Port().Trouble(),
                         .records_lost = recorder_.lost(),
                         .telemetry_dropped = telemetry_.dropped(),
                         .commands = commands,
                         .signals_reduced = signals_reduced,
                         .trips = outlet_.trips(),
                         .first_fault = outlet_.first_fault(),
                         .trip_file = recorder_.trip_file(),
                         .scenario_problem = player_ ? player_->Text() : "",
                         .lines = guarded_ ? &guarded_->line_counters() : nullptr,
                         .real_time = Facts(),
                         .delay = rig_->delay()};
    rt::Say(ReportText(facts), rt::Speaker::Kind::kReport);
    if (!options_.json.empty())
      transport::WriteJson("controller", ReportJson(facts), options_.json);
    return Status(facts, end, stayed);
  }

  const ControllerOptions& options_;
  gpio::GpiodLines* lines_;
  RigNumbers numbers_;
  rt::RealTimeOptions wanted_;
  std::unique_ptr<rt::RealTimeGuard> guard_;
  transport::LcmNetwork network_;
  std::unique_ptr<RigConnection> rig_;
  transport::CommandPolicy policy_;
  std::optional<gpio::GuardedPort> guarded_;
  transport::Telemetry telemetry_;
  CommandAnswers answers_{[this](const transport::CommandAnswer& answer) {
    telemetry_.PostAnswer(transport::EncodeAnswer(answer));
  }};
  session::SessionHeader header_;
  transport::SampleBatcher batcher_;
  session::Recorder recorder_;
  LoopOutlet outlet_;
  cycle::ControlCycle cycle_;
  supervisor::SequenceConfig sequence_;
  scenario::GuardLimits signal_limits_;
  std::optional<scenario::ScenarioPlayer> player_;
  CommandIntake intake_{numbers_, [this](const std::string& text) { Warn(text); },
                        [this](const std::string& text, const CommandOrigin& origin) {
                          Warn(text);
                          answers_.Refuse(OperatorCommand::kExcite, origin, outlet_.cycle(), text);
                        }};
  rt::MonotonicClock clock_;
};

}  // namespace

ExitStatus Run(const ControllerOptions& options) {
  const Files files = Load(options);
  // Before any thread is started: the lines' guard is a fork.
  const std::unique_ptr<gpio::GpiodLines> lines = OpenLines(options, files.rig.lines);
  Session session(options, files, lines.get());
  return session.Run();
}

}  // namespace levitas::controller_program
