#pragma once
// The folder an answer is written to: made when it is needed, gone again when a refusal left it
// empty.
//
// Failure  BadInput when it cannot be made. Folders that were there before stay.

#include <filesystem>
#include <string>
#include <vector>

namespace levitas::cli {

class AnswerFolder {
 public:
  explicit AnswerFolder(const std::string& path);
  ~AnswerFolder();
  AnswerFolder(const AnswerFolder&) = delete;
  AnswerFolder& operator=(const AnswerFolder&) = delete;
  AnswerFolder(AnswerFolder&&) = delete;
  AnswerFolder& operator=(AnswerFolder&&) = delete;

 private:
  std::vector<std::filesystem::path> made_;  ///< the deepest first
};

}  // namespace levitas::cli
