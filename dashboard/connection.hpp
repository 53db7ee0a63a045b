#pragma once
// A connected socket that closes with its owner.
// Thread    one at a time.

#include <unistd.h>

#include <utility>

namespace levitas::dashboard {

class Connection {
 public:
  explicit Connection(int socket) noexcept : socket_(socket) {}
  Connection(Connection&& other) noexcept : socket_(std::exchange(other.socket_, kNone)) {}
  Connection& operator=(Connection&& other) noexcept {
    std::swap(socket_, other.socket_);
    return *this;
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  ~Connection() {
    if (socket_ != kNone) (void)::close(socket_);
  }

  [[nodiscard]] int socket() const noexcept { return socket_; }

 private:
  static constexpr int kNone = -1;
  int socket_;
};

}  // namespace levitas::dashboard
