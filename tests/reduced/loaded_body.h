#pragma once
/// Bodies of SL(3) under forces that the program has not: Q̈ = −∂V + D + λQ⁻ᵀ with D(Q, Q̇) per m̄. On SL(3) only its
/// tangential part D − (D:N)N moves the body, with N = Q⁻ᵀ/|Q⁻¹|.

#include <cmath>
#include <numbers>
#include <utility>

#include "reduced/bodies.h"

namespace pseudorigid::testing {

template <class Force>
class LoadedBody {
 public:
  using Vector = Sl3::Vector;
  using Workspace = Sl3::Workspace;

  /// E₀ of the body must be m̄ Id.
  LoadedBody(const Sl3& body, Force force) : body_(body), force_(std::move(force)) {}

  mechanics::Status acceleration(double t, const Vector& Q, const Vector& Qdot, Workspace& w, Vector& a) const {
    auto status = body_.acceleration(t, Q, Qdot, w, a);
    if (!status) return status;
    const Matrix3d N = Q.inverse().transpose().normalized(), D = force_(Q, Qdot);
    a += D - mechanics::dot(D, N) * N;
    return status;
  }
  Vector make_vector() const { return Vector::Zero(); }
  Workspace make_workspace() const { return {}; }

 private:
  Sl3 body_;
  Force force_;
};

/// A ball of fluid, W = 0: the multiplier is the only force.
inline Sl3 fluid(double r = 1, double rho = 1) {
  const double volume = 4 * std::numbers::pi / 3 * std::pow(r, 3), m_bar = rho * volume * r * r / 5;
  return {Law{0, 0}, {m_bar * Matrix3d::Identity(), volume}};
}

}  // namespace pseudorigid::testing
