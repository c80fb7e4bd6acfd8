#pragma once
/// Tables whose columns have units, in CSV files or in memory. The caller gives rows in internal units. The table keeps
/// them in the units of the user.

#include <algorithm>
#include <cmath>
#include <optional>

#include "io/csv.h"
#include "scene/catalogue.h"

namespace pseudorigid::io {

/// The names of columns, and the factors that convert a row from internal units to the units of the user. The function
/// `factor(unit)` returns the factor of a unit.
struct ColumnUnits {
  template <class Factor>
  ColumnUnits(const std::vector<scene::Column>& columns, const Factor& factor) {
    for (const scene::Column& column : columns) {
      names.push_back(column.name);
      factors.push_back(factor(column.unit));
    }
  }
  /// Converts a row with one value for each column, in place.
  void convert(std::vector<double>& row) const {
    for (std::size_t i = 0; i < factors.size(); ++i) row[i] *= factors[i];
  }

  std::vector<std::string> names;
  std::vector<double> factors;
};

/// A table to which rows are appended, either in a CSV file or in memory.
class ColumnTable {
 public:
  /// Writes the rows to a new CSV file. `factor` is that of ColumnUnits. Throws WriteError if the file cannot be
  /// created or its header cannot be written.
  template <class Factor>
  ColumnTable(const std::filesystem::path& path, const std::vector<scene::Column>& columns, const Factor& factor)
      : units_(columns, factor), csv_(CsvWriter::create(path, units_.names)) {}
  /// Writes the rows to `table`, which must outlive this object. The constructor removes the old contents of `table`.
  template <class Factor>
  ColumnTable(Table& table, const std::vector<scene::Column>& columns, const Factor& factor)
      : units_(columns, factor), table_(&table) {
    table = {.columns = units_.names, .values = {}};
  }

  /// Appends a row in internal units. If a value in the units of the user is not finite, does not write the row and
  /// returns false. Throws the errors of CsvWriter::append if the table is a CSV file.
  bool append_if_finite(std::vector<double> row) {
    units_.convert(row);
    const bool is_finite = std::ranges::all_of(row, [](double x) { return std::isfinite(x); });
    if (is_finite) write(row);
    return is_finite;
  }
  /// Appends a row in internal units. If the table is a CSV file, the errors of CsvWriter::append are thrown. A table
  /// in memory accepts all values.
  void append(std::vector<double> row) {
    units_.convert(row);
    write(row);
  }
  /// Writes the collected rows to the CSV file, and throws the errors of CsvWriter::flush. A table in memory does not
  /// need this call.
  void flush() {
    if (csv_) csv_->flush();
  }

 private:
  void write(const std::vector<double>& row) {
    if (csv_)
      csv_->append(row);
    else
      table_->values.insert(table_->values.end(), row.begin(), row.end());
  }

  ColumnUnits units_;
  std::optional<CsvWriter> csv_;
  Table* table_ = nullptr;  ///< the table in memory; null if the rows go to a file
};

}  // namespace pseudorigid::io
