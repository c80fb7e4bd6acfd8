#pragma once
/// The data that a method keeps from step to step (multipliers known so far, positions of earlier steps, round-off kept
/// back), as a plain list of numbers: saved with a checkpoint and put back, it makes a resumed run repeat the
/// uninterrupted one bit by bit. A workspace hands out its numbers, lists of numbers and vectors by
/// `visit_memory(visit)`, always the same ones in the same order. For a distributed vector the list holds the rank's
/// own part.

#include <algorithm>
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "mechanics/core/vector_space.h"

namespace pseudorigid::mechanics {

namespace detail {

struct MemorySaver {
  std::vector<double>& numbers;
  void operator()(std::span<double> values) const {
    const std::size_t n = numbers.size();
    numbers.resize(n + values.size());  // insert makes GCC 12 warn of a span of one number
    std::copy_n(values.begin(), values.size(), numbers.begin() + static_cast<std::ptrdiff_t>(n));
  }
  template <class Value>
  void operator()(Value& value) const {
    if constexpr (std::is_arithmetic_v<Value>)  // whole numbers below 2^53 and truth values are doubles exactly
      numbers.push_back(static_cast<double>(value));
    else
      (*this)(local_values(value));
  }
};

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

/// `numbers` ← the memory of the workspace; its capacity is reused.
template <class Workspace>
void save_memory(Workspace& workspace, std::vector<double>& numbers) {
  numbers.clear();
  workspace.visit_memory(detail::MemorySaver{numbers});
}

/// The reverse. Returns false and changes nothing if the list does not have the length of the workspace.
template <class Workspace>
bool restore_memory(Workspace& workspace, std::span<const double> numbers) {
  std::vector<double> present;
  save_memory(workspace, present);
  if (present.size() != numbers.size()) return false;
  workspace.visit_memory(detail::MemoryRestorer{numbers});
  return true;
}

}  // namespace pseudorigid::mechanics
