#pragma once
/// Documentation of an entry of a parameter file.

#include <string_view>

#include "entries/unit.h"

namespace pseudorigid::scene {

/// Path ("Section/Entry"), unit, and documentation in full sentences, of one entry.
struct About {
  std::string_view path;
  Unit unit;
  std::string_view documentation;
};

}  // namespace pseudorigid::scene
