#include "session/mat_rows.hpp"

#include <fmt/core.h>
#include <matio.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace levitas::session {
namespace {

struct Table {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;
};

struct CloseFile {
  void operator()(mat_t* file) const noexcept { (void)Mat_Close(file); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const noexcept { Mat_VarFree(variable); }
};
using File = std::unique_ptr<mat_t, CloseFile>;
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

template <class Number>
std::vector<double> Converted(const matvar_t& variable, std::size_t count) {
  const auto* numbers = static_cast<const Number*>(variable.data);
  std::vector<double> values(count);
  std::transform(numbers, numbers + count, values.begin(),
                 [](Number number) { return static_cast<double>(number); });
  return values;
}

/// All numbers of a real matrix, column by column; empty for what is none.
std::vector<double> Numbers(const matvar_t& variable) {
  if (variable.rank != 2 || variable.isComplex != 0 || variable.data == nullptr) return {};
  const std::size_t count = variable.dims[0] * variable.dims[1];
  if (variable.nbytes != count * static_cast<std::size_t>(variable.data_size)) return {};
  switch (variable.class_type) {
    case MAT_C_DOUBLE:
      return Converted<double>(variable, count);
    case MAT_C_SINGLE:
      return Converted<float>(variable, count);
    case MAT_C_INT32:
      return Converted<std::int32_t>(variable, count);
    case MAT_C_UINT32:
      return Converted<std::uint32_t>(variable, count);
    case MAT_C_INT16:
      return Converted<std::int16_t>(variable, count);
    case MAT_C_UINT16:
      return Converted<std::uint16_t>(variable, count);
    case MAT_C_INT8:
      return Converted<std::int8_t>(variable, count);
    case MAT_C_UINT8:
      return Converted<std::uint8_t>(variable, count);
    default:
      return {};
  }
}

/// Row r of a matrix stored column by column is every `rows`-th number from r on.
Table Split(const matvar_t& variable, const std::string& where,
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
  Table table{names, {}};
  const std::size_t samples = lying ? columns : rows;
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::vector<double>& column = table.columns.emplace_back(samples);
    for (std::size_t n = 0; n < samples; ++n) {
      column[n] = lying ? numbers[n * rows + i] : numbers[i * rows + n];
    }
  }
  return table;
}

Table Read(const std::string& path, const std::string& matrix,
           const std::vector<std::string>& matrix_rows) {
  const File file(Mat_Open(path.c_str(), MAT_ACC_RDONLY));
  if (!file) throw BadInput(path + ": cannot be read as a MAT file");
  Table vectors;
  for (Variable variable(Mat_VarReadNext(file.get())); variable;
       variable.reset(Mat_VarReadNext(file.get()))) {
    const std::string name = variable->name == nullptr ? "" : variable->name;
    if (!matrix.empty() && name == matrix) {
      return Split(*variable, fmt::format("{}: {}", path, name), matrix_rows);
    }
    std::vector<double> numbers = Numbers(*variable);
    if (numbers.empty()) continue;
    vectors.names.push_back(name);
    vectors.columns.push_back(std::move(numbers));
  }
  if (vectors.names.empty()) throw BadInput(path + ": holds no matrix of real numbers");
  return vectors;
}

}  // namespace

MatRows::MatRows(const std::string& path, const std::vector<std::string>& channels,
                 const std::string& matrix, const std::vector<std::string>& matrix_rows)
    : path_(path) {
  Table table = Read(path, matrix, matrix_rows);
  layout_ = ParseColumns(table.names, path, channels);
  columns_ = std::move(table.columns);
  std::size_t length = 0;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (layout_.columns[i].quantity == CsvQuantity::kIgnored) continue;
    if (length == 0) length = columns_[i].size();
    if (columns_[i].size() != length) {
      throw BadInput(fmt::format("{}: {} has {} samples, columns before it {}", path,
                                 layout_.columns[i].name, columns_[i].size(), length));
    }
  }
}

bool MatRows::Next(CsvRow& row) {
  const std::size_t sample = next_++;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const CsvColumn& column = layout_.columns[i];
    if (column.quantity == CsvQuantity::kIgnored) continue;
    if (sample >= columns_[i].size()) return false;
    const double value = columns_[i][sample];
    const bool place =
        column.quantity == CsvQuantity::kPosition || column.quantity == CsvQuantity::kGap;
    if (!std::isfinite(value) && !place) {
      throw Bad(fmt::format("{} is no finite number", column.name));
    }
    Put(column, value, row);
  }
  return true;
}

BadInput MatRows::Bad(const std::string& what) const {
  return BadInput(fmt::format("{}: sample {}: {}", path_, next_, what));
}

}  // namespace levitas::session
