#pragma once
/// The syntax of the CSV files of a run: one header line, commas between values, finite numbers only. Numbers have 17
/// significant digits, so that reading returns the same doubles.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pseudorigid::io {

/// The contents of a CSV file. `values` contains one row after the other.
struct Table {
  std::vector<std::string> columns;
  std::vector<double> values;

  std::size_t n_rows() const { return columns.empty() ? 0 : values.size() / columns.size(); }
  std::span<const double> row(std::size_t i) const { return {values.data() + i * columns.size(), columns.size()}; }
  bool has_column(std::string_view name) const;
  std::size_t column_index(std::string_view name) const;    ///< UserError if there is none
  std::vector<double> column(std::string_view name) const;  ///< UserError if there is none
};

/// Reads a file of this syntax. Any other text is a UserError "path:line: …".
Table read_csv(const std::filesystem::path& path);

/// Number of rows at the beginning of a table whose first value is less than `value`. An incomplete last row does not
/// count; a killed run may leave one.
std::int64_t n_rows_before(const std::filesystem::path& path, double value);

/// Throws UserError "path:line: …" unless the file begins with this header and `n_rows` valid rows. Later rows are not
/// checked.
void require_rows(const std::filesystem::path& path, std::span<const std::string> columns, std::int64_t n_rows);

/// Names of the columns. Throws UserError "path:line: …" if the file does not begin with a header.
std::vector<std::string> columns_in(const std::filesystem::path& path);

/// Keeps the header and the first `n_rows` rows, for a resumed run. The text after them is removed; after a kill it may
/// end with an incomplete row. UserError if the file has fewer rows or other columns.
void truncate_csv(const std::filesystem::path& path, std::span<const std::string> columns, std::int64_t n_rows);

/// Appends rows to a file. Rows collect in memory, and flush() writes them to the file. Call flush() before each
/// checkpoint, so that the file contains all rows of the checkpoint. If a write fails (WriteError), the file is
/// truncated to whole rows and the pending rows are kept. A later flush may then succeed.
class CsvWriter {
 public:
  static CsvWriter create(const std::filesystem::path& path, std::span<const std::string> columns);
  /// For a resumed run: truncates the file to `n_rows` rows and appends new rows.
  static CsvWriter resume(const std::filesystem::path& path, std::span<const std::string> columns, std::int64_t n_rows);

  CsvWriter(CsvWriter&& other) noexcept;
  CsvWriter& operator=(CsvWriter&&) = delete;
  ~CsvWriter();  ///< flushes and ignores errors; call flush() to detect them

  /// Appends one finite value per column. If a value is not finite, the row is discarded and a std::logic_error names
  /// the column.
  void append(std::span<const double> row);
  void flush();
  std::int64_t n_rows() const { return n_rows_; }  ///< number of rows, with the rows from before a resume

 private:
  CsvWriter(std::filesystem::path path, int file_descriptor, std::span<const std::string> columns, std::int64_t n_rows,
            std::int64_t file_size);
  std::filesystem::path path_;
  int file_descriptor_;
  std::vector<std::string> columns_;
  std::string pending_;
  std::int64_t n_rows_;
  std::int64_t file_size_;  ///< bytes of the whole rows in the file
};

}  // namespace pseudorigid::io
