#pragma once
/// Failure as a value: what a force, a constraint or a step returns instead of throwing or passing on a NaN.

#include <string>
#include <utility>

namespace pseudorigid::mechanics {

/// Empty reason: all is well. Otherwise a sentence for the user ("det F = -0.03 at X = (…)").
class [[nodiscard]] Status {
 public:
  Status() = default;
  static Status failure(std::string reason) { return Status(std::move(reason)); }
  bool ok() const { return reason_.empty(); }
  explicit operator bool() const { return ok(); }
  const std::string& reason() const { return reason_; }

 private:
  explicit Status(std::string reason) : reason_(std::move(reason)) {}
  std::string reason_;
};

}  // namespace pseudorigid::mechanics
