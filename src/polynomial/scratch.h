#pragma once
/// Temporary arrays of functions. The memory of destroyed arrays is used again for later arrays of the same thread, so
/// a step of a small body does not allocate memory.

#include <cstddef>
#include <new>
#include <utility>
#include <vector>

namespace pseudorigid::polynomial {

/// An array of n numbers with undefined values. If a function destroys its arrays in the reverse order of their
/// construction, the next call of the function finds arrays of the right size.
class ScratchArray {
 public:
  explicit ScratchArray(std::size_t n) {
    auto& kept = kept_arrays();
    if (!kept.empty()) {
      numbers_ = std::move(kept.back());
      kept.pop_back();
    }
    if (numbers_.size() < n) numbers_.resize(n);
  }
  ~ScratchArray() {
    try {
      kept_arrays().push_back(std::move(numbers_));
    } catch (const std::bad_alloc&) {  // a destructor must not throw; the memory is then freed
    }
  }
  ScratchArray(const ScratchArray&) = delete;
  ScratchArray& operator=(const ScratchArray&) = delete;

  operator double*() { return numbers_.data(); }

 private:
  static std::vector<std::vector<double>>& kept_arrays() {
    thread_local std::vector<std::vector<double>> kept;
    return kept;
  }
  std::vector<double> numbers_;
};

}  // namespace pseudorigid::polynomial
