// The server before plain sockets. No time is asserted: a client that must not wait for another one
// is answered while the other still holds what it holds.
#include "dashboard/web_server.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <condition_variable>
#include <cstdint>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "common/file_descriptor.hpp"
#include "dashboard/command_api.hpp"

namespace levitas::dashboard {
namespace {

constexpr const char* kStop = R"({"command":"emergency_stop"})";

class Client {
 public:
  explicit Client(int port) : connection_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): the interface of sockets
    const auto* const where = reinterpret_cast<const sockaddr*>(&address);
    EXPECT_EQ(::connect(connection_.handle(), where, sizeof address), 0);
  }

  bool Send(const std::string& text) const {
    return ::send(connection_.handle(), text.data(), text.size(), MSG_NOSIGNAL) ==
           static_cast<ssize_t>(text.size());
  }

  /// Until `wanted` was received, or the connection ended.
  std::string Receive(const std::string& wanted) const {
    std::string text;
    std::array<char, 4096> piece{};
    while (text.find(wanted) == std::string::npos) {
      const ssize_t count = ::recv(connection_.handle(), piece.data(), piece.size(), 0);
      if (count <= 0) break;
      text.append(piece.data(), static_cast<std::size_t>(count));
    }
    return text;
  }

 private:
  FileDescriptor connection_;
};

std::string Post(const std::string& body, const std::string& headers = "X-Levitas: 1\r\n") {
  return fmt::format(
      "POST /api/command HTTP/1.1\r\nHost: localhost\r\n{}Content-Length: {}\r\n\r\n{}", headers,
      body.size(), body);
}

std::string Get(const std::string& path, const std::string& headers = "") {
  return fmt::format("GET {} HTTP/1.1\r\nHost: localhost\r\n{}\r\n", path, headers);
}

int StatusIn(const std::string& answer) {
  return answer.starts_with("HTTP/1.1 ") ? std::stoi(answer.substr(9, 3)) : 0;
}

class ThePage : public testing::Test {
 protected:
  ThePage() { options_.port = 0; }
  ~ThePage() override {
    released_.set_value();
    server_.reset();
    for (const auto& done : unanswered_) done(Answer(kHttpOk, "accepted", "too late"));
  }

  int Port() {
    if (!server_) server_ = std::make_unique<WebServer>(options_, hub_, Routes(), Stops());
    const std::string url = server_->Url();
    return std::stoi(url.substr(url.rfind(':') + 1));
  }

  int StatusOf(const std::string& request) {
    const Client client(Port());
    EXPECT_TRUE(client.Send(request));
    return StatusIn(client.Receive("never sent"));
  }

  /// "lift" is answered when the test ends, as by a controller that says nothing.
  std::vector<Route> Routes() {
    return {{true, "/api/command", [until = released_.get_future().share()](const auto& body) {
               if (body.find("lift") != std::string::npos) until.wait();
               return Answer(kHttpOk, "accepted", body);
             }}};
  }

  /// Answered at once, or never.
  StopRoute Stops() {
    return {AsksForStop, [this](StopRoute::Done done) {
              {
                const std::lock_guard lock(stops_mutex_);
                ++stops_;
                if (silent_) unanswered_.push_back(done);
              }
              stopped_.notify_all();
              if (!silent_) done(Answer(kHttpOk, "accepted", "stopped"));
            }};
  }

  /// Waits until so many stops were handed on; a wait for ever is the failure.
  void WaitForStops(std::size_t count) {
    std::unique_lock lock(stops_mutex_);
    stopped_.wait(lock, [&] { return stops_ >= count; });
  }

  bool silent_{false};
  std::mutex stops_mutex_;
  std::condition_variable stopped_;
  std::size_t stops_{0};
  std::vector<StopRoute::Done> unanswered_;
  WebOptions options_;
  std::promise<void> released_;
  Hub hub_;
  std::unique_ptr<WebServer> server_;
};

TEST_F(ThePage, AnswersTheStopWhileOthersSendTheirRequestsForEver) {
  const int port = Port();
  std::vector<Client> slow;
  for (int i = 0; i < 200; ++i) {
    const Client& client = slow.emplace_back(port);
    if (i % 3 == 0) continue;  // says nothing at all
    ASSERT_TRUE(client.Send(i % 3 == 1 ? "POST /api/command HTTP/1.1\r\nHost: localhost\r\nX-A: "
                                       : "POST /api/command HTTP/1.1\r\nHost: localhost\r\n"
                                         "Content-Length: 60000\r\n\r\n"));
  }
  EXPECT_EQ(StatusOf(Post(kStop)), 200);
}

TEST_F(ThePage, AnswersTheStopWhileEveryOtherCommandWaitsForTheController) {
  const int port = Port();
  // The first request makes tables of the library under a guard that the thread sanitizer does not
  // see; here many requests would be the first.
  ASSERT_EQ(StatusOf(Get("/")), 200);
  std::vector<Client> waiting;
  for (int i = 0; i < 64; ++i) {
    EXPECT_TRUE(waiting.emplace_back(port).Send(Post(R"({"command":"lift"})")));
  }
  EXPECT_EQ(StatusOf(Post(kStop)), 200);
  EXPECT_EQ(StatusOf(Get("/")), 200);
}

TEST_F(ThePage, AnswersTheStopWithEveryViewersPlaceTaken) {
  const int port = Port();
  std::vector<Client> viewers;
  for (int i = 0; i < WebServer::kMaxViewers; ++i) {
    const Client& viewer = viewers.emplace_back(port);
    ASSERT_TRUE(viewer.Send(Get("/events")));
    ASSERT_EQ(StatusIn(viewer.Receive("\r\n\r\n")), 200);
  }
  EXPECT_EQ(StatusOf(Get("/events")), 503);
  EXPECT_EQ(StatusOf(Post(kStop)), 200);
  EXPECT_EQ(StatusOf(Get("/")), 200);
}

// A controller that is slow or gone: whatever number of people wait for its word, the next stop is
// sent, and the page serves.
TEST_F(ThePage, PassesTheTwoHundredAndFirstStopOnWhileTwoHundredWaitForTheirAnswers) {
  silent_ = true;
  const int port = Port();
  std::vector<Client> waiting;
  for (int i = 0; i < 200; ++i) ASSERT_TRUE(waiting.emplace_back(port).Send(Post(kStop)));
  WaitForStops(200);
  const Client next(port);
  ASSERT_TRUE(next.Send(Post(kStop)));
  WaitForStops(201);
  EXPECT_EQ(StatusOf(Get("/")), 200);
  unanswered_[200](Answer(kHttpOk, "accepted", "tripped"));
  EXPECT_EQ(StatusIn(next.Receive("tripped")), 200);
}

TEST_F(ThePage, PassesOnEveryStopOfManyMoreThanWaitAndTellsNoneThatThereIsNoRoom) {
  silent_ = true;
  const int port = Port();
  std::vector<Client> waiting;
  for (std::size_t i = 0; i < WebServer::kMostStops; ++i) {
    ASSERT_TRUE(waiting.emplace_back(port).Send(Post(kStop)));
  }
  WaitForStops(WebServer::kMostStops);
  for (std::size_t more = 1; more <= 20; ++more) {
    const Client client(port);
    ASSERT_TRUE(client.Send(Post(kStop)));
    WaitForStops(WebServer::kMostStops + more);
    const std::string answer = client.Receive("never sent");
    EXPECT_EQ(StatusIn(answer), 504);
    EXPECT_NE(answer.find("emergency_stop was sent"), std::string::npos) << answer;
  }
}

TEST_F(ThePage, KnowsAStopHoweverItIsWrittenAndNothingElse) {
  for (const char* stop :
       {R"({"command":"emergency_stop"})", R"({ "command" : "emerg\u0065ncy_stop" })"}) {
    EXPECT_EQ(StatusOf(Post(stop)), 200) << stop;
  }
  EXPECT_EQ(stops_, 2U);
  for (const char* other : {R"({"x":"emergency_stop"})", R"({"command":"emergency_stop","x":1})",
                            R"({"command":"emergency_stops"})", "emergency_stop", ""}) {
    (void)StatusOf(Post(other));
  }
  EXPECT_EQ(StatusOf(Post(kStop, "")), 403);  // without the page's header
  EXPECT_EQ(stops_, 2U);
}

TEST_F(ThePage, RefusesAnotherPageOnEveryPathAndGivesItNoViewersPlace) {
  for (const char* foreign : {"Origin: http://evil.example\r\n", "Origin: null\r\n",
                              "Sec-Fetch-Site: cross-site\r\n", "Sec-Fetch-Site: same-site\r\n"}) {
    for (const char* path : {"/", "/main.js", "/events", "/api/scope.json", "/none"}) {
      EXPECT_EQ(StatusOf(Get(path, foreign)), 403) << path << ' ' << foreign;
    }
    EXPECT_EQ(StatusOf(Post(kStop, std::string("X-Levitas: 1\r\n") + foreign)), 403) << foreign;
  }
  EXPECT_EQ(server_->viewers(), 0);
  const std::string own =
      "X-Levitas: 1\r\nOrigin: http://localhost\r\nSec-Fetch-Site: same-origin\r\n";
  EXPECT_EQ(StatusOf(Post(kStop, own)), 200);
  EXPECT_EQ(StatusOf(Get("/", "Sec-Fetch-Site: none\r\n")), 200);
}

TEST_F(ThePage, TellsWhoeverSendsTooMuchAndEndsTheConnection) {
  const std::string much(std::size_t{64} * 1024, 'a');
  for (const auto& [begin, status] : std::vector<std::pair<std::string, int>>{
           {"POST /api/command HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n",
            411},
           {"POST /api/command HTTP/1.1\r\nHost: localhost\r\n\r\n", 411},
           {"POST /api/command HTTP/1.1\r\nHost: localhost\r\nContent-Length: 419430400\r\n\r\n",
            413},
           {"GET / HTTP/1.1\r\nHost: localhost\r\nX: ", 431},
           {"GET /", 414}}) {
    const Client client(Port());
    EXPECT_TRUE(client.Send(begin));
    (void)client.Send(much);
    EXPECT_EQ(StatusIn(client.Receive("never sent")), status) << begin;
    // What is still sent is not read for ever: sooner or later sending fails.
    std::size_t sent = 0;
    while (sent < std::size_t{400} * 1024 * 1024 && client.Send(much)) sent += much.size();
    EXPECT_LT(sent, std::size_t{400} * 1024 * 1024) << begin;
  }
}

TEST_F(ThePage, IsTakenWholeByAClientThatSaysItSendsNoMore) {
  options_.token = "0123456789abcdef";
  const Client client(Port());
  ASSERT_TRUE(client.Send("GET / HTTP/1.0\r\n\r\n"));
  const std::string page = client.Receive("</html>");
  EXPECT_EQ(StatusIn(page), 200);
  EXPECT_NE(page.find("EMERGENCY STOP"), std::string::npos);
}

}  // namespace
}  // namespace levitas::dashboard
