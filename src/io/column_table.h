#pragma once
/// Tables whose columns have units, in CSV files or in memory. The caller must add rows in internal units. The table
/// contains the values in the units of the user.

#include <algorithm>
#include <cmath>
#include <optional>

#include "io/csv.h"
#include "scene/catalogue.h"

namespace pseudorigid::io {

/// The names of columns, and the factors that convert a row from internal units to the units of the user. The caller
/// provides the function `factor`: factor(unit) returns the factor for a scene::Unit.
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
  /// Makes a table in a new CSV file. `factor` is the function of ColumnUnits. Throws WriteError if the file cannot be
  /// created or its header cannot be written.
  template <class Factor>
  ColumnTable(const std::filesystem::path& path, const std::vector<scene::Column>& columns, const Factor& factor)
      : units_(columns, factor), csv_(CsvWriter::create(path, units_.names)) {}
  /// Makes a table in memory, in the object `table`, which must outlive this object. The constructor removes the old
  /// contents of `table`. `factor` is the function of ColumnUnits.
  template <class Factor>
  ColumnTable(Table& table, const std::vector<scene::Column>& columns, const Factor& factor)
      : units_(columns, factor), table_(&table) {
    table = {.columns = units_.names, .values = {}};
  }

  /// Appends a row in internal units and returns true. If a value in the units of the user is not finite, returns false
  /// without a change. Throws the errors of CsvWriter::append if the table is in a CSV file.
  bool append_if_finite(std::vector<double> row) {
    units_.convert(row);
    const bool is_finite = std::ranges::all_of(row, [](double x) { return std::isfinite(x); });
    if (is_finite) write(row);
    return is_finite;
  }
  /// Appends a row in internal units. If the table is in a CSV file, throws the errors of CsvWriter::append, for
  /// example for a value that is not finite. A table in memory accepts all values.
  void append(std::vector<double> row) {
    units_.convert(row);
    write(row);
  }
  /// Writes the collected rows to the CSV file, and throws the errors of CsvWriter::flush. The call does nothing for a
  /// table in memory.
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
