#pragma once
// Reads a file that holds a secret, after checking that nobody else could have read or written it.
//
// Checked  the open file, not its name, so that what is checked is what is read: a regular file, of
//          this user or of root, whose mode gives group and others nothing.
// Waits    never: a pipe in the file's place is refused, not waited for.
// Thread   any. Failure: `refused` says why, as a clause without the path; `content` is then empty.
// Not done no judgement of the content; who reads it clears it from memory where that matters.

#include <sys/stat.h>

#include <cstddef>
#include <string>

namespace levitas {

struct PrivateFile {
  std::string content;  ///< at most the bytes that were asked for
  std::string refused;  ///< empty: it was read
};

/// Why a file with these facts is not private to the user `reader`; empty when it is.
[[nodiscard]] std::string WhyNotPrivate(const struct stat& facts, uid_t reader,
                                        const std::string& path);

[[nodiscard]] PrivateFile ReadPrivateFile(const std::string& path, std::size_t most_bytes);

}  // namespace levitas
