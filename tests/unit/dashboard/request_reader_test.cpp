#include "dashboard/request_reader.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace levitas::dashboard {
namespace {

constexpr std::string_view kGet = "GET /events?token=abc HTTP/1.1\r\nHost: localhost:8970\r\n\r\n";
constexpr std::string_view kPost =
    "POST /api/command HTTP/1.1\r\nHost: localhost\r\nX-Levitas: 1\r\nContent-Length: 18\r\n\r\n"
    "{\"command\":\"lift\"}";

/// As a socket gives it: pieces, never more than is wanted. Returns how many bytes were taken.
std::size_t Give(RequestReader& reader, std::string_view bytes, std::size_t piece = 4096) {
  std::size_t taken = 0;
  while (taken < bytes.size() && reader.Wanted() > 0) {
    const std::string_view next = bytes.substr(taken, std::min(piece, reader.Wanted()));
    reader.Take(next);
    taken += next.size();
  }
  return taken;
}

int StatusOf(const std::string& request) {
  RequestReader reader;
  Give(reader, request);
  return reader.refusal().status;
}

std::string WithHeaders(const std::string& headers) {
  return "POST /api/command HTTP/1.1\r\n" + headers + "\r\n";
}

TEST(RequestReader, GivesARequestWholeInPiecesOfAnySize) {
  for (std::size_t piece = 1; piece <= kPost.size(); ++piece) {
    RequestReader reader;
    EXPECT_EQ(Give(reader, kPost, piece), kPost.size());
    ASSERT_TRUE(reader.whole()) << piece;
    EXPECT_TRUE(reader.post());
    EXPECT_EQ(reader.path(), "/api/command");
    EXPECT_EQ(reader.body(), "{\"command\":\"lift\"}");
  }
  RequestReader reader;
  Give(reader, kGet);
  ASSERT_TRUE(reader.whole());
  EXPECT_FALSE(reader.post());
  EXPECT_EQ(reader.path(), "/events");
  EXPECT_EQ(reader.text(), "GET /events?token=abc HTTP/1.1\r\nhost: localhost:8970\r\n\r\n");
}

TEST(RequestReader, TakesNoMoreOfFourHundredMegabytesThanItsLimits) {
  constexpr std::size_t kSent = std::size_t{400} * 1024 * 1024;
  constexpr std::size_t kMost = RequestReader::kMostHeadBytes + RequestReader::kMostBodyBytes;
  const std::string much(1024 * 1024, 'a');
  struct Case {
    std::string begin;
    std::string more;  // repeated
    int status;
  };
  const std::vector<Case> cases{
      {WithHeaders("Transfer-Encoding: chunked\r\n"), "100000\r\n" + much + "\r\n", 411},
      {WithHeaders("X-Levitas: 1\r\n"), much, 411},
      {WithHeaders("Content-Length: 419430400\r\n"), much, 413},
      {"GET / HTTP/1.1\r\n", "X-Header: some value\r\n", 431},
      {"GET / HTTP/1.1\r\nX-Header: ", much, 431},
      {"GET /", much, 414},
      {"", much, 414},
  };
  for (const Case& given : cases) {
    RequestReader reader;
    std::size_t taken = Give(reader, given.begin);
    for (std::size_t sent = 0; sent < kSent && reader.Wanted() > 0; sent += given.more.size()) {
      taken += Give(reader, given.more);
      ASSERT_LE(reader.held_bytes(), kMost) << given.begin;
    }
    EXPECT_EQ(reader.refusal().status, given.status) << given.begin;
    EXPECT_LE(taken, kMost) << given.begin;
    EXPECT_EQ(reader.held_bytes(), 0U) << given.begin;
  }
}

TEST(RequestReader, StandsAtEachLimitAndRefusesOneMore) {
  const std::string path(RequestReader::kMostTargetBytes - 1, 'p');
  EXPECT_EQ(StatusOf("GET /" + path + " HTTP/1.1\r\n\r\n"), 0);
  EXPECT_EQ(StatusOf("GET /p" + path + " HTTP/1.1\r\n\r\n"), 414);
  std::string headers;
  for (std::size_t i = 0; i < RequestReader::kMostHeaders; ++i)
    headers += fmt::format("X-{}: 1\r\n", i);
  EXPECT_EQ(StatusOf("GET / HTTP/1.1\r\n" + headers + "\r\n"), 0);
  EXPECT_EQ(StatusOf("GET / HTTP/1.1\r\n" + headers + "Y: 1\r\n\r\n"), 431);
  EXPECT_EQ(StatusOf(WithHeaders("Content-Length: 65536\r\n")), 0);
  EXPECT_EQ(StatusOf(WithHeaders("Content-Length: 65537\r\n")), 413);
  EXPECT_EQ(StatusOf(WithHeaders("Content-Length: 99999999999999999999999\r\n")), 413);
}

TEST(RequestReader, RefusesWhatThePageNeverSends) {
  EXPECT_EQ(StatusOf("OPTIONS /api/command HTTP/1.1\r\n\r\n"), 405);
  EXPECT_EQ(StatusOf(WithHeaders("Content-Encoding: gzip\r\nContent-Length: 4\r\n")), 415);
  EXPECT_EQ(StatusOf(WithHeaders("Expect: 100-continue\r\nContent-Length: 4\r\n")), 417);
  for (const char* headers :
       {"Content-Length: 4\r\nContent-Length: 4\r\n", "Content-Length: -4\r\n",
        "Content-Length: 4x\r\n", "Content-Length:\r\n", "Host: a\r\nHost: b\r\n", "no colon\r\n",
        ": empty\r\n", "Host : a\r\n", "Host: a\r\n folded\r\n", "Host: a\nX: b\r\n",
        "Host: a\x01\r\n"}) {
    EXPECT_EQ(StatusOf(WithHeaders(headers)), 400) << headers;
  }
  for (const char* line :
       {"GET", "GET /", "GET / HTTP/2.0", "GET http://x/ HTTP/1.1", "GET /a b HTTP/1.1",
        "GET /%65vents HTTP/1.1", "GET /events# HTTP/1.1", " / HTTP/1.1 HTTP/1.1", ""}) {
    const int status = StatusOf(std::string(line) + "\r\n\r\n");
    EXPECT_TRUE(status == 400 || status == 405) << line;
  }
  EXPECT_EQ(StatusOf("GET / HTTP/1.1\r\nContent-Length: 4\r\n\r\n"), 400);
}

TEST(RequestReader, LetsNoHeaderThroughThatTheAnswersDoNotDependOn) {
  RequestReader reader;
  Give(reader,
       "GET / HTTP/1.1\r\nRange: bytes=0-1\r\nAccept-Encoding: gzip\r\nUpgrade: h2c\r\n"
       "Connection: keep-alive\r\nContent-Type: multipart/form-data; boundary=x\r\n"
       "Origin: http://a\r\nSEC-FETCH-SITE:  none \r\n\r\n");
  ASSERT_TRUE(reader.whole());
  EXPECT_EQ(reader.text(), "GET / HTTP/1.1\r\norigin: http://a\r\nsec-fetch-site: none\r\n\r\n");
}

TEST(RequestReader, EndsWithinItsLimitsWhateverIsSent) {
  // Requests in which bytes are changed, removed, repeated: written seed, so every run is the same.
  std::mt19937 random(20240611);
  const auto below = [&random](std::size_t end) {
    return std::uniform_int_distribution<std::size_t>(0, end - 1)(random);
  };
  constexpr std::string_view kSpecial{"\r\n: \0%/?HTTP10\xff", 15};
  int whole = 0;
  int refused = 0;
  for (int i = 0; i < 200'000; ++i) {
    std::string bytes(below(2) == 0 ? kGet : kPost);
    for (std::size_t changes = below(6); changes > 0 && !bytes.empty(); --changes) {
      const std::size_t at = below(bytes.size());
      const std::size_t kind = below(3);
      if (kind == 0) bytes[at] = kSpecial[below(kSpecial.size())];
      if (kind == 1) bytes.erase(at, 1 + below(20));
      if (kind == 2) bytes.insert(at, bytes.substr(below(bytes.size()), below(40)));
    }
    RequestReader reader;
    Give(reader, bytes, 1 + below(100));
    whole += reader.whole() ? 1 : 0;
    refused += reader.refusal().status != 0 ? 1 : 0;
    ASSERT_LE(reader.held_bytes(), RequestReader::kMostHeadBytes + RequestReader::kMostBodyBytes);
    if (!reader.whole()) continue;
    ASSERT_TRUE(reader.path().starts_with('/')) << bytes;
    ASSERT_LE(reader.body().size(), RequestReader::kMostBodyBytes);
    ASSERT_EQ(reader.Wanted(), 0U);
    // What the library reads is read in the same way again: it cannot mean something else.
    RequestReader again;
    Give(again, reader.text());
    ASSERT_TRUE(again.whole()) << bytes;
    ASSERT_EQ(again.text(), reader.text());
  }
  EXPECT_GT(whole, 1000);
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace levitas::dashboard
