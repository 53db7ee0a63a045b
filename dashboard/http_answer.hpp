#pragma once
// What a request of the page is answered with, and how requests find who answers them.

#include <functional>
#include <string>
#include <vector>

namespace levitas::dashboard {

inline constexpr int kHttpOk = 200;
inline constexpr int kHttpBadRequest = 400;
inline constexpr int kHttpNotFound = 404;
inline constexpr int kHttpConflict = 409;
inline constexpr int kHttpGatewayTimeout = 504;

struct HttpAnswer {
  int status{};
  std::string body;
  const char* type{"application/json"};
};

/// {"outcome": ..., "text": ...}
[[nodiscard]] HttpAnswer Answer(int status, const char* outcome, const std::string& text);

/// Called in a thread of the server, several at once.
struct Route {
  bool post{};  ///< else GET
  const char* path{};
  std::function<HttpAnswer(const std::string& body)> answer;
};

/// The one request that waits for nothing: its path is that of a POST route, which answers every
/// other body.
struct StopRoute {
  using Done = std::function<void(const HttpAnswer&)>;
  /// Whether this body asks for an emergency stop; null: none does.
  std::function<bool(const std::string& body)> asks{};
  /// Stops, without waiting; `done` is called once, in any thread, perhaps before it returns.
  std::function<void(Done done)> stop{};
};

}  // namespace levitas::dashboard
