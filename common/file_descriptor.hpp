#pragma once
// A descriptor of the kernel (file, pipe, socket) that is closed with its owner.
//
// Absence  any negative number: what open(2) or socket(2) returned when they failed. errno is left
//          as they set it.
// Thread   one at a time. Failure: none; an error of close(2) is not reported, so data that must
//          be on the disk are synchronised before (output_file.hpp).

#include <unistd.h>

#include <utility>

namespace levitas {

class FileDescriptor {
 public:
  explicit FileDescriptor(int handle) noexcept : handle_(handle) {}
  FileDescriptor(FileDescriptor&& other) noexcept : handle_(std::exchange(other.handle_, kNone)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  ~FileDescriptor() { Close(); }

  void Close() noexcept {
    if (handle_ >= 0) static_cast<void>(::close(handle_));
    handle_ = kNone;
  }
  [[nodiscard]] bool is_open() const noexcept { return handle_ >= 0; }
  [[nodiscard]] int handle() const noexcept { return handle_; }

 private:
  static constexpr int kNone = -1;
  int handle_;
};

}  // namespace levitas
