// MAT files whose sizes lie, and one that is large and true. Those of version 4 and 5 are written
// here byte by byte, from the format's description; the large one by libmatio.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <matio.h>

#include <array>
#include <cstring>
#include <filesystem>

#include "common/problem.hpp"
#include "session/exchange/mat_file.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using testing::Folder;
using ::testing::HasSubstr;
using testing::WriteFile;

template <class Word>
std::string Words(std::initializer_list<Word> words) {
  std::string bytes(words.size() * sizeof(Word), '\0');
  std::memcpy(bytes.data(), std::data(words), bytes.size());
  return bytes;
}

constexpr std::uint32_t kInt8 = 1;
constexpr std::uint32_t kInt32 = 5;
constexpr std::uint32_t kUint32 = 6;
constexpr std::uint32_t kDouble = 9;
constexpr std::uint32_t kMatrix = 14;
constexpr std::uint32_t kCellClass = 1;
constexpr std::uint32_t kDoubleClass = 6;

std::string Header5() {
  std::string text(124, ' ');
  text.replace(0, 10, "MATLAB 5.0");
  return text + Words<std::uint16_t>({0x0100, 0x4D49});
}

/// A variable `v` that claims rows x columns, and holds `numbers`.
std::string Variable5(std::uint32_t kind, std::int32_t rows, std::int32_t columns,
                      std::uint32_t claimed_bytes, const std::string& numbers) {
  const std::string inside = Words<std::uint32_t>({kUint32, 8, kind, 0, kInt32, 8}) +
                             Words<std::int32_t>({rows, columns}) +
                             Words<std::uint32_t>({kInt8, 1}) + std::string("v\0\0\0\0\0\0\0", 8) +
                             Words<std::uint32_t>({kDouble, claimed_bytes}) + numbers;
  return Words<std::uint32_t>({kMatrix, static_cast<std::uint32_t>(inside.size())}) + inside;
}

class MatSize : public ::testing::Test {
 protected:
  std::string Refusal(const std::string& bytes) {
    WriteFile(mat_, bytes);
    return Refusal();
  }
  std::string Refusal() {
    try {
      (void)ReadMat(mat_, "", {});
    } catch (const BadInput& problem) {
      return problem.what();
    }
    return "accepted";
  }
  void Write(mat_ft version, std::size_t count) {
    const auto file = Mat_CreateVer(mat_.c_str(), nullptr, version);
    ASSERT_NE(file, nullptr);
    std::vector<double> zeros(count, 0.0);
    std::array<std::size_t, 2> size{count, 1};
    matvar_t* variable = Mat_VarCreate("v", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size.data(),
                                       zeros.data(), MAT_F_DONT_COPY_DATA);
    Mat_VarWrite(file, variable, MAT_COMPRESSION_ZLIB);
    Mat_VarFree(variable);
    Mat_Close(file);
  }

  Folder folder_;
  std::string mat_ = folder_ / "data.mat";
};

const std::string kTwoNumbers = Words<double>({1.0, 2.0});

TEST_F(MatSize, ATrueFileOfVersion5IsRead) {
  WriteFile(mat_, Header5() + Variable5(kDoubleClass, 2, 1, 16, kTwoNumbers));
  const MatTable table = ReadMat(mat_, "", {});
  ASSERT_EQ(table.names, std::vector<std::string>{"v"});
  EXPECT_EQ(table.columns[0], (std::vector<double>{1.0, 2.0}));
}

TEST_F(MatSize, DimensionsThatTheFileCannotHoldAreRefusedWithBothNumbers) {
  const std::string file = Header5() + Variable5(kDoubleClass, 2'000'000'000, 1, 16, kTwoNumbers);
  const std::string said = Refusal(file);
  EXPECT_THAT(said, HasSubstr("claims 2000000000 x 1 numbers"));
  EXPECT_THAT(said, HasSubstr("a file of " + std::to_string(file.size()) + " bytes"));
  EXPECT_THAT(said, HasSubstr("export it again"));
  // A product that wraps around is none.
  EXPECT_THAT(
      Refusal(Header5() + Variable5(kDoubleClass, 2'000'000'000, 2'000'000'000, 16, kTwoNumbers)),
      HasSubstr("claims 2000000000 x 2000000000"));
}

TEST_F(MatSize, DimensionsOfVersion4AreHeldAgainstTheFileToo) {
  const std::string file =
      Words<std::int32_t>({0, 1'500'000'000, 1, 0, 2}) + std::string("v\0", 2) + kTwoNumbers;
  EXPECT_THAT(Refusal(file), HasSubstr("claims 1500000000 x 1 numbers"));
}

TEST_F(MatSize, CellsWithoutEndAreRefusedWithinTheMemoryOfASmallFile) {
  const std::string said =
      Refusal(Header5() + Variable5(kCellClass, 1'000'000'000, 1, 16, kTwoNumbers));
  EXPECT_THAT(said, HasSubstr("data.mat"));
  EXPECT_THAT(said, ::testing::Not(HasSubstr("accepted")));
}

TEST_F(MatSize, EveryFlippedByteOfASmallFileIsReadOrRefused) {
  const std::string good = Header5() + Variable5(kDoubleClass, 2, 1, 16, kTwoNumbers);
  for (std::size_t at = Header5().size(); at < good.size(); ++at) {
    std::string bytes = good;
    bytes[at] = static_cast<char>(bytes[at] ^ 0xFF);
    EXPECT_FALSE(Refusal(bytes).empty()) << "byte " << at;
  }
}

TEST_F(MatSize, ALargeFileThatCompressesWellIsAcceptedInVersion5And73) {
  constexpr std::size_t kCount = 2'000'000;
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    Write(version, kCount);
    // Otherwise the bound for compressed numbers would not be tried.
    EXPECT_LT(std::filesystem::file_size(mat_),
              version == MAT_FT_MAT5 ? kCount : kCount * sizeof(double) + (1U << 20));
    EXPECT_EQ(Refusal(), "accepted");
    EXPECT_EQ(ReadMat(mat_, "", {}).columns.at(0).size(), kCount);
  }
}

TEST(MatLimits, OfMemoryAndTimeGrowNoFasterThanTheFileAndEnd) {
  constexpr std::uint64_t kMiB = 1 << 20;
  for (std::uint64_t bytes = 0; bytes < (std::uint64_t{1} << 50); bytes = 2 * bytes + 1000) {
    EXPECT_LE(MostMemory(bytes), 256 * kMiB + 24 * kMostPerByte * bytes);
    EXPECT_LE(MostMemory(bytes), 256 * kMiB + 24 * kMostNumbers);
    EXPECT_LE(MostSeconds(bytes), 20 + bytes / kMiB);
  }
}

}  // namespace
}  // namespace levitas::session
