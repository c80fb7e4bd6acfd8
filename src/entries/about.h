#pragma once
/// The name, unit and documentation of an entry of a parameter file.

#include <string_view>

#include "entries/unit.h"

namespace pseudorigid::scene {

/// The path of an entry in the file ("Section/Entry"), its unit, and its text for the page of parameters.
struct About {
  std::string_view path;
  Unit unit;
  std::string_view documentation;
};

}  // namespace pseudorigid::scene
