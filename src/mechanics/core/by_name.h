#pragma once
/// Types for members of aggregates. A member of such a type makes the compiler reject some wrong initialisers.

#include <utility>

namespace pseudorigid {

/// Type of the first member of an aggregate in which several members have the same type. An example is a load. The
/// compiler then accepts only initialisers with names, such as `{.viscosity = 0.1}`. An unnamed value could initialise
/// the wrong member.
struct ByName {
  explicit ByName() = default;
};

/// Type of a member that every initialiser must set, because no default value would be right.
template <class T>
class Required {
 public:
  constexpr Required(T value) : value_(std::move(value)) {}
  constexpr operator const T&() const { return value_; }

 private:
  T value_;
};

}  // namespace pseudorigid
