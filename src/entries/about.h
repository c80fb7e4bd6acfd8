#pragma once
/// Documentation of an entry of a parameter file.

#include <string_view>

#include "entries/unit.h"

namespace pseudorigid::scene {

/// The path ("Section/Entry"), the unit and the documentation of an entry.
struct About {
  std::string_view path;
  Unit unit;
  std::string_view documentation;
};

}  // namespace pseudorigid::scene
