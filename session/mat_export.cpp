#include "session/mat_export.hpp"

#include <matio.h>

#include <array>
#include <memory>
#include <vector>

#include "common/problem.hpp"
#include "session/export_rows.hpp"
#include "session/output_path.hpp"

namespace levitas::session {
namespace {

/// A variable of version 5 counts its bytes in 31 bits, its own names and sizes included.
constexpr std::size_t kMostRows = ((std::size_t{1} << 31U) - 4096) / sizeof(double);

struct FreeVariable {
  void operator()(matvar_t* variable) const noexcept { Mat_VarFree(variable); }
};

bool WriteVector(mat_t* file, const std::string& name, std::vector<double>& numbers) {
  std::array<std::size_t, 2> size{numbers.size(), 1};
  const std::unique_ptr<matvar_t, FreeVariable> variable(
      Mat_VarCreate(name.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size.data(), numbers.data(),
                    MAT_F_DONT_COPY_DATA));
  return variable && Mat_VarWrite(file, variable.get(), MAT_COMPRESSION_NONE) == 0;
}

}  // namespace

ExportReport ExportMat(SessionReader& reader, const std::string& mat_path) {
  ExportRows rows(reader.header());
  std::vector<std::vector<double>> columns(rows.names().size());
  std::vector<double> values;
  ExportReport report;
  cycle::CycleRecord record;
  while (reader.Next(record)) {
    if (!record.in.frame_present) {
      ++report.cycles_without_frame;
      continue;
    }
    columns[0].push_back(1e-9 * static_cast<double>(rows.Next(record, values)));
    for (std::size_t i = 0; i < values.size(); ++i) columns[i + 1].push_back(values[i]);
    ++report.rows;
  }
  if (report.rows > kMostRows) {
    throw BadInput(mat_path + ": the session is too long for a MAT file of version 5; use --csv");
  }
  PartFile part(mat_path);
  mat_t* file = Mat_CreateVer(part.part_path().c_str(), nullptr, MAT_FT_MAT5);
  bool sound = file != nullptr;
  for (std::size_t i = 0; sound && i < columns.size(); ++i) {
    sound = WriteVector(file, rows.names()[i], columns[i]);
  }
  if (file != nullptr) sound = Mat_Close(file) == 0 && sound;
  if (!sound) {
    throw BadInput(mat_path + ": cannot be written; is the folder yours, and the disk not full?");
  }
  part.Commit();
  return report;
}

}  // namespace levitas::session
