#include "entries/wording.h"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace pseudorigid::scene {
namespace {

constexpr std::size_t longest_quotation = 100;  // in bytes
/// Length in bytes of the longest text for which `nearest` searches a correct name. The bound limits the time of the
/// search.
constexpr std::size_t longest_misspelling = 80;

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// True for a byte of a UTF-8 character other than its first byte.
bool continues_utf8(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

/// The part of a path after its last "/".
std::string_view last_part(std::string_view path) {
  return path.substr(path.rfind('/') + 1);  // npos + 1 == 0: the whole path
}

/// A character from web pages or word processors that resembles a character of the keyboard: its bytes in UTF-8, its
/// name for messages, and the similar character `typed` of the keyboard. `typed` is empty if without_lookalikes deletes
/// the character.
struct Lookalike {
  std::string_view bytes, name, typed;
};

constexpr Lookalike lookalikes[] = {
    {"\u2212", "the minus sign U+2212", "-"},
    {"\u2010", "the hyphen U+2010", "-"},
    {"\u2011", "the no-break hyphen U+2011", "-"},
    {"\u2012", "the figure dash U+2012", "-"},
    {"\u2013", "the en dash U+2013", "-"},
    {"\u2014", "the em dash U+2014", "-"},
    {"\u00AD", "the soft hyphen U+00AD", ""},
    {"\u00A0", "the no-break space U+00A0", " "},
    {"\u2002", "the en space U+2002", " "},
    {"\u2003", "the em space U+2003", " "},
    {"\u2007", "the figure space U+2007", " "},
    {"\u2009", "the thin space U+2009", " "},
    {"\u202F", "the narrow no-break space U+202F", " "},
    {"\u200B", "the zero-width space U+200B", ""},
    {"\uFEFF", "the byte order mark U+FEFF", ""},
    {"\u00D7", "the multiplication sign U+00D7", "*"},
    {"\u00B7", "the middle dot U+00B7", "*"},
    {"\u22C5", "the dot operator U+22C5", "*"},
    {"\u2215", "the division slash U+2215", "/"},
    {"\u2018", "the quotation mark U+2018", ""},
    {"\u2019", "the quotation mark U+2019", ""},
    {"\u201C", "the quotation mark U+201C", ""},
    {"\u201D", "the quotation mark U+201D", ""},
    {"\uFF0C", "the full-width comma U+FF0C", ","},
    {"\uFF1B", "the full-width semicolon U+FF1B", ";"},
    {"\uFF1D", "the full-width equals sign U+FF1D", "="},
};

/// Returns a note about the first lookalike in the text, for example ` (with the minus sign U+2212 in place of "-")`.
/// The note is empty if the text has no lookalike.
std::string note_of_lookalike(std::string_view text) {
  const Lookalike* first = nullptr;
  std::size_t place = text.npos;
  for (const Lookalike& one : lookalikes)
    if (const std::size_t at = text.find(one.bytes); at < place) place = at, first = &one;
  if (first == nullptr) return {};
  const std::string typed = first->typed.empty()  ? "nothing"
                            : first->typed == " " ? "a blank"
                                                  : "\"" + std::string(first->typed) + "\"";
  return std::string(" (with ").append(first->name).append(" in place of ").append(typed).append(")");
}

/// The text with keyboard characters in place of their lookalikes.
std::string without_lookalikes(std::string_view text) {
  std::string result(text);
  for (const Lookalike& one : lookalikes)
    for (auto at = result.find(one.bytes); at != result.npos; at = result.find(one.bytes, at + one.typed.size()))
      result.replace(at, one.bytes.size(), one.typed);
  return result;
}

}  // namespace

std::string quote(std::string_view text) {
  std::size_t length = std::min(text.size(), longest_quotation);
  const bool shortened = length < text.size();
  while (shortened && length > 0 && continues_utf8(text[length])) --length;
  std::string result = "\"";
  for (const char c : text.substr(0, length)) result += std::iscntrl(static_cast<unsigned char>(c)) ? '?' : c;
  return result + (shortened ? "…\"" : "\"") + note_of_lookalike(text);
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view white = " \t\n\r\v\f";
  const auto first = text.find_first_not_of(white);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(white) - first + 1);
}

int edit_distance(std::string_view from, std::string_view to) {
  // Levenshtein's recursion: row[j] is the distance between the letters of `from` up to `letter` and the first j
  // letters of `to`.
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

/// The candidate of the same section whose name has further words before the last part of `word`, for example
/// "Material/Lame lambda" for "Material/lambda". The last part is compared without regard to case. The result is empty
/// if there is no such candidate, or more than one, or if the last part has fewer than four letters.
std::optional<std::string_view> with_last_word(std::string_view word, const std::vector<std::string_view>& candidates) {
  const std::string_view typed = last_part(word), section = word.substr(0, word.size() - typed.size());
  constexpr std::size_t least = 4;
  if (typed.size() < least) return std::nullopt;
  std::optional<std::string_view> found;
  for (const std::string_view candidate : candidates) {
    const std::string_view name = last_part(candidate);
    if (name.size() <= typed.size() || candidate.substr(0, candidate.size() - name.size()) != section) continue;
    const std::size_t begin = name.size() - typed.size();
    if (name[begin - 1] != ' ' || edit_distance(name.substr(begin), typed) > 0) continue;
    if (found) return std::nullopt;
    found = candidate;
  }
  return found;
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
  const std::string typed = without_lookalikes(word);
  auto candidate = nearest(trimmed(typed), candidates);
  if (!candidate) candidate = with_last_word(trimmed(typed), candidates);
  return candidate ? "; did you mean " + quote(*candidate) + "?" : std::string();
}

}  // namespace pseudorigid::scene
