#pragma once
/// Words of error messages: quotations that are safe to print, and the correct name nearest to a misspelt name.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pseudorigid::scene {

/// Returns `text` in quotation marks, shortened to at most 100 bytes, with `?` for control characters. If the text
/// contains characters that only look like ASCII characters, the name of the first one follows the quotation.
std::string quote(std::string_view text);

/// Returns `text` without white space at both ends.
std::string_view trimmed(std::string_view text);

/// The smallest number of single-letter insertions, deletions and substitutions that change one word into the other.
/// Case is ignored.
int edit_distance(std::string_view from, std::string_view to);

/// Returns the candidate nearest to `word` by edit distance, or an empty optional if no candidate is near enough. If
/// several candidates are equally near, returns the longest. The last part of a word is the part after its last "/", or
/// the whole word. A candidate is near enough if its distance is at most a third of the length of the last part of
/// `word`. A distance of 1 is always near enough. An empty word or a word of more than 80 bytes has no near candidate.
/// For paths like "Body/Radius" the last parts are also compared alone, and 1 is added to their distance. This
/// comparison finds an entry in the wrong subsection.
std::optional<std::string_view> nearest(std::string_view word, const std::vector<std::string_view>& candidates);

/// Returns the question `; did you mean "…"?` with the nearest candidate, or an empty text if there is none. Characters
/// that only look like ASCII characters are replaced before the search. If no candidate is near, the question proposes
/// the only candidate of the same section whose name ends with the typed name. The typed name must have at least four
/// letters. An example is "Material/Lame lambda" for "Material/lambda".
std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& candidates);

}  // namespace pseudorigid::scene
