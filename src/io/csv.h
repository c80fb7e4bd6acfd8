#pragma once
/// The syntax of every CSV file of a run: one header line, comma, 17 significant digits (doubles survive the round trip
/// bit by bit), finite numbers only.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pseudorigid::io {

/// A CSV file in memory; values row after row.
struct Table {
  std::vector<std::string> columns;
  std::vector<double> values;

  std::size_t n_rows() const { return columns.empty() ? 0 : values.size() / columns.size(); }
  std::span<const double> row(std::size_t i) const { return {values.data() + i * columns.size(), columns.size()}; }
  bool has_column(std::string_view name) const;
  std::size_t column_index(std::string_view name) const;    ///< UserError if there is none
  std::vector<double> column(std::string_view name) const;  ///< UserError if there is none
};

/// Reads a file with this module's syntax; UserError "path:line: …" otherwise.
Table read_csv(const std::filesystem::path& path);

/// How many rows a table begins with whose first value is less than this. A row torn by a kill does not count.
std::int64_t n_rows_before(const std::filesystem::path& path, double value);

/// UserError "path:line: …" unless the file begins with this header and so many sound rows; later content is not
/// checked.
void require_rows(const std::filesystem::path& path, std::span<const std::string> columns, std::int64_t n_rows);

/// Names of the columns; the same UserError.
std::vector<std::string> columns_in(const std::filesystem::path& path);

/// Keeps the header and the first n_rows rows, for a resumed run (a row torn by a kill may follow them).
/// UserError if the file has fewer rows or other columns.
void truncate_csv(const std::filesystem::path& path, std::span<const std::string> columns, std::int64_t n_rows);

/// Appends rows to a file. Rows collect in memory; flush() brings them to the file and is called before each
/// checkpoint, so that the file is never behind it. When a write fails (WriteError) the file is cut back to whole rows
/// and the pending rows are kept, so a later flush may succeed.
class CsvWriter {
 public:
  static CsvWriter create(const std::filesystem::path& path, std::span<const std::string> columns);
  /// For a resumed run: truncate_csv to n_rows, then append.
  static CsvWriter resume(const std::filesystem::path& path, std::span<const std::string> columns, std::int64_t n_rows);

  CsvWriter(CsvWriter&& other) noexcept;
  CsvWriter& operator=(CsvWriter&&) = delete;
  ~CsvWriter();  ///< flushes and ignores errors; call flush() to detect them

  /// One value per column, all finite. A std::logic_error names a column that is not finite, and the row is discarded.
  void append(std::span<const double> row);
  void flush();
  std::int64_t n_rows() const { return n_rows_; }  ///< rows appended so far, those before a resume included

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
