#include "rt/say.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <thread>
#include <vector>

#include "rt/thread_trouble.hpp"

namespace levitas::rt {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// A pipe of one page, the least that the kernel gives. A page that holds anything takes no second
/// write until it is read: poll counts pages, not bytes.
constexpr int kOnePage = 4096;

class Pipe {
 public:
  explicit Pipe(int bytes = kOnePage) {
    EXPECT_EQ(pipe2(ends_.data(), O_CLOEXEC), 0);
    fcntl(ends_[1], F_SETPIPE_SZ, bytes);
  }
  ~Pipe() {
    CloseReader();
    if (ends_[1] >= 0) close(ends_[1]);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  [[nodiscard]] int writer() const { return ends_[1]; }
  void CloseReader() {
    if (ends_[0] >= 0) close(ends_[0]);
    ends_[0] = -1;
  }
  /// All that comes until `end` is there.
  std::string ReadUntil(const std::string& end) {
    std::string text;
    std::array<char, 1024> part{};
    while (text.find(end) == std::string::npos) {
      const ssize_t got = read(ends_[0], part.data(), part.size());
      if (got <= 0) break;
      text.append(part.data(), static_cast<std::size_t>(got));
    }
    return text;
  }

 private:
  std::array<int, 2> ends_{-1, -1};
};

TEST(Speaker, WritesLinesInOrderAndEndsTheLast) {
  Pipe pipe(16 * kOnePage);  // a writer that is quick makes two writes of it
  Speaker speaker(pipe.writer());
  speaker.Post("one\ntwo");
  speaker.Post("three\n");
  // A busy machine may not let the writer begin within one wait; the pipe takes everything.
  bool flushed = false;
  for (int wait = 0; wait < 100 && !flushed; ++wait) flushed = speaker.Flush();
  EXPECT_TRUE(flushed);
  EXPECT_EQ(pipe.ReadUntil("three\n"), "one\ntwo\nthree\n");
  EXPECT_EQ(speaker.lost(), 0U);
}

TEST(Speaker, PassesAPartOfALineAsItIs) {
  Pipe pipe;
  Speaker speaker(pipe.writer());
  speaker.Post("\rlift", Speaker::Kind::kPart);
  EXPECT_TRUE(speaker.Flush());
  EXPECT_EQ(pipe.ReadUntil("lift"), "\rlift");
}

// 4096 bytes stand in the pipe, as many in the writer's hands, the rest in the queue.
TEST(Speaker, HoldsNobodyUpWhenNobodyReadsAndSaysLaterWhatWasLost) {
  Pipe pipe;
  Speaker speaker(pipe.writer());
  const std::string line(99, 'x');
  constexpr std::uint64_t kLines = 10'000;  // 1 MB
  for (std::uint64_t i = 0; i < kLines; ++i) speaker.Post(line);
  EXPECT_FALSE(speaker.Flush());
  const std::uint64_t lost = speaker.lost();
  EXPECT_GE(lost, kLines - (Speaker::kRoomBytes + 2 * 4096) / 100 - 2);
  EXPECT_LT(lost, kLines);
  const std::string word = "[" + std::to_string(lost) + " lines lost so far: not taken here]\n";
  const std::string text = pipe.ReadUntil(word);
  EXPECT_EQ(static_cast<std::uint64_t>(std::count(text.begin(), text.end(), 'x')),
            (kLines - lost) * line.size());
  EXPECT_THAT(text, EndsWith(word));
  speaker.Post("again");
  EXPECT_THAT(pipe.ReadUntil("again\n"), EndsWith("again\n"));
}

// A writer that waits in the kernel keeps neither Flush nor the destructor.
TEST(Speaker, EndsWithoutWaitingForAReaderThatDoesNotRead) {
  // Never closed: the writer that is left behind may still be in the kernel with it.
  static Pipe& pipe = *new Pipe;
  Speaker speaker(pipe.writer());
  for (int i = 0; i < 10; ++i) speaker.Post(std::string(2'000, 'x'));
  EXPECT_FALSE(speaker.Flush());
}

TEST(Speaker, SurvivesAReaderThatHasGone) {
  Pipe pipe;
  pipe.CloseReader();
  Speaker speaker(pipe.writer());
  for (int i = 0; i < 3; ++i) {
    speaker.Post("nobody hears this");
    EXPECT_TRUE(speaker.Flush());
  }
  EXPECT_GE(speaker.lost(), 3U);
}

TEST(Speaker, SurvivesAFullDiskAndAFileThatIsNotOpen) {
  const int full = open("/dev/full", O_WRONLY | O_CLOEXEC);
  ASSERT_GE(full, 0);
  for (const int file : {full, 1'000'000}) {
    Speaker speaker(file);
    speaker.Post("one\ntwo");
    EXPECT_TRUE(speaker.Flush());
    EXPECT_EQ(speaker.lost(), 2U);
  }
  close(full);
}

TEST(Speaker, StopsAtTheBudgetOfALogButTakesTheReport) {
  std::FILE* file = std::tmpfile();
  ASSERT_NE(file, nullptr);
  Speaker speaker(fileno(file), 1000);
  for (int i = 0; i < 100; ++i) speaker.Post(std::string(99, 'x'));
  speaker.Post("the report", Speaker::Kind::kReport);
  EXPECT_TRUE(speaker.Flush());
  EXPECT_EQ(speaker.lost(), 90U);
  std::rewind(file);
  std::string text(2000, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), file));
  std::fclose(file);
  EXPECT_THAT(text, EndsWith("\n[90 lines lost so far: not taken here]\nthe report\n"));
}

TEST(Speaker, CutsALineThatIsLongerThanAPieceOfAPipe) {
  Pipe pipe;
  Speaker speaker(pipe.writer());
  const std::string line(10'000, 'x');
  speaker.Post(line + "\nshort");
  const std::string text = pipe.ReadUntil("short\n");
  EXPECT_EQ(text, line.substr(0, Speaker::kLongestLine) + " [cut]\nshort\n");
}

TEST(Speaker, TakesLinesOfManyThreadsWhole) {
  Pipe pipe;
  Speaker speaker(pipe.writer());
  std::vector<std::thread> threads;
  for (const char letter : {'a', 'b', 'c', 'd'}) {
    threads.emplace_back([&speaker, letter] {
      for (int i = 0; i < 50; ++i) speaker.Post(std::string(9, letter));
    });
  }
  for (std::thread& thread : threads) thread.join();
  speaker.Post("end");
  const std::string text = pipe.ReadUntil("end\n");
  EXPECT_EQ(text.size(), 200U * 10 + 4);
  for (std::size_t at = 0; at + 10 <= 2000; at += 10) {
    EXPECT_EQ(text.substr(at, 10), std::string(9, text[at]) + "\n");
  }
}

TEST(Printable, ShowsWhatWouldSteerATerminal) {
  EXPECT_EQ(Printable("\x1b[2J\a\r\x7f"), "\\x1b[2J\\x07\\x0d\\x7f");
  EXPECT_EQ(Printable(std::string_view("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(Printable("\x9b"
                      "31m"),
            "\\x9b31m");  // C1 as a byte
  EXPECT_EQ(Printable("\xc2\x9b"
                      "31m"),
            "\\xc2\\x9b31m");  // and as UTF-8
}

TEST(OneLine, LeavesANameNoWayToASecondRow) {
  EXPECT_EQ(OneLine("a\nb\tc\x1b[m µ"), "a\\x0ab\\x09c\\x1b[m µ");
}

TEST(Printable, LeavesTextOfPeopleAlone) {
  const std::string text = "line\n\tµm, Ω, 磁, 𝄞\n";
  EXPECT_EQ(Printable(text), text);
}

// Overlong, surrogate, beyond Unicode, cut short (RFC 3629, section 3).
TEST(Printable, ShowsBytesThatAreNoUtf8) {
  EXPECT_EQ(Printable("\xc0\x9b"), "\\xc0\\x9b");
  EXPECT_EQ(Printable("\xe0\x80\x9b"), "\\xe0\\x80\\x9b");
  EXPECT_EQ(Printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");
  EXPECT_EQ(Printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");
  EXPECT_EQ(Printable("\xe2\x82"), "\\xe2\\x82");
}

TEST(Quoted, KeepsALineOfOthersFromLookingLikeOneOfOurs) {
  EXPECT_THAT(Quoted("refused\namb-controller: all is well"), Not(HasSubstr("\namb-controller")));
}

TEST(Troubles, CountWhatAThreadThrowsAndLetItGoOn) {
  const int before = Troubles();
  EXPECT_FALSE(Guarded("test", [] { throw std::runtime_error("meant"); }));
  EXPECT_FALSE(Guarded("test", [] { throw 7; }));
  EXPECT_TRUE(Guarded("test", [] {}));
  EXPECT_EQ(Troubles(), before + 2);
}

}  // namespace
}  // namespace levitas::rt
