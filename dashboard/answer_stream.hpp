#pragma once
// What the HTTP library reads a whole request from, and writes its answer to.
//
// Bounds    writing ends in failure after kTakesNothing without a byte taken, and `within` after
//           its first byte if given: a client that reads slowly holds its thread no longer. How
//           long the answer takes to be found does not count.
// Thread    one. Failure: of the library's kind, -1.

#include <httplib.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace levitas::dashboard {

class AnswerStream final : public httplib::Stream {
 public:
  static constexpr std::chrono::milliseconds kTakesNothing{3000};

  using Now = std::function<std::chrono::steady_clock::time_point()>;

  /// `request` must outlive this; `socket` does not block.
  AnswerStream(int socket, std::string_view request,
               std::optional<std::chrono::milliseconds> within,
               Now now = std::chrono::steady_clock::now);

  [[nodiscard]] bool is_readable() const override { return true; }
  /// Waits; false when the client has gone.
  [[nodiscard]] bool is_writable() const override;
  ssize_t read(char* to, std::size_t size) override;
  ssize_t write(const char* from, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  [[nodiscard]] socket_t socket() const override { return socket_; }

 private:
  int socket_;
  Now now_;
  std::string_view unread_;
  std::optional<std::chrono::milliseconds> within_;
  std::optional<std::chrono::steady_clock::time_point> end_;  ///< from the first byte on
};

/// The same with the answer kept as text: nothing is waited for.
class KeptAnswer final : public httplib::Stream {
 public:
  explicit KeptAnswer(std::string_view request) : unread_(request) {}

  [[nodiscard]] bool is_readable() const override { return true; }
  [[nodiscard]] bool is_writable() const override { return true; }
  ssize_t read(char* to, std::size_t size) override;
  ssize_t write(const char* from, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  [[nodiscard]] socket_t socket() const override { return INVALID_SOCKET; }
  [[nodiscard]] const std::string& text() const noexcept { return text_; }

 private:
  std::string_view unread_;
  std::string text_;
};

}  // namespace levitas::dashboard
