// A measured CSV file becomes a session, or is refused in one sentence; what was imported is read.

#include "common/problem.hpp"
#include "session/log/session_reader.hpp"
#include "tests/fuzz/import_rig.hpp"
#include "tests/fuzz/verify.hpp"

namespace levitas::fuzz {

std::vector<std::string> Seeds() {
  const std::string names =
      "time_s,rotor_angle_rad,speed_rpm,position_de_x_m,position_de_y_m,position_nde_x_m,"
      "position_nde_y_m,control_current_de_x_a,control_current_de_y_a,control_current_nde_x_a,"
      "control_current_nde_y_a\n";
  std::string semicolons = names;
  for (char& letter : semicolons) letter = letter == ',' ? ';' : letter;
  return {names + "0,0,3000,1e-6,0,0,nan,0.1,0,0,0\n0.0001,0.03,3000,0,0,0,0,0,0,0,0\n",
          "\xEF\xBB\xBF" + semicolons + "0;0;3000;1,5e-6;0;0;0;0;0;0;0\r\n",
          "# mine\nrows 2\n" + names + "s,rad,rpm,m,m,m,m,A,A,A,A\n0,0,3000,0,0,0,0,0,0,0,0\n"};
}

}  // namespace levitas::fuzz

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace levitas;
  try {
    const auto options = fuzz::ImportInto(fuzz::AsFile("data.csv", {data, size}));
    const auto report = session::ImportCsv(options);
    session::SessionReader reader(options.out_path);
    cycle::CycleRecord record;
    std::uint64_t records = 0;
    while (reader.Next(record)) ++records;
    fuzz::Verify(records == report.rows, "every row is a record that can be read");
  } catch (const BadInput&) {
    return 0;
  }
  return 0;
}
