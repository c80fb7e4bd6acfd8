#pragma once
/// Projection onto the orthogonal complement of the orbit of the symmetries. The orbit of a state X = (q, v) is the set
/// of all states to which the symmetries map X. In a step with the change ΔX, the energy-momentum method removes the
/// component of ΔX in the tangent space of the orbit. Symmetry i changes (q, v) along (ξ_i(q), ξ̇_i(v)), as in
/// conservative_system.h. The tangent space of the orbit and the inner product are
///
///   span{(ξ_i(q), ξ̇_i(v))},   ⟨(a, α), (b, β)⟩ = a·M b + α·M β   with the mass M and the system's unit of time.
///
/// With this inner product, the correction of a step accelerates light and heavy parts of a body alike. A covector is
/// projected by the transposed map, so that its product with every tangent vector of the orbit is 0.
///
/// The components are computed by Gram–Schmidt with reorthogonalisation ("twice is enough": Giraud, Langou, Rozložník,
/// Comput. Math. Appl. 50 (2005) 1069). The dimension of an orbit may be less than the number of symmetries. Examples
/// are symmetries with coinciding axes, and a point on its axis of rotation. Tangent vectors that depend linearly on
/// earlier ones are then omitted.

#include <cmath>
#include <cstddef>
#include <vector>

#include "mechanics/core/conservative_system.h"

namespace pseudorigid::mechanics {

template <ConservativeSystem S>
class OrbitComplement {
 public:
  using Vector = typename S::Vector;

  explicit OrbitComplement(const S& system)
      : momentum_(system.make_vector()),
        basis_(static_cast<std::size_t>(system.n_symmetries()), {momentum_, momentum_, momentum_, momentum_}) {}

  /// Computes the basis of the tangent space of the orbit through (q, v).
  void set(const S& system, const Vector& q, const Vector& v) {
    rank_ = 0;
    for (int i = 0; i < system.n_symmetries(); ++i) {
      Direction& e = basis_[rank_];
      system.symmetry(i, q, v, e.q, e.v);
      const double length = project(system, e.q, e.v);
      if (length == 0) continue;
      scale(1 / length, e.q);
      scale(1 / length, e.v);
      system.apply_mass(e.q, e.Mq);
      system.apply_mass(e.v, e.Mv);
      ++rank_;
    }
  }

  /// Removes the component in the tangent space of the orbit from (a, α). Call `set` first. Returns the length of the
  /// remainder, or 0 if this length is at most `dependent` times the original length. The projection is repeated as
  /// long as it removes more than half of the length, because cancellation then magnifies round-off. A NaN ends the
  /// loop, and the result is 0.
  double project(const S& system, Vector& a, Vector& alpha) {
    const double length = norm(system, a, alpha);
    double before = length, left = length;
    do {
      before = left;
      for (std::size_t j = 0; j < rank_; ++j) {
        const double component = dot(basis_[j].Mq, a) + dot(basis_[j].Mv, alpha);
        axpy(-component, basis_[j].q, a);
        axpy(-component, basis_[j].v, alpha);
      }
      left = norm(system, a, alpha);
    } while (left > dependent * length && left < 0.5 * before);
    return left > dependent * length ? left : 0;
  }

  /// Makes the product of the covector (A, B) with each tangent vector of the orbit 0. Call `set` first.
  void project_covector(Vector& A, Vector& B) const {
    for (int pass = 0; pass < 2; ++pass)
      for (std::size_t j = 0; j < rank_; ++j) {
        const double component = dot(basis_[j].q, A) + dot(basis_[j].v, B);
        axpy(-component, basis_[j].Mq, A);
        axpy(-component, basis_[j].Mv, B);
      }
  }

  /// The norm √⟨(a, α), (a, α)⟩.
  double norm(const S& system, const Vector& a, const Vector& alpha) {
    system.apply_mass(a, momentum_);
    const double of_a = dot(a, momentum_);
    system.apply_mass(alpha, momentum_);
    return std::sqrt(of_a + dot(alpha, momentum_));
  }

 private:
  struct Direction {
    Vector q, v, Mq, Mv;  // a tangent vector of length 1, and its product with M
  };
  /// Relative length of a remainder that counts as 0. Such a remainder changes the square of the length of ΔX by the
  /// fraction 10⁻¹². The directions of the basis have errors of at most ε/10⁻⁶, with the round-off ε.
  static constexpr double dependent = 1e-6;

  Vector momentum_;  // temporary
  std::vector<Direction> basis_;
  std::size_t rank_ = 0;
};

}  // namespace pseudorigid::mechanics
