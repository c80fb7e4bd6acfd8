#include "entries/entry_kinds.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <span>

#include "entries/wording.h"

namespace pseudorigid::scene {
namespace {

/// Removes a leading '+', which std::from_chars does not accept. A '+' alone or before '-' stays and is an error.
std::string_view without_plus(std::string_view text) {
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  return plus ? text.substr(1) : text;
}

/// The number if the whole text is a number of type T, otherwise empty. Infinity and NaN are numbers of type double
/// here.
template <class T>
std::optional<T> whole_text_as(std::string_view text) {
  text = without_plus(text);
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// A number with the noun `one` or `several`, for example "1 entry" or "2 entries".
std::string counted(std::size_t n, const char* one, const char* several) {
  return std::to_string(n) + " " + (n == 1 ? one : several);
}

}  // namespace

std::string got(std::string_view text) { return text.empty() ? "got nothing" : "got " + quote(text); }

std::string unknown_word(std::string_view word, const std::vector<std::string_view>& allowed) {
  return got(word) + did_you_mean(word, allowed);
}

std::string joined(const std::vector<std::string_view>& words) {
  std::string list;
  for (const std::string_view word : words) list.append(list.empty() ? "" : ", ").append(word);
  return list;
}

std::string one_of(const std::vector<std::string_view>& words) {
  if (words.size() == 2) return std::string(words[0]).append(" or ").append(words[1]);
  return (words.size() > 2 ? "one of " : "") + joined(words);
}

std::vector<std::string_view> parts_of(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  if (trimmed(text).empty()) return parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const auto end = std::min(text.find(separator, begin), text.size());
    parts.push_back(trimmed(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return parts;
}

std::optional<double> finite_number(std::string_view text) {
  const auto value = whole_text_as<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::string print_number(double value) {
  std::array<char, 32> text;
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end};
}

namespace {

/// Prints the value with three significant digits, rounded by `towards`, which is floor or ceil. Prints 0, subnormal
/// numbers, infinity and NaN unchanged. If the unit of the third digit is subnormal, the value is rounded to the
/// nearest.
std::string three_digits(double value, double (*towards)(double)) {
  if (!std::isnormal(value)) return print_number(value);
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 2);
  const double rounded = std::isnormal(unit) ? towards(value / unit) * unit : value;
  std::array<char, 32> text;
  const auto [end, error] =
      std::to_chars(text.data(), text.data() + text.size(), rounded, std::chars_format::general, 3);
  return {text.data(), end};
}

}  // namespace

std::string print_upper_bound(double value) {
  return three_digits(value, [](double x) { return std::floor(x); });
}

std::string print_lower_bound(double value) {
  return three_digits(value, [](double x) { return std::ceil(x); });
}

std::string print_row(std::span<const double> numbers) {
  std::string text;
  for (const double number : numbers) text.append(text.empty() ? "" : ", ").append(print_number(number));
  return text;
}

std::string print_matrix(const Matrix3& matrix) {
  std::string text;
  for (const auto& row : matrix) text.append(text.empty() ? "" : "; ").append(print_row(row));
  return text;
}

Problem Number::read(std::string_view text, double& value) const {
  const auto number = finite_number(text);
  if (!number || *number < low || *number > high || (low_excluded && *number == low)) return got(text);
  value = *number;
  return std::nullopt;
}

std::string Number::expected() const {
  if (std::isinf(low)) return "a finite number";
  if (std::isinf(high)) return (low_excluded ? "a number > " : "a number >= ") + print_number(low);
  return "a number from " + print_number(low) + " to " + print_number(high);
}

namespace {

/// Reads the word `auto`, which makes `value` empty, or a text that `kind` permits. Returns the problem of any other
/// text.
template <class T, class Kind>
Problem read_unless_auto(std::string_view text, const Kind& kind, std::optional<T>& value) {
  if (text == "auto") return value.reset(), std::nullopt;
  T read_value{};
  if (auto problem = kind.read(text, read_value)) return problem;
  value = read_value;
  return std::nullopt;
}

}  // namespace

Problem AutoOrNumber::read(std::string_view text, std::optional<double>& value) const {
  return read_unless_auto(text, number, value);
}

Problem AutoOrInteger::read(std::string_view text, std::optional<int>& value) const {
  return read_unless_auto(text, number, value);
}

Problem AutoOrMatrix::read(std::string_view text, std::optional<Matrix3>& value) const {
  return read_unless_auto(text, Matrix{}, value);
}

Problem Integer::read(std::string_view text, int& value) const {
  const auto number = whole_text_as<int>(text);
  if (!number || *number < low || *number > high) return got(text);
  value = *number;
  return std::nullopt;
}

std::string Integer::expected() const {
  if (high == std::numeric_limits<int>::max()) return "a whole number >= " + std::to_string(low);
  return "a whole number from " + std::to_string(low) + " to " + std::to_string(high);
}

Problem AutoOrIntegers::read(std::string_view text, std::vector<int>& value) const {
  std::vector<int> numbers;
  if (text != "auto") {
    for (const std::string_view part : parts_of(text, ',')) {
      int one = 0;
      if (Problem problem = number.read(part, one)) return problem;
      if (!numbers.empty() && one <= numbers.back()) return got(text);
      numbers.push_back(one);
    }
    if (numbers.empty()) return got(text);
  }
  value = std::move(numbers);
  return std::nullopt;
}

std::string AutoOrIntegers::print(const std::vector<int>& value) const {
  if (value.empty()) return "auto";
  std::string list;
  for (const int one : value) list += (list.empty() ? "" : ", ") + std::to_string(one);
  return list;
}

std::string AutoOrIntegers::expected() const {
  return "auto, or rising whole numbers separated by ',', each " + number.expected();
}

Problem Boolean::read(std::string_view text, bool& value) const {
  if (text != "true" && text != "false") return got(text);
  value = text == "true";
  return std::nullopt;
}

Problem Text::read(std::string_view text, std::string& value) const {
  if (text.empty() && !may_be_empty) return got(text);
  value = text;
  return std::nullopt;
}

namespace {

/// The beginning `word` of a text that a shell would replace, such as `~`, `$NAME` or `$(`. The member `value` is the
/// replacement of `~` or of a variable. It is empty for other words and for variables that are not set.
struct ShellWord {
  std::string word, value;
};

/// The word at the beginning of the text that a shell would replace. The result is empty if there is no such word.
std::optional<ShellWord> shell_word(std::string_view text) {
  const auto value_of = [](const std::string& name) {
    const char* value = std::getenv(name.c_str());
    return std::string(value ? value : "");
  };
  if (text.starts_with('~')) {
    const std::string word(text.substr(0, text.find('/')));
    return ShellWord{word, word == "~" ? value_of("HOME") : ""};
  }
  if (!text.starts_with('$')) return {};
  const bool braces = text.starts_with("${");
  const auto is_of_name = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
  const std::string_view rest = text.substr(braces ? 2 : 1);
  const bool begins = !rest.empty() && !std::isdigit(static_cast<unsigned char>(rest.front()));
  const std::string name(rest.begin(), begins ? std::find_if_not(rest.begin(), rest.end(), is_of_name) : rest.begin());
  if (name.empty()) return text.starts_with("$(") ? std::optional(ShellWord{"$(", ""}) : std::nullopt;
  return ShellWord{braces ? "${" + name + "}" : "$" + name, value_of(name)};
}

}  // namespace

Problem Directory::read(std::string_view text, std::string& value) const {
  if (text.empty()) return got(text);
  for (std::size_t at = 0; at < text.size(); at = std::max(at + 1, text.find('$', at + 1)))
    if (const auto found = shell_word(text.substr(at)); found && (at == 0 || text[at] == '$')) {
      const std::string problem = got(text) + ", in which " + quote(found->word) + " is not replaced";
      if (found->value.empty()) return problem;
      std::string meant(text);
      return problem + "; write " + quote(meant.replace(at, found->word.size(), found->value));
    }
  value = text;
  return std::nullopt;
}

Problem BuiltinOrMeshFile::read(std::string_view text, std::string& value) const {
  if (text != builtin_mesh && !text.ends_with(".msh")) return got(text);
  value = text;
  return std::nullopt;
}

std::string BuiltinOrMeshFile::located(const std::string& value, const std::filesystem::path& folder) const {
  return value == builtin_mesh ? value : std::filesystem::absolute(folder / value).lexically_normal().string();
}

Problem Word::read(std::string_view text, std::string& value) const {
  for (const std::string_view word : allowed)
    if (word == text) return value = word, std::nullopt;
  return unknown_word(text, allowed);
}

Problem Words::read(std::string_view text, std::vector<std::string>& value) const {
  const std::vector<std::string_view> named = parts_of(text, ',');
  for (const std::string_view word : named)
    if (std::ranges::find(allowed, word) == allowed.end()) return unknown_word(word, allowed);
  value.clear();
  for (const std::string_view word : allowed)
    if (std::ranges::find(named, word) != named.end()) value.emplace_back(word);
  return std::nullopt;
}

std::string Words::print(const std::vector<std::string>& value) const {
  return joined(std::vector<std::string_view>(value.begin(), value.end()));
}

Problem Numbers::read(std::string_view text, std::vector<double>& value) const {
  const auto entries = parts_of(text, ',');
  if ((entries.empty() && !may_be_empty) || (n > 0 && entries.size() != n))
    return got(text) + ", which has " + counted(entries.size(), "entry", "entries");
  std::vector<double> numbers(entries.size());
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (const Problem problem = number.read(entries[i], numbers[i]))
      return *problem + " as entry " + std::to_string(i + 1);
  value = std::move(numbers);
  return std::nullopt;
}

std::string Numbers::print(const std::vector<double>& value) const { return print_row(value); }

std::string Numbers::expected() const {
  if (n == 0)
    return std::string(may_be_empty ? "nothing, or " : "") + "one or more numbers separated by \",\", each " +
           number.expected();
  return std::to_string(n) + " numbers separated by \",\", each " + number.expected();
}

Problem Rows::read(std::string_view text, std::vector<double>& value) const {
  const auto rows = parts_of(text, ';');
  if (rows.empty() && !may_be_empty) return got(text);
  std::vector<double> numbers;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto entries = parts_of(rows[i], ',');
    if (entries.size() != n_columns)
      return got(text) + ", where row " + std::to_string(i + 1) + " has " + counted(entries.size(), "entry", "entries");
    for (std::size_t j = 0; j < n_columns; ++j) {
      const auto number = finite_number(entries[j]);
      if (!number) return got(entries[j]) + " as entry (" + std::to_string(i + 1) + "," + std::to_string(j + 1) + ")";
      numbers.push_back(*number);
    }
  }
  value = std::move(numbers);
  return std::nullopt;
}

std::string Rows::print(const std::vector<double>& value) const {
  std::string text;
  for (std::size_t i = 0; i < value.size(); i += n_columns)
    text += (i == 0 ? "" : "; ") + print_row(std::span(value).subspan(i, n_columns));
  return text;
}

std::string Rows::expected() const {
  return "rows of " + std::to_string(n_columns) + " finite numbers, rows separated by \";\" and entries by \",\"" +
         (may_be_empty ? ", or nothing" : "");
}

Problem Matrix::read(std::string_view text, Matrix3& value) const {
  std::vector<double> numbers;
  const auto n_rows = parts_of(text, ';').size();
  if (n_rows != 3) return got(text) + ", which has " + counted(n_rows, "row", "rows");
  if (Problem problem = Rows{3}.read(text, numbers)) return problem;
  for (std::size_t k = 0; k < 9; ++k) value[k / 3][k % 3] = numbers[k];
  return std::nullopt;
}

std::string Matrix::expected() const {
  return "a 3x3 matrix of finite numbers, rows separated by \";\" and entries by \",\"";
}

}  // namespace pseudorigid::scene
