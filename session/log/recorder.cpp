#include "session/log/recorder.hpp"

#include <fmt/core.h>
#include <pthread.h>
#include <sched.h>

#include <chrono>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "common/problem.hpp"
#include "common/spsc_ring.hpp"
#include "rt/thread_trouble.hpp"
#include "session/log/event_deriver.hpp"
#include "session/log/trip_freezer.hpp"

namespace levitas::session {
namespace {

using Clock = std::chrono::steady_clock;
// 3 s at 10 kHz: more than a disk that syncs its journal makes a writer wait.
constexpr std::size_t kRingRecords = 32'768;
// 0.2 s at 10 kHz.
constexpr std::size_t kRingBatches = 64;
constexpr auto kIdle = std::chrono::milliseconds(5);
constexpr auto kFullPause = std::chrono::microseconds(200);
// With kIdle well below the promised 50 ms.
constexpr auto kFlushEvery = std::chrono::milliseconds(25);

/// The recorder inherits the loop's SCHED_FIFO when it is made in the loop's thread; it must never
/// compete with it. Failure is harmless: then it was not real time in the first place.
void LeaveRealTime() noexcept {
  sched_param parameters{};
  (void)::pthread_setschedparam(::pthread_self(), SCHED_OTHER, &parameters);
}

}  // namespace

struct Recorder::Impl {
  explicit Impl(RecorderOptions given)
      : options(std::move(given)),
        ring(kRingRecords),
        torsion_ring(kRingBatches),
        deriver(options.header.channels, options.header.period_ns, options.header.synchronous) {
    if (!options.session_path.empty()) {
      session = std::make_unique<SessionWriter>(options.session_path, options.header,
                                                Standing::kReplaced, options.patience);
      recording = true;
    }
    SessionHeader excerpt = options.header;
    excerpt.excerpt_of = options.session_path;
    freezer = std::make_unique<TripFreezer>(options.trip_folder, excerpt, options.trip_window_s,
                                            options.trip_budget);
    thread = std::thread([this] { Run(); });
  }

  void Run() {
    LeaveRealTime();
    Clock::time_point flushed = Clock::now();
    for (;;) {
      const bool last_round = stop.load(std::memory_order_acquire);
      cycle::CycleRecord record;
      // Bounded, so that a loop as fast as this thread cannot keep it from flushing.
      constexpr int kBurst = 1000;
      int taken = 0;
      while (taken < kBurst && ring.Take(record)) {
        // Whatever happens here, the ring is emptied: in lockstep the loop waits for room in it.
        rt::Guarded("recorder", [&] { Take(record); });
        ++taken;
      }
      if (taken == kBurst) {
        if (Clock::now() - flushed < kFlushEvery) continue;
      } else if (last_round) {
        break;
      }
      if (Clock::now() - flushed >= kFlushEvery) {
        rt::Guarded("recorder", [this] { Flush(); });
        flushed = Clock::now();
      }
      if (taken < kBurst) std::this_thread::sleep_for(kIdle);
    }
    rt::Guarded("recorder", [this] { End(); });
  }

  void End() {
    WriteTorsion(nullptr);
    events.clear();
    deriver.Finish(events);
    Tell();
    Freeze([this] { freezer->Finish(); });
    Publish();
    Flush();
  }

  void Take(const cycle::CycleRecord& record) {
    events.clear();
    deriver.Step(record, events);
    WriteTorsion(&record.in.frame);
    Record([&] { session->Write(record); });
    Freeze([&] { freezer->Take(record, events); });
    Publish();
    Tell();
    if (options.on_record) options.on_record(record);
  }

  /// Batches that ended before this frame; all of them without one. One that came with a later
  /// frame waits for its turn, so that the order does not depend on how far behind this thread is.
  void WriteTorsion(const SensorFrame* before) {
    TorsionBatch batch;
    while (waiting || torsion_ring.Take(batch)) {
      if (!waiting) waiting = batch;
      const bool later = before != nullptr && waiting->rig_session == before->rig_session &&
                         waiting->first_cycle + waiting->samples > before->cycle;
      if (later) return;
      Record([this] { session->Write(*waiting); });
      waiting.reset();
    }
  }

  /// Writes and reports the derived events.
  void Tell() {
    for (const Event& event : events) {
      Record([&] { session->Write(event); });
      if (options.on_event) options.on_event(event);
    }
  }

  void Flush() {
    Record([this] { session->Flush(); });
    Freeze([this] { freezer->Flush(); });
  }

  void Publish() {
    if (freezer->newest() == published) return;
    published = freezer->newest();
    const std::lock_guard lock(trip_mutex);
    trip_path = published;
  }

  /// A full disk ends the recording with one message; all else goes on.
  template <class Function>
  void Record(Function function) {
    if (!recording) return;
    try {
      function();
    } catch (const std::exception& error) {
      recording = false;
      Warn(error.what());
    }
  }

  /// A full disk ends the trip file at hand; the next trip may find room again.
  template <class Function>
  void Freeze(Function function) {
    try {
      function();
    } catch (const std::exception& error) {
      freezer->Abandon();
      Warn(error.what());
    }
    TellTripFolder();
  }

  /// What this run removed of its own, and once what it found of earlier runs.
  void TellTripFolder() {
    const OlderTrips older = freezer->TakeOlder();
    if (older.files >= options.trip_budget.files || older.bytes > options.trip_budget.bytes) {
      Warn(
          fmt::format("trip folder: {} trip files of earlier runs, {} MB, are kept: remove them "
                      "when they are no longer needed",
                      older.files, older.bytes >> 20U));
    }
    const std::vector<std::string> removed = freezer->TakeRemoved();
    if (removed.empty()) return;
    std::string names;
    for (const std::string& name : removed) names += (names.empty() ? "" : ", ") + name;
    Warn(
        fmt::format("trip folder: older ones of this run removed, of which it keeps {} files and "
                    "{} MB (--trip-budget): {}",
                    options.trip_budget.files, options.trip_budget.bytes >> 20U, names));
  }

  void Warn(const std::string& text) {
    Event told;
    told.severity = Event::Severity::kWarning;
    told.text = text;
    if (options.on_event) options.on_event(told);
  }

  RecorderOptions options;
  SpscRing<cycle::CycleRecord> ring;
  SpscRing<TorsionBatch> torsion_ring;
  std::optional<TorsionBatch> waiting;
  EventDeriver deriver;
  std::unique_ptr<SessionWriter> session;
  std::unique_ptr<TripFreezer> freezer;  ///< never null
  std::vector<Event> events;
  bool recording{false};
  std::string published;  ///< recorder's thread
  mutable std::mutex trip_mutex;
  std::string trip_path;
  std::atomic<bool> stop{false};
  std::thread thread;
};

Recorder::Recorder(RecorderOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {}

Recorder::~Recorder() { Finish(); }

void Recorder::Finish() noexcept {
  if (!impl_->thread.joinable()) return;
  impl_->stop.store(true, std::memory_order_release);
  impl_->thread.join();
}

void Recorder::Post(const cycle::CycleRecord& record) noexcept {
  while (impl_->options.waits_for_room && impl_->ring.Full()) {
    std::this_thread::sleep_for(kFullPause);
  }
  impl_->ring.Post(record);
}
// All records of a batch's instants but the last are posted before it: this thread's wait ends.
void Recorder::PostTorsion(const TorsionBatch& batch) noexcept {
  while (impl_->options.waits_for_room && impl_->torsion_ring.Full()) {
    std::this_thread::sleep_for(kFullPause);
  }
  impl_->torsion_ring.Post(batch);
}

std::uint64_t Recorder::lost() const noexcept { return impl_->ring.lost(); }

std::string Recorder::trip_file() const {
  const std::lock_guard lock(impl_->trip_mutex);
  return impl_->trip_path;
}

}  // namespace levitas::session
