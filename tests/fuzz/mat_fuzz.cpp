// A MAT file of version 5 or 7.3 becomes a session, or is refused in one sentence.

#include <matio.h>

#include <array>
#include <cstdlib>

#include "common/problem.hpp"
#include "session/exchange/mat_variables.hpp"
#include "tests/fuzz/import_rig.hpp"

namespace levitas::fuzz {
namespace {

std::string MatFile(mat_ft version, matio_compression compression) {
  const std::string path = ScratchFolder() + "/seed.mat";
  mat_t* file = Mat_CreateVer(path.c_str(), nullptr, version);
  std::array<double, 3> numbers{0.0, 1e-4, 2e-4};
  std::array<std::size_t, 2> size{numbers.size(), 1};
  for (const char* name : {"time_s", "position_de_x_m", "position_de_y_m", "position_nde_x_m",
                           "position_nde_y_m", "control_current_de_x_a", "control_current_de_y_a",
                           "control_current_nde_x_a", "control_current_nde_y_a"}) {
    matvar_t* variable = Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size.data(),
                                       numbers.data(), MAT_F_DONT_COPY_DATA);
    Mat_VarWrite(file, variable, compression);
    Mat_VarFree(variable);
  }
  Mat_Close(file);
  return Content(path);
}

}  // namespace

std::vector<std::string> Seeds() {
  return {MatFile(MAT_FT_MAT5, MAT_COMPRESSION_NONE), MatFile(MAT_FT_MAT5, MAT_COMPRESSION_ZLIB),
          MatFile(MAT_FT_MAT73, MAT_COMPRESSION_NONE)};
}

}  // namespace levitas::fuzz

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace levitas;
  // By far faster, but libhdf5's errors on damaged files then end the fuzzer.
  static const bool in_process = std::getenv("LEVITAS_FUZZ_MAT_IN_PROCESS") != nullptr;
  const std::string file = fuzz::AsFile("data.mat", {data, size});
  try {
    if (in_process) {
      (void)session::ReadMatInThisProcess(file, "log", {"time_s", "position_de_x_m"});
    } else {
      (void)session::ImportMat(fuzz::ImportInto(file));
    }
  } catch (const BadInput&) {
    return 0;
  }
  return 0;
}
