#pragma once
/// The constraint of incompressible polynomial bodies and its derivatives. The pressures have the L²-orthonormal basis
/// ψ_b. The positions have the basis φ_a and the coefficients q (polynomial_space.h). With the velocity v, the
/// multiplier λ = Σλ_bψ_b, the unit vectors e_i, the deformation gradient F and J = det F, the formulas are
///
///   g_b(q) = ∫ψ_b ln J dX,   (G v)_b = ∫ψ_b F⁻ᵀ:∇v dX,   D²g_b(v, v) = −∫ψ_b tr((F⁻¹∇v)²) dX,
///   (Gᵀλ)_ia = ∫λ F⁻ᵀ:∇(φ_a e_i) dX,   rate of Gᵀλ along v: −∫λ F⁻ᵀ∇vᵀF⁻ᵀ:∇(φ_a e_i) dX.
///
/// Vectors may have further entries after the unknowns of the space. The functions do not change these entries.

#include <Eigen/Core>

#include "polynomial/polynomial_space.h"
#include "polynomial/scratch.h"

namespace pseudorigid::polynomial {

/// Sets g to the constraint at q. Returns the least det F at the quadrature points. If it is not positive, g is not
/// valid.
double constraint(const PolynomialSpace& space, const Eigen::VectorXd& q, Eigen::VectorXd& g);
/// Sets b_j = ∫ψ_j B′(θ) dX with θ = Σ g_j ψ_j and the bulk term B of the modulus λ (materials/bulk_energy.h). Returns
/// ∫B(θ) dX.
double bulk(const PolynomialSpace& space, double lambda, const Eigen::VectorXd& g, Eigen::VectorXd& b);
/// r ← G(q) v
void constraint_rate(const PolynomialSpace& space, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                     Eigen::VectorXd& r);
/// r ← D²g(q)(v, v)
void constraint_curvature(const PolynomialSpace& space, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                          Eigen::VectorXd& r);
/// f ← f + Gᵀλ
void add_reaction(const PolynomialSpace& space, const Eigen::VectorXd& q, const Eigen::VectorXd& lambda,
                  Eigen::VectorXd& f);
/// f ← f + rate of Gᵀλ along v
void add_reaction_rate(const PolynomialSpace& space, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                       const Eigen::VectorXd& lambda, Eigen::VectorXd& f);

/// Products with the matrix S = G(q₁) G(q₀)ᵀ, without computing S. `multiply` sets `product` to Sλ.
class ReactionsBetween {
 public:
  ReactionsBetween(const PolynomialSpace& space, const Eigen::VectorXd& q1, const Eigen::VectorXd& q0);
  void multiply(const Eigen::VectorXd& lambda, Eigen::VectorXd& product);

 private:
  const PolynomialSpace& space_;
  bool same_;             ///< true if q₁ and q₀ are the same vector in memory
  ScratchArray A1_, A0_;  ///< F⁻ᵀ at the quadrature points, for q₁ and q₀
};

}  // namespace pseudorigid::polynomial
