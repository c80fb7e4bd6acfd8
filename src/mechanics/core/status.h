#pragma once
/// Failures as return values. Functions for forces, constraints and steps return a Status and do not throw an exception
/// for a failure of the computation.

#include <cstdio>
#include <memory>
#include <string>
#include <utility>

namespace pseudorigid::mechanics {

/// Returns x as text with six significant digits, for messages. Fixed notation would give hundreds of digits for a
/// large number, and 0.000000 for a small number.
[[gnu::cold, gnu::noinline]] inline std::string six_digits(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

/// Success, or a failure with one sentence for the user ("det F = -0.03 at X = (…)"). A success contains only a null
/// pointer.
class [[nodiscard]] Status {
 public:
  Status() = default;
  static Status failure(std::string reason) {
    Status status;
    status.reason_ = std::make_shared<const std::string>(std::move(reason));
    return status;
  }
  bool ok() const { return !reason_; }
  explicit operator bool() const { return ok(); }
  /// The sentence about the failure; empty after success.
  std::string reason() const { return reason_ ? *reason_ : std::string(); }

 private:
  std::shared_ptr<const std::string> reason_;
};

/// Status and number of iterations of a solve with the Gram operator GM⁻¹Gᵀ (constrained_system.h). The number of
/// iterations is 0 if the solver is direct.
struct [[nodiscard]] SolveReport {
  Status status;
  int iterations = 0;
};

}  // namespace pseudorigid::mechanics
