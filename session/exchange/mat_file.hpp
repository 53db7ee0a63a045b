#pragma once
// The vectors, or one matrix, of a MAT file, read by a process of its own.
//
// Why        libmatio and libhdf5 reserve what a file claims and may crash on a damaged one: then
//            the process that reads ends, and the program that asked says why.
// Sizes      before a variable's numbers are read: no more numbers than the file has bytes, or
//            kMostPerByte times as many when they may be compressed; and kMostNumbers in all.
// Limits     of the reading process: memory MostMemory(), processor time MostSeconds(), both
//            proportional to the size of the file; it writes no file.
// Failure    BadInput: what is claimed and what the file can hold, or which limit ended the
//            reading.
// Thread     any; forks, and waits for the other process.
// Not done   a sandbox: the reading process has the user's files and rights.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace levitas::session {

struct MatTable {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;
};

/// Deflate makes one byte of at most so many.
inline constexpr std::uint64_t kMostPerByte = 1032;
/// 2 GiB of doubles.
inline constexpr std::uint64_t kMostNumbers = std::uint64_t{1} << 28;

[[nodiscard]] std::uint64_t MostMemory(std::uint64_t file_bytes) noexcept;
[[nodiscard]] std::uint64_t MostSeconds(std::uint64_t file_bytes) noexcept;

/// All vectors and matrices by name, or the rows (or columns) of `matrix` when the file has it.
MatTable ReadMat(const std::string& path, const std::string& matrix,
                 const std::vector<std::string>& matrix_rows);

}  // namespace levitas::session
