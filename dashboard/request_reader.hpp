#pragma once
// One HTTP request as it arrives, bounded before anything else sees it.
//
// Takes     bytes in pieces of any size, keeps what it must and says when the request is whole, or
//           why it is refused. It never holds more than kMostHeadBytes + kMostBodyBytes.
// Refuses   what the page never sends: a target of more than kMostTargetBytes (414), more than
//           kMostHeaders or kMostHeadBytes of headers (431), a body of more than kMostBodyBytes
//           (413), of unknown length (411), coded (415) or announced by Expect (417), other methods
//           than GET, HEAD and POST (405), and whatever is ambiguous (400): bare line ends, folded
//           lines, control characters, two lengths, a name that counts given twice.
// Gives     the request written anew, with those headers only that the page's answers depend on: no
//           other reaches the HTTP library (ranges, codings, forms, upgrades).
// Thread    one. Failure: none; see refusal().

#include <cstddef>
#include <string>
#include <string_view>

namespace levitas::dashboard {

class RequestReader {
 public:
  static constexpr std::size_t kMostTargetBytes = 2048;
  static constexpr std::size_t kMostHeadBytes = std::size_t{16} * 1024;
  static constexpr std::size_t kMostBodyBytes = std::size_t{64} * 1024;
  static constexpr std::size_t kMostHeaders = 64;

  struct Refusal {
    int status{};  ///< 0: none
    const char* why{""};
  };

  /// How many more bytes are of use; 0 when whole or refused. Never give it more than that.
  [[nodiscard]] std::size_t Wanted() const;
  void Take(std::string_view bytes);

  [[nodiscard]] bool whole() const noexcept { return state_ == State::kWhole; }
  [[nodiscard]] const Refusal& refusal() const noexcept { return refusal_; }
  [[nodiscard]] bool begun() const noexcept { return begun_; }
  [[nodiscard]] bool head_read() const noexcept { return state_ != State::kHead; }
  [[nodiscard]] std::size_t held_bytes() const noexcept { return head_.size() + text_.size(); }

  // Of a whole request.
  [[nodiscard]] bool post() const noexcept { return post_; }
  [[nodiscard]] std::string_view path() const noexcept { return path_; }  ///< without the query
  [[nodiscard]] std::string_view body() const;
  /// For the library.
  [[nodiscard]] const std::string& text() const noexcept { return text_; }

 private:
  enum class State { kHead, kBody, kWhole, kRefused };

  void Refuse(int status, const char* why);
  void EndOfHead(std::size_t end);
  [[nodiscard]] bool TakeRequestLine(std::string_view line);
  [[nodiscard]] bool TakeHeader(std::string_view line);
  [[nodiscard]] bool TakeLength(std::string_view value);
  [[nodiscard]] bool Keep(std::string_view name, std::string_view value);
  void Finish(std::string_view body_so_far);

  State state_{State::kHead};
  Refusal refusal_;
  bool begun_{false};
  bool post_{false};
  bool has_length_{false};
  unsigned kept_{0};           ///< bit i: kKeptHeaders[i] was given
  std::size_t body_bytes_{0};  ///< as announced
  std::size_t body_begin_{0};  ///< in text_
  std::string path_;
  std::string head_;  ///< as it came, until its end was seen
  std::string text_;
};

}  // namespace levitas::dashboard
