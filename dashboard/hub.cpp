#include "dashboard/hub.hpp"

#include <utility>

namespace levitas::dashboard {
namespace {

void AddMessage(std::string& stream, const char* name, const std::string& json) {
  stream += "event: ";
  stream += name;
  stream += "\ndata: ";
  stream += json;
  stream += "\n\n";
}

}  // namespace

void Hub::Put(Topic topic, std::string json) {
  {
    const std::lock_guard lock(mutex_);
    Latest& latest = latest_[static_cast<std::size_t>(topic)];
    ++latest.version;
    latest.json = std::move(json);
  }
  changed_.notify_all();
}

void Hub::Forget(Topic topic) {
  const std::lock_guard lock(mutex_);
  latest_[static_cast<std::size_t>(topic)].json.clear();
}

void Hub::PutEvent(std::uint64_t number, std::string json) {
  {
    const std::lock_guard lock(mutex_);
    events_.emplace_back(number, std::move(json));
    if (events_.size() > kEvents) events_.pop_front();
  }
  changed_.notify_all();
}

void Hub::Close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

bool Hub::closed() const {
  const std::lock_guard lock(mutex_);
  return closed_;
}

bool Hub::News(const Seen& seen) const {
  for (std::size_t i = 0; i < kTopics; ++i) {
    if (latest_[i].NewTo(seen.topic[i])) return true;
  }
  return !events_.empty() && events_.back().first > seen.event;
}

std::string Hub::Wait(Seen& seen, std::chrono::milliseconds limit) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, limit, [&] { return closed_ || News(seen); });
  std::string stream;
  if (closed_) return stream;
  for (std::size_t i = 0; i < kTopics; ++i) {
    if (!latest_[i].NewTo(seen.topic[i])) continue;
    seen.topic[i] = latest_[i].version;
    AddMessage(stream, kTopicNames[i], latest_[i].json);
  }
  for (const auto& [number, json] : events_) {
    if (number <= seen.event) continue;
    seen.event = number;
    AddMessage(stream, "log", json);
  }
  return stream;
}

}  // namespace levitas::dashboard
