#pragma once
/// Types of members that prevent wrong initialisers of aggregates.

#include <utility>

namespace pseudorigid {

/// Type of the first member of an aggregate with several members of one type, such as a load. The aggregate then
/// permits only initialisers with names, `{.viscosity = 0.1}`. A value therefore cannot initialise the wrong member.
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
