// A request of the page, in pieces of every size: never more held than promised, whole or refused
// and never both, and the same whatever the pieces. The first byte of the input sets their sizes.

#include <algorithm>

#include "dashboard/request_reader.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/fuzz/verify.hpp"

namespace levitas::fuzz {
namespace {

using dashboard::RequestReader;

void Check(const RequestReader& reader) {
  const bool refused = reader.refusal().status != 0;
  Verify(reader.held_bytes() <= RequestReader::kMostHeadBytes + RequestReader::kMostBodyBytes,
         "no more is held than promised");
  Verify(!(refused && reader.whole()), "a request is whole or refused, not both");
  Verify((reader.Wanted() == 0) == (refused || reader.whole()), "it wants bytes until it is over");
  if (refused) {
    Verify(reader.refusal().status >= 400 && reader.refusal().status < 500, "a refusal is a 4xx");
    Verify(reader.held_bytes() == 0, "nothing is held of what is refused");
  }
  if (!reader.whole()) return;
  const std::string_view text = reader.text();
  Verify(reader.path().starts_with('/'), "a path begins with a stroke");
  Verify(text.find(reader.path()) == text.find(' ') + 1, "the text asks for the path");
  Verify(text.ends_with(reader.body()), "the text ends with the body");
  Verify(reader.post() == text.starts_with("POST "), "the text has the method");
  Verify(reader.post() || reader.body().empty(), "only POST carries a body");
}

/// Pieces of 1, 2, 4 .. bytes and then 1 again, up to the largest.
RequestReader Taken(std::string_view bytes, std::size_t largest) {
  RequestReader reader;
  std::size_t piece = 1;
  while (!bytes.empty() && reader.Wanted() > 0) {
    const std::string_view next = bytes.substr(0, std::min(piece, reader.Wanted()));
    reader.Take(next);
    Check(reader);
    bytes.remove_prefix(next.size());
    piece = 2 * piece > largest ? 1 : 2 * piece;
  }
  return reader;
}

}  // namespace

std::vector<std::string> Seeds() {
  const std::string host = " HTTP/1.1\r\nHost: localhost:8080\r\n";
  return {
      "\x01GET /" + host + "\r\n",
      "\x40GET /api/rigs?since=7" + host + "X-Levitas-Token: abc\r\nOrigin: http://a\r\n\r\n",
      "\x05POST /api/command" + host +
          "X-Levitas: 1\r\nSec-Fetch-Site: same-origin\r\nContent-Length: "
          "12\r\n\r\n{\"lift\":true}",
      "\x7fHEAD /page.js" + host + "Transfer-Encoding: chunked\r\nExpect: 100-continue\r\n\r\n"};
}

}  // namespace levitas::fuzz

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace levitas::fuzz;
  if (size == 0) return -1;
  const std::string input = AsText({data + 1, size - 1});
  const auto pieces = Taken(input, data[0]);
  const auto at_once = Taken(input, std::size_t{1} << 20);
  Verify(pieces.whole() == at_once.whole() && pieces.text() == at_once.text() &&
             pieces.refusal().status == at_once.refusal().status,
         "the size of the pieces changes nothing");
  return 0;
}
