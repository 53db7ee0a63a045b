// A session that goes into a named pipe, as into another program.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "common/file_descriptor.hpp"
#include "session/log/recorder.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using namespace testing;

/// Has the reader's end open already.
class RecordingPipe : public ::testing::Test {
 protected:
  RecordingPipe() {
    EXPECT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
    reader_ = FileDescriptor(::open((folder_ / "pipe").c_str(), O_RDONLY | O_NONBLOCK));
  }

  RecorderOptions Options() {
    RecorderOptions options;
    options.session_path = folder_ / "pipe";
    options.trip_folder = folder_ / "";
    options.header = Header();
    options.waits_for_room = true;
    return options;
  }
  Folder folder_;
  FileDescriptor reader_{-1};
};

// In lockstep the loop waits for the recorder: a reader that stops would hold the rotor's control.
// As a pair with the next: the same pipe, the same records, a reader that reads on.
TEST_F(RecordingPipe, EndsWithOneMessageWhenTheReaderOfItsPipeStops) {
  const auto records = DrawRecords(40'000);  // more than the ring and the pipe hold
  RecorderOptions options = Options();
  std::vector<std::string> told;
  std::size_t seen = 0;
  options.patience = std::chrono::milliseconds(200);
  options.on_event = [&](const Event& event) { told.push_back(event.text); };
  options.on_record = [&](const cycle::CycleRecord&) { ++seen; };
  {
    Recorder recorder(std::move(options));
    for (const auto& record : records) recorder.Post(record);
  }
  EXPECT_EQ(seen, records.size());
  EXPECT_EQ(std::count_if(told.begin(), told.end(),
                          [](const std::string& text) {
                            return text.find(
                                       "recording stopped: the reader of this pipe takes "
                                       "nothing any more") != std::string::npos;
                          }),
            1);
}

TEST_F(RecordingPipe, ReachesAReaderOfItsPipeThatIsSlowerThanItWhole) {
  const auto records = DrawRecords(40'000);
  RecorderOptions options = Options();
  ::fcntl(reader_.handle(), F_SETFL, 0);
  const std::string copy = folder_ / "s.lcmlog";
  std::thread reading([&] {
    std::ofstream file(copy, std::ios::binary);
    std::array<char, 4096> block{};
    // The writer is not there yet, or no more: the first look tells nothing.
    bool begun = false;
    for (;;) {
      const ssize_t read = ::read(reader_.handle(), block.data(), block.size());
      if (read > 0) file.write(block.data(), read);
      if (read == 0 && begun) break;
      begun = begun || read > 0;
      std::this_thread::yield();
    }
  });
  {
    Recorder recorder(std::move(options));
    for (const auto& record : records) recorder.Post(record);
  }
  reading.join();
  SessionReader session(copy);
  EXPECT_EQ(ReadAll(session).size(), records.size());
}

}  // namespace
}  // namespace levitas::session
