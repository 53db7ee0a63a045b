#include "dashboard/stop_desk.hpp"

#include <fmt/core.h>
#include <sys/socket.h>

#include <string>
#include <utility>

namespace levitas::dashboard {

namespace {

void Write(const FileDescriptor& connection, const HttpAnswer& answer) {
  const std::string text = fmt::format(
      "HTTP/1.1 {} {}\r\nConnection: close\r\nCache-Control: no-store\r\nContent-Type: {}\r\n"
      "Content-Length: {}\r\n\r\n{}",
      answer.status, answer.status == kHttpOk ? "OK" : "Stop", answer.type, answer.body.size(),
      answer.body);
  (void)::send(connection.handle(), text.data(), text.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
}

}  // namespace

StopDesk::StopDesk(std::size_t most, SeeOut see_out)
    : most_(most), shared_(std::make_shared<Shared>()) {
  shared_->see_out = std::move(see_out);
}

StopRoute::Done StopDesk::Wait(FileDescriptor connection) {
  const auto finish = [](Shared& shared, FileDescriptor done, const HttpAnswer& answer) {
    Write(done, answer);
    if (shared.see_out) shared.see_out(std::move(done));
  };
  const std::lock_guard lock(shared_->mutex);
  if (shared_->waiting >= most_) {
    finish(*shared_, std::move(connection),
           Answer(kHttpGatewayTimeout, "unanswered",
                  fmt::format("emergency_stop was sent; {} others wait for the controller's word "
                              "on theirs",
                              shared_->waiting)));
    return [](const HttpAnswer&) {};
  }
  ++shared_->waiting;
  auto kept = std::make_shared<FileDescriptor>(std::move(connection));
  return [shared = shared_, kept, finish](const HttpAnswer& answer) {
    const std::lock_guard inner(shared->mutex);
    if (!kept->is_open()) return;
    --shared->waiting;
    finish(*shared, std::move(*kept), answer);
  };
}

void StopDesk::Close() {
  const std::lock_guard lock(shared_->mutex);
  shared_->see_out = nullptr;
}

}  // namespace levitas::dashboard
