#pragma once
/// CSV files whose columns have units. Rows are given in internal units and written in the units of the user.

#include <algorithm>
#include <cmath>

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
  void convert(std::vector<double>& row) const {
    for (std::size_t i = 0; i < factors.size(); ++i) row[i] *= factors[i];
  }

  std::vector<std::string> names;
  std::vector<double> factors;
};

class ColumnTable {
 public:
  template <class Factor>
  ColumnTable(const std::filesystem::path& path, const std::vector<scene::Column>& columns, const Factor& factor)
      : units_(columns, factor), csv_(CsvWriter::create(path, units_.names)) {}

  /// Returns false and does not write the row if a value in the units of the user is not finite.
  bool append_if_finite(std::vector<double> row) {
    units_.convert(row);
    const bool is_finite = std::ranges::all_of(row, [](double x) { return std::isfinite(x); });
    if (is_finite) csv_.append(row);
    return is_finite;
  }
  void append(std::vector<double> row) {
    units_.convert(row);
    csv_.append(row);
  }
  void flush() { csv_.flush(); }

 private:
  ColumnUnits units_;
  CsvWriter csv_;
};

}  // namespace pseudorigid::io
