#pragma once
/// Damaged copies of files, for tests of what reads them: bytes for binary files, lines and numbers for text.

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace pseudorigid::testing {

inline std::size_t below(std::size_t n, std::mt19937_64& random) { return static_cast<std::size_t>(random() % n); }

/// One to four changes to the bytes from `first` on.
inline std::string damaged_bytes(std::string bytes, std::size_t first, std::mt19937_64& random) {
  for (std::size_t n_changes = 1 + below(4, random); n_changes > 0; --n_changes) {
    if (bytes.size() < first) return bytes;
    const std::size_t at = first + below(bytes.size() - first + 1, random);
    switch (below(6, random)) {
      case 0:
        if (at < bytes.size()) bytes[at] ^= static_cast<char>(1 << below(8, random));
        break;
      case 1:
        bytes.resize(at);
        break;
      case 2:
        bytes.insert(at, 1 + below(20, random), static_cast<char>(random()));
        break;
      case 3:
        bytes.erase(at, below(20, random));
        break;
      case 4:
        for (std::size_t i = at; i < std::min(at + 8, bytes.size()); ++i) bytes[i] = '\xff';  // a huge count
        break;
      default:
        bytes += bytes.substr(at, below(40, random));
    }
  }
  return bytes;
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines{""};
  for (const char c : text) {
    lines.back() += c;
    if (c == '\n') lines.emplace_back();
  }
  return lines;
}

inline std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line;
  return text;
}

/// Replaces the number at or after a random place by one that is seldom meant.
inline void exchange_number(std::string& text, std::mt19937_64& random) {
  static const std::vector<std::string> numbers{
      "0",          "-0",      "-1",  "1e400", "-1e308", "1e-320", "1e-200", "99999999999999999999",
      "2147483648", "1000000", "nan", "inf",   "0x10",   "1e",     ".",      "1,5",
      "--1",        "1e3",     "0.3", "1e-12"};
  const auto is_digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  const auto of_number = [&](char c) { return is_digit(c) || std::string_view(".eE+-").find(c) != std::string::npos; };
  std::size_t first = below(text.size() + 1, random);
  while (first < text.size() && !is_digit(text[first])) ++first;
  if (first == text.size()) return;
  std::size_t last = first;
  while (first > 0 && of_number(text[first - 1])) --first;
  while (last < text.size() && of_number(text[last])) ++last;
  text.replace(first, last - first, numbers[below(numbers.size(), random)]);
}

/// One to three changes to a text; `words` are pieces of its language, `others` texts to take lines from.
inline std::string damaged_text(std::string text, const std::vector<std::string>& words,
                                const std::vector<std::string>& others, std::mt19937_64& random) {
  static const std::vector<std::string> strange{"\xEF\xBB\xBF",
                                                "\u00e9",
                                                "\u2028",
                                                "\u202e",
                                                "\xff\xfe",
                                                "\xc3",
                                                std::string(1, '\0'),
                                                "\x1b[31m",
                                                "\r",
                                                "\v",
                                                "\t",
                                                "\\",
                                                "\\\n",
                                                "\"",
                                                "#",
                                                "$(",
                                                "$(1/0)",
                                                "%s%n",
                                                "{}",
                                                std::string(3000, 'x'),
                                                std::string(3000, '9')};
  for (std::size_t n_changes = 1 + below(3, random); n_changes > 0; --n_changes) {
    const std::size_t at = below(text.size() + 1, random);
    auto lines = lines_of(text);
    const std::size_t line = below(lines.size(), random), other = below(lines.size(), random);
    switch (below(11, random)) {
      case 0:
        if (at < text.size()) text[at] ^= static_cast<char>(1 << below(8, random));
        break;
      case 1:
        text.erase(at, 1 + below(30, random));
        break;
      case 2:
        text.insert(at, text.substr(at, 1 + below(60, random)));
        break;
      case 3:
        text.resize(at);
        break;
      case 4:
        std::swap(lines[line], lines[other]);
        text = joined(lines);
        break;
      case 5:
        lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(line));
        text = joined(lines);
        break;
      case 6:
        lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(line), lines[other]);
        text = joined(lines);
        break;
      case 7:
        exchange_number(text, random);
        break;
      case 8:
        text.insert(at, strange[below(strange.size(), random)]);
        break;
      case 9:
        text.insert(at, words[below(words.size(), random)]);
        break;
      default: {
        const auto foreign = lines_of(others[below(others.size(), random)]);
        lines[line] = foreign[below(foreign.size(), random)];
        text = joined(lines);
      }
    }
  }
  return text;
}

}  // namespace pseudorigid::testing
