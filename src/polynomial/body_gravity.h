#pragma once
/// Self-gravity of an incompressible polynomial body, computed from its surface (gravity/surface_gravity.h). The
/// quadrature points are on the unit sphere, with weights w and tangents e_θ, e_φ. At these points, the position is x =
/// Σ q_a φ_a with the coefficients q_a of the basis functions φ_a. The area vector is N = w ∂x/∂e_θ × ∂x/∂e_φ. The sums
/// over the points give the energy Ê_h, in which only the quadrature causes an error. The largest part of a motion is
/// affine, and the energy V_g of an ellipsoid is known (gravity/ellipsoid_gravity.h). Therefore the error of the affine
/// part is subtracted:
///
///   Ê(q) = Ê_h(x) + E_A(A) − Ê_h(A X) − E_ε(q),   E_A(A) = V_g(A S) (det A)^{1/3},
///
/// with the affine part A of x, the reference position X, and the diagonal matrix S of the semi-axes of the reference
/// body. The energy E_ε subtracts the remaining error of the force on the ball (ball_gravity_error.h). Nearly round
/// figures of slow spins need this. Like Ê, E_A and E_ε do not change under dilations of x. For degree 1, Ê is E_A, and
/// energies and forces need no sums. The force is the exact derivative of Ê(q).

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "gravity/ellipsoid_gravity.h"
#include "gravity/surface_gravity.h"
#include "polynomial/ball_gravity_error.h"
#include "polynomial/polynomial_space.h"

namespace pseudorigid::polynomial {

class BodyGravity {
 public:
  /// Default number of points in each direction of an octant. Measurements gave relative errors of the force from 1e-7
  /// to 1e-6 with this number.
  static int usual_points(int degree) { return degree + 4; }

  /// `gravity_constant` is G in internal units, in which ρ = 1. `n_points` is the number of points in each direction of
  /// an octant. If `n_points` is empty, this number is `usual_points`.
  BodyGravity(double gravity_constant, std::shared_ptr<const PolynomialSpace> space, std::optional<int> n_points);

  /// Ê(q) of the whole body.
  double energy(const Eigen::VectorXd& q) const;
  /// f ← f − ∂Ê/∂q. Fails if Ê is too low (gravity::judge_energy).
  mechanics::Status add_force(const Eigen::VectorXd& q, Eigen::VectorXd& f) const;
  /// f ← f − D²Ê(q)[u]
  void add_force_rate(const Eigen::VectorXd& q, const Eigen::VectorXd& u, Eigen::VectorXd& f) const;
  /// The largest entry of the force on the ball that is due to the quadrature, before E_ε subtracts it.
  double error_of_ball() const { return error_of_ball_->size(); }
  /// The gravitational potential per mass at positions `points` in space, on the surface of the deformed body or inside
  /// it.
  std::vector<double> potential(const Eigen::VectorXd& q, const std::vector<Eigen::Vector3d>& points) const;

 private:
  using Field = std::array<std::vector<double>, 3>;
  /// Position and derivatives along e_θ and e_φ at the surface points of the computed sector:
  /// [field][component][point].
  using SurfaceJets = std::array<Field, 3>;

  bool is_affine() const { return space_->degree() == 1; }
  SurfaceJets jets(const Eigen::VectorXd& q) const;
  /// `points` computes the points and area vectors of the computed sector from the jets of x. `rates` computes the
  /// derivatives of these points and area vectors along u. `with_images` returns its argument together with the mirror
  /// images in the rest of the body.
  gravity::SurfacePoints points(const SurfaceJets& x) const;
  gravity::SurfacePoints rates(const SurfaceJets& x, const SurfaceJets& u) const;
  gravity::SurfacePoints with_images(const gravity::SurfacePoints& points) const;
  /// The coefficients of the affine part of q.
  Eigen::VectorXd affine_coefficients(const Eigen::VectorXd& q) const;
  /// f ← f − ∂E/∂q for a function E of the affine part A of q. D is the derivative of E with respect to A.
  void add_affine_force(const Eigen::Matrix3d& D, Eigen::VectorXd& f) const;
  /// `surface_energy` returns Ê_h of the whole body. The other two functions add −sign ∂Ê_h/∂q and −sign D²Ê_h(q)[u] to
  /// f. The first of them also returns Ê_h.
  double surface_energy(const Eigen::VectorXd& q) const;
  double add_surface_force(double sign, const Eigen::VectorXd& q, Eigen::VectorXd& f) const;
  void add_surface_force_rate(double sign, const Eigen::VectorXd& q, const Eigen::VectorXd& u,
                              Eigen::VectorXd& f) const;
  void spread(double factor, const SurfaceJets& x, const gravity::SurfaceDerivative& derivative,
              Eigen::VectorXd& f) const;

  double constant_;  ///< gravitational constant G
  std::shared_ptr<const PolynomialSpace> space_;
  gravity::EllipsoidGravity ellipsoid_;
  PointTables tables_;
  std::vector<std::size_t> places_;  ///< indices of the points in the tables, which also have padding
  std::vector<double> weights_;      ///< weights w; −w at the images of an odd number of reflections
  double rest_volume_;               ///< volume of the undeformed computed sector, from the points of the surface
  std::optional<BallGravityError> error_of_ball_;  ///< has a value after the construction
};

}  // namespace pseudorigid::polynomial
