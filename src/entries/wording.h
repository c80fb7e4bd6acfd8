#pragma once
/// Words of error messages: quotations that are safe to print, and the name nearest to a misspelt one.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pseudorigid::scene {

/// `text` in quotation marks, shortened to a readable length, with `?` for control characters. If a character only
/// looks like an ASCII character, its name follows the quotation.
std::string quote(std::string_view text);

/// `text` without blanks and other white space at both ends.
std::string_view trimmed(std::string_view text);

/// Number of single-letter insertions, deletions and substitutions from one word to the other. Case is ignored.
int edit_distance(std::string_view from, std::string_view to);

/// The candidate nearest to `word`, if it is near enough. The last parts of paths like "Body/Radius" are also compared
/// alone, which finds an entry in the wrong subsection.
std::optional<std::string_view> nearest(std::string_view word, const std::vector<std::string_view>& candidates);

/// The question `; did you mean "…"?`, or an empty text if no candidate is near enough.
std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& candidates);

}  // namespace pseudorigid::scene
