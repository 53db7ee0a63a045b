#include "session/exchange/mat_variables.hpp"

#include <fmt/core.h>
#include <matio.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "common/problem.hpp"
#include "session/exchange/mat_handles.hpp"

namespace levitas::session {
namespace {

template <class Number>
std::vector<double> Converted(const matvar_t& variable, std::size_t count) {
  const auto* numbers = static_cast<const Number*>(variable.data);
  std::vector<double> values(count);
  std::transform(numbers, numbers + count, values.begin(),
                 [](Number number) { return static_cast<double>(number); });
  return values;
}

using Conversion = std::vector<double> (*)(const matvar_t&, std::size_t count);

/// The conversion of a class of real numbers to doubles; null for any other class.
Conversion ConversionOf(matio_classes numbers) {
  switch (numbers) {
    case MAT_C_DOUBLE:
      return Converted<double>;
    case MAT_C_SINGLE:
      return Converted<float>;
    case MAT_C_INT64:  // beyond 2^53 to the nearest double, as MATLAB's own double() gives it
      return Converted<std::int64_t>;
    case MAT_C_UINT64:
      return Converted<std::uint64_t>;
    case MAT_C_INT32:
      return Converted<std::int32_t>;
    case MAT_C_UINT32:
      return Converted<std::uint32_t>;
    case MAT_C_INT16:
      return Converted<std::int16_t>;
    case MAT_C_UINT16:
      return Converted<std::uint16_t>;
    case MAT_C_INT8:
      return Converted<std::int8_t>;
    case MAT_C_UINT8:
      return Converted<std::uint8_t>;
    default:
      return nullptr;
  }
}

/// All numbers of a real matrix, column by column; empty for a variable that is no real matrix.
std::vector<double> Numbers(const matvar_t& variable) {
  if (variable.rank != 2 || variable.isComplex != 0 || variable.data == nullptr) return {};
  const std::size_t count = variable.dims[0] * variable.dims[1];
  if (variable.nbytes != count * static_cast<std::size_t>(variable.data_size)) return {};
  const Conversion convert = ConversionOf(variable.class_type);
  return convert == nullptr ? std::vector<double>{} : convert(variable, count);
}

/// Row r of a matrix stored column by column is every `rows`-th number from r on.
MatTable Split(const matvar_t& variable, const std::string& where,
               const std::vector<std::string>& names) {
  const std::vector<double> numbers = Numbers(variable);
  if (numbers.empty()) throw BadInput(where + ": is not a matrix of real numbers");
  const std::size_t rows = variable.dims[0];
  const std::size_t columns = variable.dims[1];
  const bool lying = rows == names.size();
  if (!lying && columns != names.size()) {
    throw BadInput(fmt::format("{}: {} x {}, but the rig file names {} quantities (log: rows)",
                               where, rows, columns, names.size()));
  }
  MatTable table{names, {}};
  const std::size_t samples = lying ? columns : rows;
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::vector<double>& column = table.columns.emplace_back(samples);
    for (std::size_t n = 0; n < samples; ++n) {
      column[n] = lying ? numbers[n * rows + i] : numbers[i * rows + n];
    }
  }
  return table;
}

/// Refuses a variable that claims more numbers than the file can hold; `taken` grows by its own.
void CheckSize(const matvar_t& variable, bool may_be_packed, std::uint64_t file_bytes,
               const std::string& where, std::uint64_t& taken) {
  const std::uint64_t rows = variable.dims[0];
  const std::uint64_t columns = variable.dims[1];
  const std::uint64_t per_byte = may_be_packed ? kMostPerByte : 1;
  const std::uint64_t most = std::min(file_bytes * per_byte, kMostNumbers - taken);
  if (columns != 0 && rows > most / columns) {
    throw BadInput(fmt::format(
        "{}: claims {} x {} numbers, but a file of {} bytes can hold {} at most here ({} in all); "
        "it is damaged, or too large: export it again, in parts if need be",
        where, rows, columns, file_bytes, most, kMostNumbers));
  }
  taken += rows * columns;
}

bool IsRealMatrix(const matvar_t& variable) {
  return ConversionOf(variable.class_type) != nullptr && variable.rank == 2 &&
         variable.dims != nullptr && variable.isComplex == 0;
}

}  // namespace

MatTable ReadMatInThisProcess(const std::string& path, const std::string& matrix,
                              const std::vector<std::string>& matrix_rows) {
  std::error_code unknown;
  const std::uint64_t file_bytes = std::filesystem::file_size(path, unknown);
  const MatHandle file(unknown ? nullptr : Mat_Open(path.c_str(), MAT_ACC_RDONLY));
  if (!file) throw BadInput(path + ": cannot be read as a MAT file");
  const bool hdf5 = Mat_GetVersion(file.get()) == MAT_FT_MAT73;
  std::uint64_t taken = 0;
  MatTable vectors;
  for (MatVariable variable(Mat_VarReadNextInfo(file.get())); variable;
       variable.reset(Mat_VarReadNextInfo(file.get()))) {
    const std::string name = variable->name == nullptr ? "" : variable->name;
    const std::string where = fmt::format("{}: {}", path, name);
    const bool wanted = !matrix.empty() && name == matrix;
    if (IsRealMatrix(*variable)) {
      const bool may_be_packed = hdf5 || variable->compression != MAT_COMPRESSION_NONE;
      CheckSize(*variable, may_be_packed, file_bytes, where, taken);
      if (Mat_VarReadDataAll(file.get(), variable.get()) != 0) {
        throw BadInput(where + ": its numbers cannot be read; the file is damaged");
      }
    }
    if (wanted) return Split(*variable, where, matrix_rows);
    std::vector<double> numbers = Numbers(*variable);
    if (numbers.empty()) continue;
    vectors.names.push_back(name);
    vectors.columns.push_back(std::move(numbers));
  }
  if (vectors.names.empty()) throw BadInput(path + ": holds no matrix of real numbers");
  return vectors;
}

}  // namespace levitas::session
