#pragma once
/// The memory of a method as a list of numbers. The memory is the part of the workspace that influences later steps,
/// such as multipliers, earlier positions and the remainders of compensated sums. A checkpoint file contains the list.
/// A run that is resumed with the list agrees with the uninterrupted run bit for bit. Finite-element runs on several
/// ranks agree only up to the constraint tolerance. The function `visit_memory(visit)` of a workspace passes numbers,
/// lists of numbers and vectors to `visit`, always in the same order. For a distributed vector the list contains the
/// entries of this rank.

#include <algorithm>
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "mechanics/core/vector_space.h"

namespace pseudorigid::mechanics {

namespace detail {

/// A `visit` that appends each value to `numbers`.
struct MemorySaver {
  std::vector<double>& numbers;
  void operator()(std::span<double> values) const {
    const std::size_t n = numbers.size();
    numbers.resize(n + values.size());  // GCC 12 warns if insert() adds one number
    std::copy_n(values.begin(), values.size(), numbers.begin() + static_cast<std::ptrdiff_t>(n));
  }
  template <class Value>
  void operator()(Value& value) const {
    if constexpr (std::is_arithmetic_v<Value>)  // whole numbers below 2^53 and Booleans are exact as doubles
      numbers.push_back(static_cast<double>(value));
    else
      (*this)(local_values(value));
  }
};

/// A `visit` that sets each value to the first entries of `numbers`, and removes these entries. `numbers` must have
/// enough entries.
struct MemoryRestorer {
  std::span<const double> numbers;
  void operator()(std::span<double> values) {
    std::copy_n(numbers.begin(), values.size(), values.begin());
    numbers = numbers.subspan(values.size());
  }
  template <class Value>
  void operator()(Value& value) {
    if constexpr (std::is_arithmetic_v<Value>) {
      value = static_cast<Value>(numbers.front());
      numbers = numbers.subspan(1);
    } else {
      (*this)(local_values(value));
    }
  }
};

}  // namespace detail

/// Sets `numbers` to the memory of the workspace. `numbers` is cleared first.
template <class Workspace>
void save_memory(Workspace& workspace, std::vector<double>& numbers) {
  numbers.clear();
  workspace.visit_memory(detail::MemorySaver{numbers});
}

/// Sets the memory of the workspace to `numbers` and returns true. If the list has the wrong length, returns false and
/// changes nothing.
template <class Workspace>
bool restore_memory(Workspace& workspace, std::span<const double> numbers) {
  std::vector<double> present;
  save_memory(workspace, present);
  if (present.size() != numbers.size()) return false;
  workspace.visit_memory(detail::MemoryRestorer{numbers});
  return true;
}

}  // namespace pseudorigid::mechanics
