#include "scene/choices.h"

#include <fmt/format.h>

#include <string>

namespace pseudorigid::scene {

std::string_view documentation_of_laws() {
  static const std::string text = [] {
    std::string words =
        "Stored energy W per undeformed volume, with C = F^T F, I = tr C, II = (I^2 - tr C^2)/2, J = det F, III = J^2, "
        "mu the shear modulus, lambda Lame lambda and B = (lambda/4) (III - 1 - ln III), a constant if volume is "
        "preserved.";
    for (const materials::NamedLaw& law : materials::law_table) words += fmt::format(" {}: {}", law.name, law.energy);
    return words;
  }();
  return text;
}

std::string_view documentation_of_quantities() {
  static const std::string text = [] {
    std::string words = "Groups of columns to compute and write, listed below; the time is always written.";
    std::size_t n = 0;
    for (const auto& [name, member, documentation] : mechanics::quantity_groups) {
      words +=
          fmt::format(" {}: {}{}", name, documentation, n + 1 == std::size(mechanics::quantity_groups) ? "." : ";");
      if (++n == mechanics::n_default_groups)
        words += fmt::format(" all: these {}. The other groups are written only if named.", n);
    }
    return words;
  }();
  return text;
}

}  // namespace pseudorigid::scene
