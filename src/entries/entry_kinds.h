#pragma once
/// Kinds of values that an entry of a parameter file can have. Each kind converts text to a value and back, and
/// describes the permitted values in words. The entries are defined in scene/entries.h, scene/analysis_entries.h, and
/// in the headers of the loads and of the systems.
///
/// Every kind has the following members, with T the type of its value. The results of `read` and `expected` are parts
/// of error messages.
///   std::optional<std::string> read(std::string_view text, T& value) const;   // sets value, or returns the problem
///   std::string print(const T& value) const;                                  // read(print(v)) gives v, bit for bit
///   std::string expected() const;                                             // permitted values: "a number > 0"
///   static constexpr std::string_view type;                                   // name of the kind: "number"
///   std::vector<std::string_view> words() const;                              // permitted words such as `auto`

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "entries/matrix3.h"

namespace pseudorigid::scene {

/// The text of an error message about a value that is not permitted, for example `got "-1"`. It is empty if the value
/// is permitted.
using Problem = std::optional<std::string>;

/// The value of the entry `Continuum/Mesh` for the built-in mesh of the ball. Any other value is the name of a file.
inline constexpr std::string_view builtin_mesh = "builtin";

/// The end of an error message that quotes a wrong text: `got "…"`, or `got nothing` for an empty text.
std::string got(std::string_view text);

/// Returns the number if the whole text is a finite decimal number, otherwise an empty optional. A leading `+` is
/// permitted.
std::optional<double> finite_number(std::string_view text);

/// Returns the shortest decimal text that reads back as the same double. It has at most 17 significant digits.
std::string print_number(double value);

/// Prints the computed bound of an entry with three significant digits, for a message. An upper bound is rounded down
/// and a lower bound up, so that the printed number is a permitted value. If the third digit would be subnormal
/// (magnitudes below about 1e-305), the number is rounded to the nearest. Zero, subnormal numbers, infinity and NaN are
/// printed unchanged.
std::string print_upper_bound(double value);
std::string print_lower_bound(double value);

/// Prints the numbers in one line, separated by ", ".
std::string print_row(std::span<const double> numbers);

/// Prints the matrix in one line. "; " separates rows and ", " separates numbers.
std::string print_matrix(const Matrix3& matrix);

/// A finite number with low <= number <= high. If `low_excluded` is true, `low` itself is not permitted.
struct Number {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_excluded = false;

  static constexpr std::string_view type = "number";
  Problem read(std::string_view text, double& value) const;
  std::string print(double value) const { return print_number(value); }
  std::string expected() const;
  std::vector<std::string_view> words() const { return {}; }
};

inline constexpr Number positive{.low = 0, .low_excluded = true};
inline constexpr Number not_negative{.low = 0};

/// The word `auto`, for which the value is empty, or a number that `number` permits.
struct AutoOrNumber {
  Number number;

  static constexpr std::string_view type = "auto or number";
  Problem read(std::string_view text, std::optional<double>& value) const;
  std::string print(const std::optional<double>& value) const { return value ? number.print(*value) : "auto"; }
  std::string expected() const { return "auto or " + number.expected(); }
  std::vector<std::string_view> words() const { return {"auto"}; }
};

/// A whole number with low <= number <= high. If `high` is the largest int, messages do not name an upper limit.
struct Integer {
  int low = 0;
  int high = std::numeric_limits<int>::max();

  static constexpr std::string_view type = "integer";
  Problem read(std::string_view text, int& value) const;
  std::string print(int value) const { return std::to_string(value); }
  std::string expected() const;
  std::vector<std::string_view> words() const { return {}; }
};

/// The word `auto`, for which the value is empty, or a whole number that `number` permits.
struct AutoOrInteger {
  Integer number;

  static constexpr std::string_view type = "auto or integer";
  Problem read(std::string_view text, std::optional<int>& value) const;
  std::string print(const std::optional<int>& value) const { return value ? number.print(*value) : "auto"; }
  std::string expected() const { return "auto or " + number.expected(); }
  std::vector<std::string_view> words() const { return {"auto"}; }
};

/// The word `auto`, for which the value is an empty list, or strictly increasing whole numbers separated by `,`.
/// `number` must permit each number.
struct AutoOrIntegers {
  Integer number;

  static constexpr std::string_view type = "auto or list of integers";
  Problem read(std::string_view text, std::vector<int>& value) const;
  std::string print(const std::vector<int>& value) const;
  std::string expected() const;
  std::vector<std::string_view> words() const { return {"auto"}; }
};

/// The word `true` or `false`.
struct Boolean {
  static constexpr std::string_view type = "boolean";
  Problem read(std::string_view text, bool& value) const;
  std::string print(bool value) const { return value ? "true" : "false"; }
  std::string expected() const { return "true or false"; }
  std::vector<std::string_view> words() const { return {"true", "false"}; }
};

/// Free text on one line.
struct Text {
  bool may_be_empty = true;

  static constexpr std::string_view type = "text";
  Problem read(std::string_view text, std::string& value) const;
  std::string print(const std::string& value) const { return value; }
  std::string expected() const { return may_be_empty ? "any text" : "a text that is not empty"; }
  std::vector<std::string_view> words() const { return {}; }
};

/// The name of a directory, which must not be empty and is used literally. Texts that a shell would replace are errors:
/// `~` at the beginning, and `$NAME`, `${NAME}` or `$(` anywhere.
struct Directory {
  static constexpr std::string_view type = Text::type;
  Problem read(std::string_view text, std::string& value) const;
  std::string print(const std::string& value) const { return value; }
  std::string expected() const { return "the name of a directory"; }
  std::vector<std::string_view> words() const { return {}; }
};

/// The word `builtin` or the name of a .msh file, which need not exist.
struct BuiltinOrMeshFile {
  static constexpr std::string_view type = "mesh";
  Problem read(std::string_view text, std::string& value) const;
  std::string print(const std::string& value) const { return value; }
  std::string expected() const { return "builtin or the name of a .msh file"; }
  std::vector<std::string_view> words() const { return {builtin_mesh}; }
  /// Returns the absolute path of the file. A relative name is relative to `folder`. Returns `builtin` unchanged.
  std::string located(const std::string& value, const std::filesystem::path& folder) const;
};

/// Three rows separated by `;`, each of three numbers separated by `,`.
struct Matrix {
  bool symmetric = false;  ///< true if the matrix must be symmetric; scene/validate.h checks the symmetry

  static constexpr std::string_view type = "matrix";
  Problem read(std::string_view text, Matrix3& value) const;
  std::string print(const Matrix3& value) const { return print_matrix(value); }
  std::string expected() const;
  std::vector<std::string_view> words() const { return {}; }
};

/// The word `auto`, for which the value is empty, or a matrix.
struct AutoOrMatrix {
  static constexpr std::string_view type = "auto or matrix";
  Problem read(std::string_view text, std::optional<Matrix3>& value) const;
  std::string print(const std::optional<Matrix3>& value) const { return value ? print_matrix(*value) : "auto"; }
  std::string expected() const { return "auto or " + Matrix{}.expected(); }
  std::vector<std::string_view> words() const { return {"auto"}; }
};

/// A list of numbers separated by `,`. `number` must permit each number.
struct Numbers {
  std::size_t n = 0;  ///< required number of entries; if it is 0, the list can have any length
  Number number{};
  bool may_be_empty = false;

  static constexpr std::string_view type = "list of numbers";
  Problem read(std::string_view text, std::vector<double>& value) const;
  std::string print(const std::vector<double>& value) const;
  std::string expected() const;
  std::vector<std::string_view> words() const { return {}; }
};

/// Rows of `n_columns` finite numbers. `;` separates rows, and `,` separates the numbers of a row. The value is a list
/// of the numbers, row by row.
struct Rows {
  std::size_t n_columns;
  bool may_be_empty = false;

  static constexpr std::string_view type = "rows of numbers";
  Problem read(std::string_view text, std::vector<double>& value) const;
  std::string print(const std::vector<double>& value) const;
  std::string expected() const;
  std::vector<std::string_view> words() const { return {}; }
};

/// The end of an error message about a word that is not permitted: `got "…"`, and the question did_you_mean (wording.h)
/// if a permitted word is similar.
std::string unknown_word(std::string_view word, const std::vector<std::string_view>& allowed);

/// A table of n names, each with a value of type E. E is an enumeration or a type of pointers to members.
template <class E, std::size_t n>
using NameTable = std::array<std::pair<std::string_view, E>, n>;

/// The names in the order of the table.
template <class E, std::size_t n>
std::vector<std::string_view> words_of(const NameTable<E, n>& table) {
  std::vector<std::string_view> words;
  for (const auto& [name, value] : table) words.push_back(name);
  return words;
}

/// Joins the words in one line, "a, b, c".
std::string joined(const std::vector<std::string_view>& words);

/// Lists permitted words for a message: "a", "a or b" or "one of a, b, c".
std::string one_of(const std::vector<std::string_view>& words);

/// True if no name is empty, and no name or value occurs twice.
template <class E, std::size_t n>
constexpr bool is_sound(const NameTable<E, n>& table) {
  for (std::size_t i = 0; i < n; ++i) {
    if (table[i].first.empty()) return false;
    for (std::size_t k = 0; k < i; ++k)
      if (table[i].first == table[k].first || table[i].second == table[k].second) return false;
  }
  return true;
}

/// The value of an enumeration, written as one word of a table of names. A table with an empty name, or with a name or
/// value that occurs twice, does not compile. `print` throws std::logic_error for a value without a name.
template <class E, std::size_t n>
struct Choice {
  consteval explicit Choice(const NameTable<E, n>& names) : table(names) {
    if (!is_sound(names)) throw "a word of a choice is missing, or stands there twice";
  }

  NameTable<E, n> table;

  static constexpr std::string_view type = "choice";
  Problem read(std::string_view text, E& value) const {
    for (const auto& [name, named] : table)
      if (name == text) return value = named, std::nullopt;
    return unknown_word(text, words());
  }
  std::string print(E value) const {
    for (const auto& [name, named] : table)
      if (named == value) return std::string(name);
    throw std::logic_error("a value of a choice has no word");
  }
  std::string expected() const { return one_of(words()); }
  std::vector<std::string_view> words() const { return words_of(table); }
};

/// Makes a Choice: choice<E>({{"name", E::value}, …}). The compiler finds the number of words.
template <class E, std::size_t n>
consteval Choice<E, n> choice(const std::pair<std::string_view, E> (&names)[n]) {
  return Choice<E, n>(std::to_array(names));
}

/// One word of the list `allowed`. Unlike the table of a Choice, this list can be made at run time.
struct Word {
  std::vector<std::string_view> allowed;

  static constexpr std::string_view type = "choice";
  Problem read(std::string_view text, std::string& value) const;
  std::string print(const std::string& value) const { return value; }
  std::string expected() const { return one_of(allowed); }
  std::vector<std::string_view> words() const { return allowed; }
};

/// A comma-separated list of words from `allowed`, which may be empty. The value contains the words in the order of
/// `allowed`, each once.
struct Words {
  std::vector<std::string_view> allowed;

  static constexpr std::string_view type = "list";
  Problem read(std::string_view text, std::vector<std::string>& value) const;
  std::string print(const std::vector<std::string>& value) const;
  std::string expected() const { return "a comma-separated list out of " + joined(allowed); }
  std::vector<std::string_view> words() const { return allowed; }
};

/// Splits the text at each separator and removes white space at the ends of the parts. The result is empty for a blank
/// text.
std::vector<std::string_view> parts_of(std::string_view text, char separator);

/// A comma-separated list of words, which may be empty. Each word sets a bool member of the value to true. The other
/// members of `table` become false. If n_in_all is not 0, the word `all` sets the first n_in_all members of the table
/// to true. If a word is unknown, `read` returns the problem, and the value must not be used.
template <class S, std::size_t n>
struct Switches {
  consteval Switches(const NameTable<bool S::*, n>& names, std::size_t n_of_all) : table(names), n_in_all(n_of_all) {
    if (!is_sound(names)) throw "a word of a list is missing, or stands there twice";
  }

  NameTable<bool S::*, n> table;
  std::size_t n_in_all;

  static constexpr std::string_view type = "list";
  Problem read(std::string_view text, S& value) const {
    for (const auto& [name, member] : table) value.*member = false;
    for (const std::string_view word : parts_of(text, ',')) {
      bool found = word == "all" && n_in_all > 0;
      for (std::size_t i = 0; found && i < n_in_all; ++i) value.*table[i].second = true;
      for (const auto& [name, member] : table)
        if (name == word) found = value.*member = true;
      if (!found) return unknown_word(word, words());
    }
    return std::nullopt;
  }
  std::string print(const S& value) const {
    bool all = n_in_all > 0;
    for (std::size_t i = 0; i < n_in_all; ++i) all = all && value.*table[i].second;
    std::string list = all ? "all" : "";
    for (std::size_t i = all ? n_in_all : 0; i < n; ++i)
      if (value.*table[i].second) list.append(list.empty() ? "" : ", ").append(table[i].first);
    return list;
  }
  std::string expected() const { return "a comma-separated list out of " + joined(words()); }
  std::vector<std::string_view> words() const {
    auto words = words_of(table);
    if (n_in_all > 0) words.insert(words.begin(), "all");
    return words;
  }
};

/// Makes a Switches: switches<S>({{"name", &S::member}, …}). The word `all` sets all members to true.
template <class S, std::size_t n>
consteval Switches<S, n> switches(const std::pair<std::string_view, bool S::*> (&names)[n]) {
  return Switches<S, n>(std::to_array(names), n);
}

}  // namespace pseudorigid::scene
