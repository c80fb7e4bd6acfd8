#pragma once
/// Parts of error messages: quotations that are safe to print, and the correct name that is most similar to a misspelt
/// name.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pseudorigid::scene {

/// Returns `text` in quotation marks, with `?` for control characters. After 100 bytes, an ellipsis replaces the rest
/// of the text. If the text contains characters that only look like ASCII characters, the name of the first such
/// character follows the quotation.
std::string quote(std::string_view text);

/// Returns `text` without white space at both ends.
std::string_view trimmed(std::string_view text);

/// The smallest number of single-letter insertions, deletions and substitutions that change one word into the other.
/// Case is ignored.
int edit_distance(std::string_view from, std::string_view to);

/// Returns the candidate with the least distance from `word`, or the longest of several such candidates. The last part
/// of a word is the part after its last "/", or the whole word. The distance is the edit distance of the words, or the
/// edit distance of their last parts plus 1 if this is less. The second distance finds an entry in the wrong section.
/// The result is empty if the least distance exceeds both 1 and a third of the length of the last part of `word`. It is
/// also empty for an empty word or a word of more than 80 bytes.
std::optional<std::string_view> nearest(std::string_view word, const std::vector<std::string_view>& candidates);

/// Returns the question `; did you mean "…"?` with the candidate that `nearest` returns. Characters that only look like
/// ASCII characters are replaced before the search. If `nearest` returns nothing, the question has the only candidate
/// of the same section whose name ends with the typed name as a separate word. The typed name must have at least four
/// letters. An example is "Material/Lame lambda" for "Material/lambda". The result is empty if there is no such
/// candidate.
std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& candidates);

}  // namespace pseudorigid::scene
