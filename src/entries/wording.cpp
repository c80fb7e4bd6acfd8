#include "entries/wording.h"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace pseudorigid::scene {
namespace {

constexpr std::size_t longest_quotation = 100;
/// Longer words are no misspelt names; the limit also bounds the cost of the search.
constexpr std::size_t longest_misspelling = 80;

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

bool continues_utf8(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

std::string_view last_part(std::string_view path) {
  return path.substr(path.rfind('/') + 1);  // npos + 1 == 0: the whole path
}

}  // namespace

std::string quote(std::string_view text) {
  std::size_t length = std::min(text.size(), longest_quotation);
  const bool shortened = length < text.size();
  while (shortened && length > 0 && continues_utf8(text[length])) --length;
  std::string result = "\"";
  for (const char c : text.substr(0, length)) result += std::iscntrl(static_cast<unsigned char>(c)) ? '?' : c;
  return result + (shortened ? "…\"" : "\"");
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view white = " \t\n\r\v\f";
  const auto first = text.find_first_not_of(white);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(white) - first + 1);
}

int edit_distance(std::string_view from, std::string_view to) {
  // Levenshtein's recursion; row[j] is the distance from the part of `from` seen so far to the first j letters of `to`.
  std::vector<int> row(to.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (const char letter : from) {
    int diagonal = row[0]++;
    for (std::size_t j = 0; j < to.size(); ++j) {
      const int substituted = diagonal + (lower(letter) == lower(to[j]) ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({substituted, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

std::optional<std::string_view> nearest(std::string_view word, const std::vector<std::string_view>& candidates) {
  if (word.empty() || word.size() > longest_misspelling) return std::nullopt;
  int best_distance = std::max(1, static_cast<int>(last_part(word).size()) / 3) + 1;
  std::optional<std::string_view> best;
  for (const std::string_view candidate : candidates) {
    const int misplaced = edit_distance(last_part(word), last_part(candidate)) + 1;
    const int distance = std::min(edit_distance(word, candidate), misplaced);
    const bool as_near = best && distance == best_distance && candidate.size() > best->size();
    if (distance >= best_distance && !as_near) continue;
    best_distance = distance;
    best = candidate;
  }
  return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& candidates) {
  const auto candidate = nearest(word, candidates);
  return candidate ? "; did you mean " + quote(*candidate) + "?" : std::string();
}

}  // namespace pseudorigid::scene
