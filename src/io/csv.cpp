#include "io/csv.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "io/files.h"
#include "scene/user_error.h"

namespace pseudorigid::io {

namespace {

constexpr std::size_t pending_limit = 1 << 16;  // in bytes; `append` flushes if `pending_` has at least this size

std::string header_line(std::span<const std::string> columns) { return fmt::format("{}\n", fmt::join(columns, ",")); }

/// Moves the next line of `text`, without its newline, into `line`. Returns false if `text` does not contain a complete
/// line.
bool next_line(std::string_view& text, std::string_view& line) {
  const std::size_t end = text.find('\n');
  if (end == text.npos) return false;
  line = text.substr(0, end);
  text.remove_prefix(end + 1);
  return true;
}

UserError bad_line(const std::filesystem::path& path, std::size_t line_number, const std::string& reason) {
  return UserError(fmt::format("{}:{}: {}", path.native(), line_number, reason));
}

std::vector<std::string> split_header(std::string_view line) {
  std::vector<std::string> columns;
  for (std::size_t begin = 0, end; begin <= line.size(); begin = end + 1) {
    end = std::min(line.find(',', begin), line.size());
    columns.emplace_back(line.substr(begin, end - begin));
  }
  return columns;
}

/// Appends the numbers of a line to `values`. Returns an empty text, or an error message if the line does not consist
/// of `n_columns` finite numbers. After an error, `values` may contain the first numbers of the line.
std::string parse_row(std::string_view line, std::size_t n_columns, std::vector<double>& values) {
  const char *position = line.data(), *const end = position + line.size();
  for (std::size_t i = 0; i < n_columns; ++i) {
    double value;
    const auto [after, error] = std::from_chars(position, end, value);
    if (error != std::errc() || !std::isfinite(value)) return fmt::format("column {}: expected a finite number", i + 1);
    values.push_back(value);
    const bool last = i + 1 == n_columns;
    if (last ? after != end : after == end || *after != ',')
      return fmt::format("expected {} numbers separated by commas", n_columns);
    position = after + 1;
  }
  return {};
}

/// Appends a number with the digits of printf's %.17g. In measurements, std::to_chars needed a third of the time of
/// printf.
void append_number(std::string& text, double value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 17).ptr);
}

}  // namespace

bool Table::has_column(std::string_view name) const { return std::ranges::find(columns, name) != columns.end(); }

std::size_t Table::column_index(std::string_view name) const {
  const auto found = std::ranges::find(columns, name);
  if (found == columns.end()) throw UserError(fmt::format("the table has no column '{}'", name));
  return found - columns.begin();
}

std::vector<double> Table::column(std::string_view name) const {
  std::vector<double> result;
  result.reserve(n_rows());
  for (std::size_t i = column_index(name); i < values.size(); i += columns.size()) result.push_back(values[i]);
  return result;
}

Table read_csv(const std::filesystem::path& path) {
  const std::string content = read_file(path);
  std::string_view text = content, line;
  if (!next_line(text, line) || line.empty()) throw bad_line(path, 1, "expected a line of column names");
  Table table{.columns = split_header(line), .values = {}};
  std::size_t line_number = 1;
  while (next_line(text, line)) {
    const std::string complaint = parse_row(line, table.columns.size(), table.values);
    ++line_number;
    if (!complaint.empty()) throw bad_line(path, line_number, complaint);
  }
  if (!text.empty()) throw bad_line(path, line_number + 1, "the last line is incomplete");
  return table;
}

std::int64_t n_rows_before(const std::filesystem::path& path, double value) {
  const std::string content = read_file(path);
  std::int64_t n = 0;
  for (std::size_t begin = content.find('\n'); begin != content.npos; ++n) {
    const std::size_t end = content.find('\n', ++begin);
    if (end == content.npos || !(std::strtod(&content[begin], nullptr) < value)) break;
    begin = end;
  }
  return n;
}

namespace {

/// The first `n_rows` rows of a file as text, without the header. `content` is the text of the file `path`. Throws
/// UserError if the header has other columns or if there are fewer rows.
std::string_view first_rows(const std::filesystem::path& path, std::string_view content,
                            std::span<const std::string> columns, std::int64_t n_rows) {
  const std::string header = header_line(columns);
  if (!content.starts_with(header)) throw bad_line(path, 1, "the columns are not those of the run to resume");
  content.remove_prefix(header.size());
  std::size_t size = 0;
  for (std::int64_t i = 0; i < n_rows; ++i) {
    const std::size_t newline = content.find('\n', size);
    if (newline == content.npos)
      throw UserError(fmt::format("'{}' has {} rows, the checkpoint needs {}", path.native(), i, n_rows));
    size = newline + 1;
  }
  return content.substr(0, size);
}

}  // namespace

void require_rows(const std::filesystem::path& path, std::span<const std::string> columns, std::int64_t n_rows) {
  const std::string content = read_file(path);
  std::string_view rows = first_rows(path, content, columns, n_rows), line;
  std::vector<double> values;
  for (std::size_t number = 2; next_line(rows, line); ++number) {
    values.clear();
    if (const std::string complaint = parse_row(line, columns.size(), values); !complaint.empty())
      throw bad_line(path, number, complaint);
  }
}

std::vector<std::string> columns_in(const std::filesystem::path& path) {
  const std::string content = read_file(path);
  std::string_view text = content, line;
  if (!next_line(text, line) || line.empty()) throw bad_line(path, 1, "expected a line of column names");
  return split_header(line);
}

void truncate_csv(const std::filesystem::path& path, std::span<const std::string> columns, std::int64_t n_rows) {
  const std::string content = read_file(path);
  const std::string_view rows = first_rows(path, content, columns, n_rows);
  const std::ptrdiff_t end = rows.data() + rows.size() - content.data();
  if (::truncate(path.c_str(), static_cast<off_t>(end)) != 0) throw WriteError(path, errno);
}

CsvWriter::CsvWriter(std::filesystem::path path, int file_descriptor, std::span<const std::string> columns,
                     std::int64_t n_rows, std::int64_t file_size)
    : path_(std::move(path)),
      file_descriptor_(file_descriptor),
      columns_(columns.begin(), columns.end()),
      n_rows_(n_rows),
      file_size_(file_size) {}

CsvWriter::CsvWriter(CsvWriter&& other) noexcept
    : path_(std::move(other.path_)),
      file_descriptor_(std::exchange(other.file_descriptor_, -1)),
      columns_(std::move(other.columns_)),
      pending_(std::move(other.pending_)),
      n_rows_(other.n_rows_),
      file_size_(other.file_size_) {}

CsvWriter::~CsvWriter() {
  if (file_descriptor_ < 0) return;
  try {
    flush();
  } catch (const WriteError&) {
  }
  ::close(file_descriptor_);
}

CsvWriter CsvWriter::create(const std::filesystem::path& path, std::span<const std::string> columns) {
  const int file_descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0666);
  if (file_descriptor < 0) throw WriteError(path, errno);
  CsvWriter writer(path, file_descriptor, columns, 0, 0);
  writer.pending_ = header_line(columns);
  writer.flush();
  return writer;
}

CsvWriter CsvWriter::resume(const std::filesystem::path& path, std::span<const std::string> columns,
                            std::int64_t n_rows) {
  truncate_csv(path, columns, n_rows);
  const int file_descriptor = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (file_descriptor < 0) throw WriteError(path, errno);
  return CsvWriter(path, file_descriptor, columns, n_rows, ::lseek(file_descriptor, 0, SEEK_END));
}

void CsvWriter::append(std::span<const double> row) {
  if (row.size() != columns_.size())
    throw std::logic_error(fmt::format("{}: {} values for {} columns", path_.native(), row.size(), columns_.size()));
  for (std::size_t i = 0; i < row.size(); ++i)
    if (!std::isfinite(row[i]))
      throw std::logic_error(fmt::format("{}: {} is {} in row {}", path_.native(), columns_[i], row[i], n_rows_ + 1));
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (i > 0) pending_ += ',';
    append_number(pending_, row[i]);
  }
  pending_ += '\n';
  ++n_rows_;
  if (pending_.size() >= pending_limit) flush();
}

void CsvWriter::flush() {
  try {
    write_fully(file_descriptor_, pending_, path_);
  } catch (const WriteError&) {
    // Only complete rows may remain in the file. If the truncation also fails, the error of the write is reported.
    [[maybe_unused]] const int result = ::ftruncate(file_descriptor_, static_cast<off_t>(file_size_));
    throw;
  }
  file_size_ += static_cast<std::int64_t>(pending_.size());
  pending_.clear();
}

}  // namespace pseudorigid::io
