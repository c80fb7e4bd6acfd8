#pragma once
/// The first member of an aggregate whose values could be mistaken for one another, as those of loads: only
/// initialisers with names compile, `{.viscosity = 0.1}`, so a value cannot slip into the place of another.

namespace pseudorigid {

struct ByName {
  explicit ByName() = default;
};

}  // namespace pseudorigid
