#pragma once
/// Check that processes that were started together have the same input. Without this check, the input of some processes
/// would be ignored, or the ranks would wait for each other forever.

#include <string>
#include <string_view>
#include <vector>

#include "app/ranks/on_all_ranks.h"
#include "entries/wording.h"
#include "scene/user_error.h"

namespace pseudorigid::app {

/// Compares the input of each rank with the input of the first rank. `mine` has the lines of this rank's input, for
/// example the entries of its scene. If an input differs, all ranks throw FailureOnAllRanks, whose message has the
/// first line that differs. Collective.
inline void require_same_on_all_ranks(const Ranks& ranks, const std::vector<std::string>& mine) {
  if (ranks.size() == 1) return;
  std::string text;
  for (const std::string& line : mine) text += line + "\n";
  const std::string first = ranks.text_of(0, text);
  on_all_ranks(ranks, [&] {
    if (text == first) return;
    std::string_view here = text, there = first;
    const auto take_line = [](std::string_view& rest) {
      const std::string_view line = rest.substr(0, rest.find('\n'));
      rest.remove_prefix(std::min(line.size() + 1, rest.size()));
      return line;
    };
    std::string_view has = take_line(here), had = take_line(there);
    while (has == had) has = take_line(here), had = take_line(there);
    throw UserError("rank " + std::to_string(ranks.rank()) + " was started with " + scene::quote(has) +
                    " and rank 0 with " + scene::quote(had) + "; processes started together run one scene");
  });
}

}  // namespace pseudorigid::app
