#pragma once
/// The pseudo-rigid body (Dirichlet–Riemann; Oliva 5.7): x = Q X with Q ∈ SL(3) or GL⁺(3). The kinetic energy K, the
/// potential V and the equation of motion with the multiplier Λ are
///
///   K = ½ tr(Q̇ E₀ Q̇ᵀ),   V(Q) = Vol · W(Q), or V of potential.h with gravity and loads,
///   Q̈ E₀ = −∂V/∂Q + Λ Q⁻ᵀ,   ln det Q = 0                                                   (5.120)
///
/// E₀ and Vol are the inertia and the volume of reference_body.h, and W is the stored energy per reference volume. On
/// SL(3) the constraint g = ln det Q has G(Q)Q̇ = tr(Q⁻¹Q̇), GᵀΛ = ΛQ⁻ᵀ and D²g(Q̇,Q̇) = −tr((Q⁻¹Q̇)²). The mass
/// operator M maps Q̈ to Q̈ E₀. The equation G(Q₁) M⁻¹ G(Q₀)ᵀ Λ = r is therefore tr(Q₁⁻¹ Q₀⁻ᵀ E₀⁻¹) Λ = r. Its solution
/// is a division. The multiplier of Oliva is λ = Λ/m̄ with m̄ = ⅓ tr E₀. On GL⁺(3) there is no constraint and no
/// multiplier.

#include <Eigen/Dense>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

#include "materials/eigen_tensor.h"
#include "materials/law_limits.h"
#include "materials/scalar.h"
#include "mechanics/core/axial_vectors.h"
#include "mechanics/core/conservative_system.h"
#include "reduced/body_of_stages.h"
#include "reduced/potential.h"
#include "reduced/reference_body.h"

namespace pseudorigid::reduced {

/// `EnergyDensity` has the functions energy(Q), which is V per reference volume, and stress(Q), the derivative of
/// energy(Q). It is reduced::Potential, or a material law if V is the stored energy alone.
template <class EnergyDensity, bool incompressible>
class PseudoRigidBody {
  static constexpr bool has_parts = std::is_same_v<EnergyDensity, Potential>;
  static constexpr bool is_known_law = []<class... Laws>(std::variant<Laws...>*) {
    return (std::is_same_v<EnergyDensity, Laws> || ...);
  }(static_cast<materials::AnyLaw*>(nullptr));

 public:
  using Vector = Eigen::Matrix3d;
  /// True if the kernels of body_of_stages.h can evaluate this body.
  static constexpr bool knows_stages = has_parts || is_known_law;
  using Multiplier = std::conditional_t<incompressible, double, mechanics::NoMultiplier>;
  struct Workspace {};
  static constexpr int n_constraints = incompressible ? 1 : 0;

  PseudoRigidBody(EnergyDensity density, const ReferenceBody& body)
      : density_(std::move(density)),
        reference_(body),
        volume_(body.volume),
        E0_(body.E0),
        E0_inverse_(body.E0.inverse()),
        m_bar_(body.E0.trace() / 3),
        inverse_m_bar_(1 / m_bar_),
        isotropic_(body.E0.isApprox(m_bar_ * Eigen::Matrix3d::Identity(), 1e-14)) {
    if constexpr (has_parts)
      of_stages_ = body_of_stages(density_.law(), body, incompressible, isotropic_, density_.forcing());
    else if constexpr (is_known_law)
      of_stages_ = body_of_stages(density_, body, incompressible, isotropic_);
  }

  /// Computes Q̈ of (5.120) with its multiplier, from J = det Q and one cofactor matrix C = cof Q = J Q⁻ᵀ:
  ///   Q̈ = −A + Λ Q⁻ᵀE₀⁻¹,   A = ∂V E₀⁻¹,   Λ = [tr((Q⁻¹Q̇)²) + tr(Q⁻¹A)] / tr(Q⁻¹Q⁻ᵀE₀⁻¹)
  ///      = −A + s C E₀⁻¹,    s = Λ/J = [tr((CᵀQ̇)²) + J C:A] / (J C:CE₀⁻¹)
  /// On GL⁺(3), Q̈ = −A. Fails if Q is not admissible, or if Λ is not finite.
  mechanics::Status acceleration(double, const Vector& Q, const Vector& Qdot, Workspace&, Vector& a) const {
    if (isotropic_)
      return accelerate(Q, Qdot, a, [this](double s, const Tensor& X) { return (s * inverse_m_bar_) * X; });
    return accelerate(Q, Qdot, a, [this](double s, const Tensor& X) {
      return s * materials::to_tensor(materials::to_matrix(X) * E0_inverse_);
    });
  }

  /// Solves the stages of a Gauss step in lanes, and sets stages.converged (mechanics/core/stage_by_stage.h). Returns
  /// false and does nothing if the lanes cannot compute the self-gravity accurately.
  bool solve_stages_in_lanes(mechanics::GaussStages& stages) const requires(knows_stages) {
    if (!takes_gravity_in_lanes(of_stages_, Eigen::Map<const Vector>(stages.q))) return false;
    solve_stages_of_body(of_stages_, BodyEntries::matrix, nullptr, stages);
    return true;
  }
  double cost_of_iteration() const requires(knows_stages) {
    return reduced::cost_of_iteration(of_stages_, BodyEntries::matrix);
  }
  const BodyOfStages& of_stages() const requires(knows_stages) { return of_stages_; }

  /// Sets f to the force −∂V/∂Q. Fails if Q is not admissible.
  mechanics::Status force(double, const Vector& Q, const Vector&, Workspace&, Vector& f) const {
    const Tensor q = materials::to_tensor(Q);
    if (const double J = materials::determinant(q); !admissible(q, J)) return inadmissible(J);
    materials::to_matrix(-volume_ * density_.stress(q), f);
    return {};
  }
  void apply_inverse_mass(const Vector& f, Vector& a) const {
    if (isotropic_)
      a = f * inverse_m_bar_;
    else
      a = f * E0_inverse_;
  }
  void apply_mass(const Vector& v, Vector& f) const { f = v * E0_; }

  /// Sets g to ln det Q, or nothing on GL⁺(3). Fails if det Q is not positive and finite.
  mechanics::Status constraint(const Vector& Q, Multiplier& g) const {
    const double J = materials::determinant(materials::to_tensor(Q));
    if (!has_volume(J)) return without_volume(J);
    if constexpr (incompressible) g = materials::log_near_one(J);
    return {};
  }
  /// Sets g to ln det(Q + Q_rounding) with an error of about 1e-19, for a Q with the rounding error Q_rounding. Fails
  /// if the determinant is not positive and finite.
  mechanics::Status constraint(const Vector& Q, const Vector& Q_rounding, Multiplier& g) const requires incompressible {
    materials::Tensor<long double> q;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) q(i, j) = static_cast<long double>(Q(i, j)) + Q_rounding(i, j);
    const long double J = materials::determinant(q);
    if (!has_volume(static_cast<double>(J))) return without_volume(static_cast<double>(J));
    g = materials::log_near_one(J);
    return {};
  }
  void constraint_rate(const Vector& Q, const Vector& v, Multiplier& r) const {
    if constexpr (incompressible) {
      const Tensor q = materials::to_tensor(Q), cof = materials::cofactor(q);
      r = materials::dot(cof, materials::to_tensor(v)) / materials::determinant(q, cof);
    }
  }
  void constraint_curvature(const Vector& Q, const Vector& v, Multiplier& r) const {
    if constexpr (incompressible) {
      const Tensor q = materials::to_tensor(Q), cof = materials::cofactor(q);
      const double J = materials::determinant(q, cof);
      r = -materials::trace_of_square(materials::transposed_product(cof, materials::to_tensor(v))) / (J * J);
    }
  }
  void add_reaction(const Vector& Q, const Multiplier& lambda, Vector& f) const {
    if constexpr (incompressible) {
      const Tensor q = materials::to_tensor(Q), cof = materials::cofactor(q);
      f += materials::to_matrix((lambda / materials::settled_at_one(materials::determinant(q, cof))) * cof);
    }
  }
  /// Sets f to the reaction Gᵀλ for λ = 1, which is Q⁻ᵀ.
  void reaction_of_one(const Vector& Q, Vector& f) const requires incompressible {
    const Tensor q = materials::to_tensor(Q), cof = materials::cofactor(q);
    materials::to_matrix((1 / materials::settled_at_one(materials::determinant(q, cof))) * cof, f);
  }
  /// Adds the time derivative of the reaction Gᵀλ for Q̇ = v to f. The derivative of Q⁻ᵀ is −Q⁻ᵀ vᵀ Q⁻ᵀ.
  void add_reaction_rate(const Vector& Q, const Vector& v, const Multiplier& lambda, Vector& f) const {
    if constexpr (incompressible) {
      const Eigen::Matrix3d inverse_transposed = Q.inverse().transpose();
      f -= lambda * inverse_transposed * v.transpose() * inverse_transposed;
    }
  }
  /// Solves G(Q₁) M⁻¹ G(Q₀)ᵀ λ = r by the division in the head of this file. Does nothing on GL⁺(3). Does not fail.
  mechanics::SolveReport solve_gram(const Vector& Q1, const Vector& Q0, const Multiplier& r, Workspace&,
                                    Multiplier& lambda) const {
    if constexpr (incompressible) {
      const Tensor q1 = materials::to_tensor(Q1), cof1 = materials::cofactor(q1);
      const Tensor q0 = materials::to_tensor(Q0), cof0 = materials::cofactor(q0);
      Vector direction = materials::to_matrix(cof0);
      apply_inverse_mass(direction, direction);
      lambda = r * (materials::determinant(q1, cof1) * materials::determinant(q0, cof0)) /
               materials::dot(cof1, materials::to_tensor(direction));
    }
    return {};
  }
  /// Largest absolute values of the constraint g and of its rate GQ̇ that count as zero, the round-off of ln det Q. For
  /// large axis ratios the round-off is larger, and iterations detect it with ConvergenceMonitor
  /// (mechanics/core/constraint_newton.h).
  double constraint_tolerance() const { return 4e-16; }

  Vector make_vector() const { return Vector::Zero(); }
  Multiplier make_multiplier() const { return {}; }
  Workspace make_workspace() const { return {}; }

  double kinetic_energy(const Vector& v) const { return 0.5 * (v * E0_ * v.transpose()).trace(); }
  PotentialEnergies potential_energies(const Vector& Q) const {
    if constexpr (has_parts)
      return density_.energies(Q);
    else
      return {.elastic = volume_ * density_.energy(materials::to_tensor(Q))};
  }
  double potential_energy(const Vector& Q) const { return potential_energies(Q).total(); }

  /// Number of symmetries. Symmetries 0 to 2 are the rotations of space, Q ↦ Q + ε ê_i Q, with the momentum J_i.
  /// Symmetries 3 to 5 are the rotations of the reference ball, Q ↦ Q − ε Q ê_i, with the momentum −Z_i. J is the
  /// angular momentum, Z the circulation, and ê_i the matrix of e_i×. The rotations of the reference ball are
  /// symmetries if E₀ ∝ Id and the law is isotropic. If a load depends on direction, the number is 0. Some rotations
  /// may still be symmetries, but methods do not need these symmetries.
  int n_symmetries() const { return depends_on_direction() ? 0 : isotropic_ ? 6 : 3; }
  void symmetry(int i, const Vector& Q, const Vector& v, Vector& dQ, Vector& dv) const {
    const Eigen::Matrix3d turn = mechanics::cross_matrix(Eigen::Vector3d::Unit(i % 3));
    if (i < 3) {
      dQ = turn * Q;
      dv = turn * v;
    } else {
      dQ = -Q * turn;
      dv = -v * turn;
    }
  }

  const EnergyDensity& energy_density() const { return density_; }
  const ReferenceBody& reference() const { return reference_; }
  double m_bar() const { return m_bar_; }
  const Eigen::Matrix3d& E0() const { return E0_; }

  /// Cauchy stress σ = (P − (Λ/Vol) Q⁻ᵀ) Qᵀ / det Q of the homogeneous state, with the stress P of the material without
  /// loads. `lambda` is the multiplier Λ per m̄.
  Eigen::Matrix3d cauchy_stress(const Vector& Q, double lambda) const {
    Eigen::Matrix3d P;
    if constexpr (has_parts)
      P = density_.material_stress(Q);
    else
      P = materials::to_matrix(density_.stress(materials::to_tensor(Q)));
    return (P * Q.transpose() - lambda * m_bar_ / volume_ * Eigen::Matrix3d::Identity()) / Q.determinant();
  }

  /// Fails with the reason if det Q is not positive and finite, or if the law does not admit Q.
  mechanics::Status admissible(const Vector& Q) const {
    const Tensor q = materials::to_tensor(Q);
    const double J = materials::determinant(q);
    return admissible(q, J) ? mechanics::Status() : inadmissible(J);
  }

  /// Functions that all forms of the body have (diagonal_body.h, dissipative_body.h, loaded_body.h). They return the
  /// body, the matrix Q, the state as (Q, Q̇), and the dissipated energy, which is 0 for this form.
  const PseudoRigidBody& body() const { return *this; }
  static const Eigen::Matrix3d& matrix(const Vector& q) { return q; }
  const mechanics::VectorState<Vector>& motion(const mechanics::VectorState<Vector>& state) const { return state; }
  double dissipated(const mechanics::VectorState<Vector>&) const { return 0; }

 private:
  using Tensor = materials::Tensor<double>;

  bool depends_on_direction() const {
    if constexpr (has_parts) return density_.depends_on_direction();
    return false;
  }

  /// Implementation of `acceleration` for scaled_by_inertia(s, X) = s X E₀⁻¹.
  template <class ScaledByInertia>
  mechanics::Status accelerate(const Vector& Q, const Vector& Qdot, Vector& a,
                               ScaledByInertia scaled_by_inertia) const {
    const Tensor q = materials::to_tensor(Q), C = materials::cofactor(q);
    const double J = materials::determinant(q, C);
    const Tensor A = scaled_by_inertia(volume_, density_.stress(q));
    if constexpr (incompressible) {
      const Tensor B = scaled_by_inertia(1, C);
      const double curvature = materials::trace_of_square(materials::transposed_product(C, materials::to_tensor(Qdot)));
      const double s = (curvature + J * materials::dot(C, A)) * (1 / (J * materials::dot(C, B)));
      if (!admissible(q, J)) return inadmissible(J);
      if (!std::isfinite(s)) return not_finite();
      materials::to_matrix(materials::entrywise([&](double x, double y) { return s * y - x; }, A, B), a);
    } else {
      if (!admissible(q, J)) return inadmissible(J);
      materials::to_matrix(-1.0 * A, a);
    }
    return {};
  }

  static bool has_volume(double J) { return J > 0 && std::isfinite(J); }
  bool admissible(const Tensor& Q, double J) const { return has_volume(J) && materials::admits(density_, Q); }
  /// The message is made in a separate function, because its code would slow down the evaluation of the force.
  [[gnu::cold, gnu::noinline]] static mechanics::Status without_volume(double J) {
    return mechanics::Status::failure("the body has been turned inside out or is not finite: det Q = " +
                                      mechanics::six_digits(J));
  }
  [[gnu::cold, gnu::noinline]] mechanics::Status inadmissible(double J) const {
    if (!has_volume(J)) return without_volume(J);
    return mechanics::Status::failure(materials::beyond_limit(materials::limit_of(density_)));
  }
  [[gnu::cold, gnu::noinline]] static mechanics::Status not_finite() {
    return mechanics::Status::failure("the acceleration of the body is not finite");
  }

  EnergyDensity density_;
  ReferenceBody reference_;
  double volume_;
  Eigen::Matrix3d E0_, E0_inverse_;
  double m_bar_, inverse_m_bar_;
  bool isotropic_;  // true if E₀ = m̄ Id
  BodyOfStages of_stages_;
};

}  // namespace pseudorigid::reduced
