#include "dashboard/request_reader.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace levitas::dashboard {
namespace {

constexpr int kBadRequest = 400;
constexpr int kMethodNotAllowed = 405;
constexpr int kLengthRequired = 411;
constexpr int kTooLarge = 413;
constexpr int kTargetTooLong = 414;
constexpr int kCodedBody = 415;
constexpr int kExpectationFailed = 417;
constexpr int kHeadTooLarge = 431;

constexpr std::string_view kLineEnd = "\r\n";
constexpr std::string_view kHeadEnd = "\r\n\r\n";

/// What the answers depend on (access.hpp); no other header reaches the library.
constexpr std::array<std::string_view, 5> kKeptHeaders{"host", "origin", "sec-fetch-site",
                                                       "x-levitas", "x-levitas-token"};

std::string Lower(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

bool IsNameCharacter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view("!#$%&'*+-.^_`|~").find(c) != std::string_view::npos;
}

/// Visible characters and those beyond ASCII; space and tab where a header's value may hold them.
bool IsText(std::string_view text, bool spaces) {
  return std::all_of(text.begin(), text.end(), [spaces](char c) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == ' ' || c == '\t') return spaces;
    return byte > 0x20 && byte != 0x7f;
  });
}

std::string_view Trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

}  // namespace

std::size_t RequestReader::Wanted() const {
  if (state_ == State::kHead) return kMostHeadBytes - head_.size();
  if (state_ == State::kBody) return body_begin_ + body_bytes_ - text_.size();
  return 0;
}

std::string_view RequestReader::body() const { return std::string_view(text_).substr(body_begin_); }

void RequestReader::Refuse(int status, const char* why) {
  state_ = State::kRefused;
  refusal_ = {status, why};
  head_.clear();
  text_.clear();
  body_begin_ = 0;
}

void RequestReader::Take(std::string_view bytes) {
  if (!bytes.empty()) begun_ = true;
  if (state_ == State::kBody) {
    text_ += bytes.substr(0, Wanted());
    if (Wanted() == 0) state_ = State::kWhole;
    return;
  }
  if (state_ != State::kHead) return;
  // The end may lie across two pieces.
  const std::size_t from = head_.size() < kHeadEnd.size() ? 0 : head_.size() - kHeadEnd.size() + 1;
  head_ += bytes.substr(0, Wanted());
  const std::size_t end = head_.find(kHeadEnd, from);
  if (end != std::string::npos) {
    EndOfHead(end);
    return;
  }
  if (Wanted() > 0) return;
  const bool line_ended = head_.find(kLineEnd) <= kMostTargetBytes;
  Refuse(line_ended ? kHeadTooLarge : kTargetTooLong,
         line_ended ? "the headers are too long" : "the address is too long");
}

void RequestReader::EndOfHead(std::size_t end) {
  const std::string_view head = std::string_view(head_).substr(0, end);
  std::size_t count = 0;
  for (std::size_t at = 0; at <= head.size(); ++count) {
    const std::size_t line_end = std::min(head.find(kLineEnd, at), head.size());
    const std::string_view line = head.substr(at, line_end - at);
    if (count > kMostHeaders) return Refuse(kHeadTooLarge, "there are too many headers");
    if (!(count == 0 ? TakeRequestLine(line) : TakeHeader(line))) return;
    at = line_end + kLineEnd.size();
  }
  if (post_ && !has_length_) {
    return Refuse(kLengthRequired, "send the body with a Content-Length");
  }
  if (!post_ && body_bytes_ > 0) return Refuse(kBadRequest, "only POST carries a body");
  Finish(std::string_view(head_).substr(end + kHeadEnd.size()));
}

void RequestReader::Finish(std::string_view body_so_far) {
  if (post_) text_ += fmt::format("Content-Length: {}\r\n", body_bytes_);
  text_ += kLineEnd;
  body_begin_ = text_.size();
  // What follows the body would be another request; there is one for each connection.
  text_ += body_so_far.substr(0, body_bytes_);
  head_.clear();
  head_.shrink_to_fit();
  state_ = State::kBody;
  if (Wanted() == 0) state_ = State::kWhole;
}

bool RequestReader::TakeRequestLine(std::string_view line) {
  const std::size_t first = line.find(' ');
  const std::size_t last = line.rfind(' ');
  const std::string_view version = last == std::string_view::npos ? "" : line.substr(last + 1);
  if (first >= last || (version != "HTTP/1.1" && version != "HTTP/1.0")) {
    Refuse(kBadRequest, "the first line is no request of HTTP/1.1");
    return false;
  }
  const std::string_view method = line.substr(0, first);
  const std::string_view target = line.substr(first + 1, last - first - 1);
  if (method != "GET" && method != "HEAD" && method != "POST") {
    Refuse(kMethodNotAllowed, "there are GET, HEAD and POST");
    return false;
  }
  if (target.size() > kMostTargetBytes) {
    Refuse(kTargetTooLong, "the address is too long");
    return false;
  }
  const std::string_view path = target.substr(0, target.find('?'));
  // No path of the page is written with %: so there is one way to write each.
  if (!path.starts_with('/') || path.find_first_of("%#") != std::string_view::npos ||
      !IsText(target, false)) {
    Refuse(kBadRequest, "the address is malformed");
    return false;
  }
  post_ = method == "POST";
  path_ = path;
  text_ = fmt::format("{} {} HTTP/1.1\r\n", method, target);
  return true;
}

bool RequestReader::TakeHeader(std::string_view line) {
  const std::size_t colon = line.find(':');
  const std::string_view name = line.substr(0, colon);
  if (colon == std::string_view::npos || name.empty() ||
      !std::all_of(name.begin(), name.end(), IsNameCharacter) ||
      !IsText(line.substr(colon + 1), true)) {
    Refuse(kBadRequest, "a header is malformed");
    return false;
  }
  const std::string lower = Lower(name);
  const std::string_view value = Trimmed(line.substr(colon + 1));
  if (lower == "content-length") return TakeLength(value);
  if (lower == "transfer-encoding") {
    Refuse(kLengthRequired, "send the body with a Content-Length");
    return false;
  }
  if (lower == "content-encoding") {
    Refuse(kCodedBody, "send the body as it is");
    return false;
  }
  if (lower == "expect") {
    Refuse(kExpectationFailed, "send the body at once");
    return false;
  }
  return Keep(lower, value);
}

bool RequestReader::TakeLength(std::string_view value) {
  std::size_t length = 0;
  const char* const end = value.data() + value.size();
  const auto [rest, problem] = std::from_chars(value.data(), end, length);
  if (problem == std::errc::result_out_of_range || length > kMostBodyBytes) {
    Refuse(kTooLarge, "the body is too long");
    return false;
  }
  if (has_length_ || problem != std::errc() || rest != end) {
    Refuse(kBadRequest, "the Content-Length is no number, or given twice");
    return false;
  }
  has_length_ = true;
  body_bytes_ = length;
  return true;
}

bool RequestReader::Keep(std::string_view name, std::string_view value) {
  const auto* const found = std::find(kKeptHeaders.begin(), kKeptHeaders.end(), name);
  if (found == kKeptHeaders.end()) return true;
  const unsigned bit = 1U << static_cast<unsigned>(found - kKeptHeaders.begin());
  if ((kept_ & bit) != 0) {
    Refuse(kBadRequest, "a header is given twice");
    return false;
  }
  kept_ |= bit;
  text_ += fmt::format("{}: {}\r\n", name, value);
  return true;
}

}  // namespace levitas::dashboard
