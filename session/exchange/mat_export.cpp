#include "session/exchange/mat_export.hpp"

#include <matio.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <vector>

#include "common/output_file.hpp"
#include "session/exchange/export_rows.hpp"
#include "session/exchange/mat_handles.hpp"

namespace levitas::session {
namespace {

/// A variable of version 5 counts its bytes in 31 bits, its own names and sizes included.
constexpr std::size_t kMostRows = ((std::size_t{1} << 31U) - 4096) / sizeof(double);

bool WriteVector(mat_t* file, const std::string& name, std::vector<double>& numbers) {
  std::array<std::size_t, 2> size{numbers.size(), 1};
  const std::unique_ptr<matvar_t, FreeMatVariable> variable(
      Mat_VarCreate(name.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size.data(), numbers.data(),
                    MAT_F_DONT_COPY_DATA));
  return variable && Mat_VarWrite(file, variable.get(), MAT_COMPRESSION_NONE) == 0;
}

bool Holds(mat_t* file, const std::string& name, const std::vector<double>& numbers) {
  const std::unique_ptr<matvar_t, FreeMatVariable> variable(Mat_VarRead(file, name.c_str()));
  const std::size_t bytes = numbers.size() * sizeof(double);
  return variable && variable->data_type == MAT_T_DOUBLE && variable->nbytes == bytes &&
         (bytes == 0 || std::memcmp(variable->data, numbers.data(), bytes) == 0);
}

/// matio does not notice that a disk is full: what lies in the file is compared with what it
/// should hold.
bool Verified(const std::string& path, const std::vector<std::string>& names,
              const std::vector<std::vector<double>>& columns) {
  const std::unique_ptr<mat_t, CloseMat> file(Mat_Open(path.c_str(), MAT_ACC_RDONLY));
  for (std::size_t i = 0; file && i < columns.size(); ++i) {
    if (!Holds(file.get(), names[i], columns[i])) return false;
  }
  return file != nullptr;
}

/// Why a file is not what was written: the kernel says it of one more byte.
int Reason(int descriptor) {
  struct stat status {};
  constexpr char kByte = 0;
  const bool taken =
      ::fstat(descriptor, &status) == 0 && ::pwrite(descriptor, &kByte, 1, status.st_size) == 1;
  return taken || errno == 0 ? EIO : errno;
}

}  // namespace

ExportReport ExportMat(SessionReader& reader, const std::string& mat_path,
                       const ExportSelection& selection) {
  ExportRows rows(reader.header(), selection, LoadTorsion(reader.path()));
  std::vector<std::vector<double>> columns(rows.names().size());
  const ExportReport report =
      rows.ForEach(reader, [&](std::int64_t time_ns, const std::vector<double>& values) {
        columns[0].push_back(1e-9 * static_cast<double>(time_ns));
        for (std::size_t i = 0; i < values.size(); ++i) columns[i + 1].push_back(values[i]);
      });
  if (report.rows > kMostRows) {
    throw BadInput(mat_path + ": the session is too long for a MAT file of version 5; use --csv");
  }
  PartFile part(mat_path);
  if (part.direct()) {
    throw Problem(ExitStatus::kUsage,
                  mat_path + ": no regular file; a MAT file cannot be written to anything else");
  }
  mat_t* file = Mat_CreateVer(part.part_path().c_str(), nullptr, MAT_FT_MAT5);
  bool sound = file != nullptr;
  for (std::size_t i = 0; sound && i < columns.size(); ++i) {
    sound = WriteVector(file, rows.names()[i], columns[i]);
  }
  if (file != nullptr) sound = Mat_Close(file) == 0 && sound;
  if (!sound || !Verified(part.part_path(), rows.names(), columns)) {
    CannotWrite(mat_path, Reason(part.descriptor()));
  }
  part.Commit();
  return report;
}

}  // namespace levitas::session
