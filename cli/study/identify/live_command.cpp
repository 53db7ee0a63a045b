// amb identify live: the Hammerstein-Wiener recursion beside a running loop, or along its record.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <ctime>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/json_file.hpp"
#include "cli/options/network_options.hpp"
#include "cli/run/interrupt.hpp"
#include "cli/study/identify/hammerstein_wiener_options.hpp"
#include "cli/study/identify/live_command.hpp"
#include "cli/study/identify/live_listener.hpp"
#include "cli/study/identify/live_report.hpp"
#include "cli/study/identify/sensor_options.hpp"
#include "cli/study/written_files.hpp"
#include "identification/live/convergence_message.hpp"
#include "identification/live/live_identification.hpp"
#include "identification/live/play_session.hpp"
#include "rt/say.hpp"
#include "transport/lcm_packet.hpp"

namespace levitas::cli {
namespace {

using namespace identification;
using Clock = std::chrono::steady_clock;

constexpr const char* kLiveHelp =
    "The recursion of amb identify hammerstein-wiener, fed row by row with what a running "
    "controller sends to the network; the loop neither waits for it nor knows of it. Only rows of "
    "a levitated rotor teach. A line a second tells the largest change of any parameter, the error "
    "of the prediction one sample ahead and its fit; amb dash shows the same. Rows that are "
    "missing are told, and the past of the signals begins anew behind them. Ctrl-C or the end of "
    "the run ends it. With a SESSION the same recursion runs along the record: the same rows give "
    "the same parameters, bit for bit. Without a test signal the loop's own noise is all that "
    "teaches.\n"
    "  amb run --rig turbomolecular_pump --scenario turbomolecular_pump_identify --record p.lcm\n"
    "  amb identify live --record convergence.csv      beside it, in another terminal\n"
    "  amb identify live p.lcm --json live.json        the same from the record";

struct LiveCommandOptions {
  LiveOptions live;
  SensorOptions sensors;
  std::string session_path, port{"lcm"}, key, record_path, json_path;
  double tolerance_percent{1.0};
  double input_lag_hz{-1.0};
  Eigen::Index input_delay{-1};
  double patience_s{5.0};
  bool until_converged{};
};

/// Sends the points to those who look.
class PointSender {
 public:
  explicit PointSender(const transport::LcmNetwork& network)
      : sender_(network, transport::Direction::kTelemetry) {}

  void Send(const LiveIdentification& live, const ConvergencePoint& point) {
    const auto message = ConvergenceMessage(live, point);
    const std::size_t head = transport::HeaderSize(transport::channel::kConvergence);
    datagram_.resize(head + static_cast<std::size_t>(message.getEncodedSize()));
    transport::WriteHeader(datagram_, sequence_++, transport::channel::kConvergence);
    message.encode(datagram_.data(), static_cast<int>(head), message.getEncodedSize());
    static_cast<void>(sender_.Send(datagram_));  // a page without a point waits for the next
  }

 private:
  transport::MulticastSender sender_;
  std::uint32_t sequence_{0};
  std::vector<std::uint8_t> datagram_;
};

/// Processor time of this thread in the recursion, its report included: that of other programs on
/// the machine does not count.
class Busy {
 public:
  template <class Work>
  void With(Work work) {
    const double began_s = ThreadSeconds();
    work();
    s_ += ThreadSeconds() - began_s;
  }
  [[nodiscard]] double s() const noexcept { return s_; }

 private:
  static double ThreadSeconds() noexcept {
    timespec now{};
    static_cast<void>(clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now));
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  }

  double s_{};
};

bool Enough(const LiveCommandOptions& options, const LiveIdentification& live) {
  return options.until_converged && live.recursion() && live.recursion()->rows_to_converge();
}

/// Until Ctrl-C, the end of the run, or silence.
void Listen(const LiveCommandOptions& options, const transport::LcmNetwork& network,
            LiveIdentification& live, const LiveReport& report, Busy& busy) {
  constexpr std::chrono::milliseconds kLook{50};
  const InterruptGuard interrupts;
  LiveListener listener(network);
  auto heard = Clock::now();
  bool told_run = false;
  while (interrupts.count() == 0 && !live.ended() && !Enough(options, live)) {
    if (const std::string news = listener.TakeNews(); !news.empty()) {
      rt::Say(fmt::format("warning: {}\n", news));
    }
    const auto message = listener.Next(kLook);
    const auto now = Clock::now();
    if (!message) {
      if (std::chrono::duration<double>(now - heard).count() > options.patience_s) break;
      continue;
    }
    heard = now;
    busy.With([&] { live.Take(message->channel, message->payload); });
    if (live.rig() && !told_run) report.TellRun(live);
    told_run = live.rig().has_value();
  }
  if (listener.dropped() > 0) {
    rt::Say(
        fmt::format("warning: {} messages came faster than this machine computes and were "
                    "dropped; a smaller --order or no --products needs less\n",
                    listener.dropped()));
  }
  if (live.refused() > 0) {
    rt::Say(
        fmt::format("warning: {} messages could not be used: of another version of the "
                    "controller, damaged, or of another rig\n",
                    live.refused()));
  }
}

void Play(const LiveCommandOptions& options, LiveIdentification& live, const LiveReport& report,
          Busy& busy) {
  session::SessionReader reader(options.session_path);
  live.Take(reader.header());
  report.TellRun(live);
  busy.With([&] { PlaySession(reader, live, [&] { return !Enough(options, live); }); });
  if (reader.damage().any()) {
    rt::Say(fmt::format("warning: {}: {}\n", options.session_path, reader.damage().Text()));
  }
}

/// Why there is no model, when there is none.
void RefuseNothing(const LiveCommandOptions& options, const LiveIdentification& live) {
  if (live.recursion() && live.recursion()->model() != nullptr) return;
  if (!options.session_path.empty()) {
    throw BadInput(fmt::format(
        "{}: no levitated rows in which every current and position changes; nothing was learnt",
        options.session_path));
  }
  throw Problem(ExitStatus::kOther,
                live.rig() ? "the rotor was never levitated long enough while this listened: "
                             "nothing was learnt; start it when the rotor is levitated, before the "
                             "run ends"
                           : fmt::format("no controller was heard on {} within {:g} s: start one "
                                         "with the same --port (amb run prints the one it took), "
                                         "or give a session",
                                         options.port, options.patience_s));
}

LiveOptions Wanted(const LiveCommandOptions& options) {
  LiveOptions live = options.live;
  live.model.tolerance = options.tolerance_percent / 100.0;
  if (options.input_lag_hz >= 0.0) live.input_lag_hz = options.input_lag_hz;
  if (options.input_delay >= 0) live.input_delay = options.input_delay;
  live.sensors = [sensors = options.sensors](Eigen::Index axes) {
    return SensorsOf(sensors, axes);
  };
  return live;
}

ExitStatus Run(const LiveCommandOptions& options) {
  LiveReport report(options.record_path);
  std::unique_ptr<PointSender> sender;
  const LiveIdentification* told = nullptr;
  LiveIdentification live(Wanted(options), [&](const ConvergencePoint& point) {
    report.Add(*told, point);
    if (sender) sender->Send(*told, point);
  });
  told = &live;
  Busy busy;
  if (options.session_path.empty()) {
    transport::LcmNetwork network = transport::ParseLcmNetwork(options.port);
    transport::TakeKey(network, options.key, "pretend to be the controller");
    sender = std::make_unique<PointSender>(network);
    Listen(options, network, live, report, busy);
  } else {
    Play(options, live, report, busy);
  }
  if (live.recursion()) busy.With([&] { live.recursion()->Finish(); });
  RefuseNothing(options, live);
  report.Finish(live, busy.s());
  WriteJsonFile(options.json_path, report.Json(live, busy.s()));
  TellWritten({options.record_path, options.json_path});
  const bool converged = live.recursion()->rows_to_converge().has_value();
  return options.until_converged && !converged ? ExitStatus::kOther : ExitStatus::kDone;
}

void AddModel(CLI::App& command, LiveCommandOptions& options) {
  HammersteinWienerOptions& model = options.live.model;
  model.bandwidth_hz = 400.0;  // at the rates of loops plain lags would hold next to nothing
  AddMemoryOptions(command, model);
  command
      .add_option("--input-lag-hz", options.input_lag_hz,
                  "Of amplifiers, for --products; 0 = none; default: the rig's slowest")
      ->check(CLI::NonNegativeNumber);
  command
      .add_option("--input-delay", options.input_delay,
                  "Samples of delay, for --products; default: the rig's")
      ->check(CLI::Range(0, 100));
  AddSensorOptions(command, options.sensors);
  command
      .add_option("--forgetting", model.forgetting,
                  "Weight of a row against the one after it; 1 = all count alike")
      ->check(CLI::Range(0.99, 1.0))
      ->capture_default_str();
  command
      .add_option("--tolerance", options.tolerance_percent,
                  "Change of any parameter in a second at which all stand still [%]")
      ->check(CLI::Range(1e-6, 100.0))
      ->capture_default_str();
}

}  // namespace

void AddIdentifyLive(CLI::App& identify, Action& action) {
  auto options = std::make_shared<LiveCommandOptions>();
  CLI::App* command =
      identify.add_subcommand("live", "Nonlinear model beside a running loop, and its convergence");
  command->footer(kLiveHelp);
  command->add_option("SESSION", options->session_path,
                      "A session instead of the network; without it a running loop is heard");
  AddNetworkOptions(*command, options->port, options->key);
  AddModel(*command, *options);
  command->add_flag("--until-converged", options->until_converged,
                    "End at the first second that is converged; status 1 when none was");
  command
      ->add_option("--patience", options->patience_s,
                   "How long nothing may come before the run counts as over, or as not there [s]")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  command->add_option("--record", options->record_path,
                      "Write the history of the convergence into this file, CSV");
  command->add_option("--json", options->json_path, "Write the result into this file");
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli
