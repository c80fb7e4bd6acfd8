#pragma once
/// Readers and writers of the CSV files of a run. The first line of a file, the header, has the names of the columns.
/// Every other line is a row of finite numbers. Commas separate names and numbers. Numbers are written with up to 17
/// significant digits, so that a reader obtains the written doubles exactly.

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

/// Reads a CSV file. Throws UserError if the file cannot be read. Throws UserError "path:line: …" if a line is
/// incomplete or does not have the form that the head of this file describes.
Table read_csv(const std::filesystem::path& path);

/// The number of rows before the first row whose first value is not less than `value`. If there is no such row, the
/// result is the number of all rows. An incomplete last row, which a killed run may leave, does not count. Throws
/// UserError if the file cannot be read.
std::int64_t n_rows_before(const std::filesystem::path& path, double value);

/// Throws UserError unless the file begins with the header of these columns and `n_rows` rows of finite numbers. Later
/// rows are not checked.
void require_rows(const std::filesystem::path& path, std::span<const std::string> columns, std::int64_t n_rows);

/// The names of the columns in the header of a file. Throws UserError if the file cannot be read or its first line is
/// empty or incomplete.
std::vector<std::string> columns_in(const std::filesystem::path& path);

/// Removes all text after the header and the first `n_rows` rows, for a resumed run. This text may include an
/// incomplete row of a killed run. Throws UserError if the file cannot be read, has fewer rows or has other columns.
/// Throws WriteError if the file cannot be changed.
void truncate_csv(const std::filesystem::path& path, std::span<const std::string> columns, std::int64_t n_rows);

/// Appends rows to a file. append() collects rows in memory, and flush() writes them to the file. append() calls
/// flush() if the collected rows have 64 KiB or more. Call flush() before each checkpoint, so that the file contains
/// all rows up to the checkpoint. If a write fails, flush() tries to truncate the file to its size before this write,
/// and throws WriteError. The unwritten rows remain in memory, and a later flush() tries to write them again.
class CsvWriter {
 public:
  /// Creates the file with its header, and replaces the contents of an old file. Throws WriteError if the file cannot
  /// be opened or written.
  static CsvWriter create(const std::filesystem::path& path, std::span<const std::string> columns);
  /// Opens the file of a resumed run, and removes all rows after the first `n_rows` rows (truncate_csv). Throws the
  /// errors of truncate_csv, and WriteError if the file cannot be opened.
  static CsvWriter resume(const std::filesystem::path& path, std::span<const std::string> columns, std::int64_t n_rows);

  CsvWriter(CsvWriter&& other) noexcept;
  CsvWriter& operator=(CsvWriter&&) = delete;
  ~CsvWriter();  ///< flushes and ignores errors; call flush() to detect them

  /// Appends a row with one finite value per column. If a value is not finite or the number of values is wrong, throws
  /// std::logic_error and does not append the row. If a value is not finite, the message contains the name of its
  /// column. If the function calls flush(), it also throws the errors of flush().
  void append(std::span<const double> row);
  /// Writes the collected rows to the file. Throws WriteError if this fails.
  void flush();
  /// The number of rows in the file and in memory. After resume(), it includes the first `n_rows` rows of the old file.
  std::int64_t n_rows() const { return n_rows_; }

 private:
  CsvWriter(std::filesystem::path path, int file_descriptor, std::span<const std::string> columns, std::int64_t n_rows,
            std::int64_t file_size);
  std::filesystem::path path_;
  int file_descriptor_;
  std::vector<std::string> columns_;
  std::string pending_;  ///< text that flush() has not yet written
  std::int64_t n_rows_;
  std::int64_t file_size_;  ///< size in bytes of the header and the complete rows in the file
};

}  // namespace pseudorigid::io
