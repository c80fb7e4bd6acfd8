#pragma once
/// Self-gravity of an incompressible polynomial body from its surface (gravity/surface_gravity.h). With the points of
/// the sphere, x = Σ q φ and N = w ∂x/∂e_θ × ∂x/∂e_φ, the energy Ê_h of the discrete surface is exact but for the
/// quadrature. Most of a motion is affine, and of an ellipsoid the energy is known (gravity/ellipsoid_gravity.h), so
/// the error of the affine part is taken off:
///
///   Ê(q) = Ê_h(x) + E_A(A) − Ê_h(A X),   E_A(A) = V_g(A S) (det A)^{1/3},
///
/// where A is the affine part of x (polynomial_space.h), and E_A the energy of the ellipsoid in the gauge of Ê, which
/// does not change under dilations. For degree 1, only E_A remains and there are no sums. The force is the exact
/// derivative of this energy.

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "gravity/ellipsoid_gravity.h"
#include "gravity/surface_gravity.h"
#include "polynomial/polynomial_space.h"

namespace pseudorigid::polynomial {

class BodyGravity {
 public:
  /// Points in each direction of an octant, unless given: with them the error of the force is 1e-6 to 1e-7 of it.
  static int usual_points(int degree) { return degree + 4; }

  /// G in internal units, in which ρ = 1; `n_points` in each direction of an octant.
  BodyGravity(double gravity_constant, std::shared_ptr<const PolynomialSpace> space, std::optional<int> n_points);

  double energy(const Eigen::VectorXd& q) const;
  /// f ← f − ∂Ê/∂q
  void add_force(const Eigen::VectorXd& q, Eigen::VectorXd& f) const;
  /// f ← f − D²Ê(q)[u]
  void add_force_rate(const Eigen::VectorXd& q, const Eigen::VectorXd& u, Eigen::VectorXd& f) const;
  /// The potential per mass φ(x) at points on the surface or within.
  std::vector<double> potential(const Eigen::VectorXd& q, const std::vector<Eigen::Vector3d>& points) const;

 private:
  using Field = std::array<std::vector<double>, 3>;
  /// At the surface points of the computed part: position and derivatives along the tangents, [field][component].
  using SurfaceJets = std::array<Field, 3>;

  bool is_affine() const { return space_->degree() == 1; }
  SurfaceJets jets(const Eigen::VectorXd& q) const;
  gravity::SurfacePoints points(const SurfaceJets& x) const;
  gravity::SurfacePoints rates(const SurfaceJets& x, const SurfaceJets& u) const;
  gravity::SurfacePoints with_images(const gravity::SurfacePoints& points) const;
  /// The part of coefficients that belongs to affine motions.
  Eigen::VectorXd affine_coefficients(const Eigen::VectorXd& q) const;
  void add_affine_force(const Eigen::Matrix3d& D, Eigen::VectorXd& f) const;
  double surface_energy(const Eigen::VectorXd& q) const;
  void add_surface_force(double sign, const Eigen::VectorXd& q, Eigen::VectorXd& f) const;
  void add_surface_force_rate(double sign, const Eigen::VectorXd& q, const Eigen::VectorXd& u,
                              Eigen::VectorXd& f) const;
  void spread(double factor, const SurfaceJets& x, const gravity::SurfaceDerivative& derivative,
              Eigen::VectorXd& f) const;

  double constant_;
  std::shared_ptr<const PolynomialSpace> space_;
  gravity::EllipsoidGravity ellipsoid_;
  PointTables tables_;
  std::vector<std::size_t> places_;  ///< places of the points in the tables, without the padding
  std::vector<double> weights_;      ///< with the sign of the orientation of each image
  double rest_volume_;
};

}  // namespace pseudorigid::polynomial
