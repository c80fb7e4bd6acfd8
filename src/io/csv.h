#pragma once
/// Readers and writers of the CSV files of a run. A file has one header line and then finite numbers, separated by
/// commas. Numbers have 17 significant digits. A reader therefore obtains the same doubles that were written.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pseudorigid::io {

/// The contents of a CSV file. The vector `values` contains the rows one after the other.
struct Table {
  std::vector<std::string> columns;
  std::vector<double> values;

  std::size_t n_rows() const { return columns.empty() ? 0 : values.size() / columns.size(); }
  std::span<const double> row(std::size_t i) const { return {values.data() + i * columns.size(), columns.size()}; }
  bool has_column(std::string_view name) const;
  std::size_t column_index(std::string_view name) const;    ///< throws UserError if there is no such column
  std::vector<double> column(std::string_view name) const;  ///< throws UserError if there is no such column
};

/// Reads a file of this syntax. Throws UserError "path:line: …" for any other text.
Table read_csv(const std::filesystem::path& path);

/// The number of rows before the first row whose first value is not less than `value`. An incomplete last row, which a
/// killed run may leave, does not count.
std::int64_t n_rows_before(const std::filesystem::path& path, double value);

/// Throws UserError "path:line: …" unless the file begins with this header and `n_rows` valid rows. Later rows are not
/// checked.
void require_rows(const std::filesystem::path& path, std::span<const std::string> columns, std::int64_t n_rows);

/// The names of the columns in a file. Throws UserError "path:line: …" if the file does not begin with a header.
std::vector<std::string> columns_in(const std::filesystem::path& path);

/// Removes all text after the header and the first `n_rows` rows, for a resumed run. A killed run may have left an
/// incomplete row. Throws UserError if the file has fewer rows or other columns, and WriteError if it cannot be
/// changed.
void truncate_csv(const std::filesystem::path& path, std::span<const std::string> columns, std::int64_t n_rows);

/// Appends rows to a file. The rows are collected in memory. flush() writes them to the file, and so does append() if
/// many rows have been collected. Call flush() before each checkpoint. The file then contains all rows up to the
/// checkpoint. If a write fails, a WriteError is thrown, the file is truncated to whole rows, and the unwritten rows
/// remain in memory. A later flush may then succeed.
class CsvWriter {
 public:
  /// Creates the file with its header, and replaces an old file. Throws WriteError.
  static CsvWriter create(const std::filesystem::path& path, std::span<const std::string> columns);
  /// Opens the file of a resumed run, and keeps only its first `n_rows` rows. New rows are appended. Throws the errors
  /// of truncate_csv.
  static CsvWriter resume(const std::filesystem::path& path, std::span<const std::string> columns, std::int64_t n_rows);

  CsvWriter(CsvWriter&& other) noexcept;
  CsvWriter& operator=(CsvWriter&&) = delete;
  ~CsvWriter();  ///< flushes and ignores errors; call flush() to detect them

  /// Appends a row with one finite value per column. If a value is not finite or the number of values is wrong, the row
  /// is discarded and std::logic_error is thrown. The message contains the name of the column that is not finite.
  void append(std::span<const double> row);
  void flush();
  std::int64_t n_rows() const { return n_rows_; }  ///< number of rows, including those before a resume

 private:
  CsvWriter(std::filesystem::path path, int file_descriptor, std::span<const std::string> columns, std::int64_t n_rows,
            std::int64_t file_size);
  std::filesystem::path path_;
  int file_descriptor_;
  std::vector<std::string> columns_;
  std::string pending_;
  std::int64_t n_rows_;
  std::int64_t file_size_;  ///< size in bytes of the header and the whole rows in the file
};

}  // namespace pseudorigid::io
