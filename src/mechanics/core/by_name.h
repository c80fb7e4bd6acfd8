#pragma once
/// Members of aggregates that keep initialisers from being wrong.

#include <utility>

namespace pseudorigid {

/// The first member of an aggregate whose values could be mistaken for one another, as those of loads: only
/// initialisers with names compile, `{.viscosity = 0.1}`, so a value cannot slip into the place of another.
struct ByName {
  explicit ByName() = default;
};

/// A member that every initialiser must name: there is no value that would be right by default.
template <class T>
class Required {
 public:
  constexpr Required(T value) : value_(std::move(value)) {}
  constexpr operator const T&() const { return value_; }

 private:
  T value_;
};

}  // namespace pseudorigid
