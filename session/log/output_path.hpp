#pragma once
// Looks at the name of a file about to be written before any work is done for it.
//
// Failure   BadInput when it names a folder, or its folder is missing or not writable; a usage
//           Problem when it is the file that is read, or another that is written, which would be
//           lost.
// Not done  no guarantee that writing will succeed: the writer reports that.

#include <string>
#include <vector>

namespace levitas::session {

/// A path and what a person knows it by: "--json", "DATA", "the rig's controller file".
struct NamedPath {
  std::string name;
  std::string path;
};

/// One regular file, or the name of one to be made: the same path, another way to it through links,
/// or another name of its inode. Devices and pipes are no files that could be lost.
[[nodiscard]] bool SameFile(const std::string& one, const std::string& other);

/// Refuses two outputs that are the same file, and an output that is a file of `read`; the sentence
/// names both. Empty paths are not looked at.
void RefuseClash(const std::vector<NamedPath>& written, const std::vector<NamedPath>& read);

/// Refuses a name whose folder is missing or not writable; an empty one is never wrong.
void CheckOutputFolder(const std::string& output_path);

/// `input_path` is empty when no file is read; an empty `output_path` is never wrong.
void CheckOutputPath(const std::string& output_path, const std::string& input_path);

/// A recording that is there already is not replaced without being asked: a usage Problem unless
/// `overwrite`; neither is a symbolic link, wherever it leads, but for those to devices and pipes.
/// An empty file, and what is no regular file, holds no recording.
void CheckNoRecording(const std::string& path, bool overwrite);

}  // namespace levitas::session
