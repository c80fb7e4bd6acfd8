#pragma once
/// The words of error messages: quotations that are safe to print, and the nearest name to a misspelt one.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pseudorigid::scene {

/// `text` between quotation marks, shortened to a readable length, without control characters. A character that looks
/// like one of ASCII is named behind it, as it cannot be seen.
std::string quote(std::string_view text);

/// Blanks and other white space removed from both ends.
std::string_view trimmed(std::string_view text);

/// Number of single-letter insertions, deletions and substitutions from one word to the other; case does not count.
int edit_distance(std::string_view from, std::string_view to);

/// The candidate nearest to `word`, if one is near enough. The last part of a path like "Body/Radius" also counts
/// alone, so that an entry in the wrong subsection is found.
std::optional<std::string_view> nearest(std::string_view word, const std::vector<std::string_view>& candidates);

/// `; did you mean "…"?`, or an empty text.
std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& candidates);

}  // namespace pseudorigid::scene
