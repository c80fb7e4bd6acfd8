#pragma once
/// Self-gravity of the finite-element ball, computed from its free surface with the energy Ê of
/// gravity/surface_gravity.h. At the Gauss points of the faces, the position x, the area vector N and the force f_n on
/// a node are
///
///   x = Σ φ_n x_n,   N = ±w ∂x/∂ξ_p × ∂x/∂ξ_q,
///   f_n = −∂Ê/∂x_n = −Σ_points [φ_n ∂Ê/∂x ± w (∂φ_n/∂ξ_p x_q × ∂Ê/∂N + ∂φ_n/∂ξ_q ∂Ê/∂N × x_p)],
///
/// with x_p = ∂x/∂ξ_p, x_q = ∂x/∂ξ_q, and the quadrature weights w. Node n has the position x_n and the basis function
/// φ_n. The sign is chosen such that N points outwards. The force is the exact derivative of the discrete Ê, so the
/// total force and the total torque are zero. The sources of the gravity at a point are the Gauss points of all ranks.
/// If only a sector is computed, the mirror images of these points are also sources. For a pair of points of this rank,
/// the interaction is computed once and used at both points. For the rates of forces, the ranks share the points
/// evenly, because the cells at the surface are not distributed evenly. The density must be uniform, so the ball must
/// be incompressible.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "continuum/mesh/surface_interpolation.h"
#include "gravity/surface_gravity.h"

namespace pseudorigid::continuum {

/// Number of points in each direction of a face for which the error of gravity is below the discretisation error. With
/// the degree k the number is k + 2, or k + 1 if the body is elastic and its mesh is refined. A fluid needs k + 2,
/// because only gravity makes the shortest waves on its surface stable. With k + 1 points, the waves in test runs grew
/// by a factor of 2.3 in the time 1/√(Gρ). With k + 2 points the quadrature resolves the gravity of these waves.
int n_gravity_points(const BallSpace& space, bool is_fluid);

/// The forces f_n, their rates, the energy and the potential of self-gravity.
class SurfaceGravityForces {
 public:
  /// `gravity_constant` is G in internal units, in which ρ = 1. `n_points` is the number of points in each direction of
  /// a face.
  SurfaceGravityForces(double gravity_constant, const BallSpace& space, int n_points);

  /// The gravitational constant G in internal units.
  double constant() const { return constant_; }

  /// f ← f − ∂Ê/∂x. Fails if Ê is too low (gravity::judge_energy). Collective.
  mechanics::Status add(const Vector& x, Vector& f) const;
  /// f ← f − D²Ê(x)[u]. The position x must have the symmetry of the sector. The displacement u must satisfy u(R_c X) =
  /// s_c R_c u(X) under each reflection R_c of the sector. It is even under R_c if s_c = 1, and odd if s_c = −1.
  /// Collective.
  void add_rate(const Vector& x, const Vector& u, const std::array<int, 3>& s, Vector& f) const;

  /// D²Ê(x) as a matrix. Displacement k of its rows and columns has the value 1 in the nodal entry `entries[k]`, and
  /// its images have the signs s of add_rate. On refined meshes, the matrix takes much less time than one product by
  /// add_rate for each column. All points must be on this rank.
  Eigen::MatrixXd hessian(const Vector& x, const std::array<int, 3>& s, const std::vector<unsigned int>& entries) const;
  /// Ê of the computed sector, which is Ê of the ball divided by the number of images. The result is not finite if the
  /// volume inside the surface is 0 or negative. Collective.
  double energy(const Vector& x) const;
  /// The gravitational potential per mass at points of the computed sector, for the position x of the ball. Each rank
  /// can have other points. Collective.
  std::vector<double> potential(const Vector& x, const std::vector<Eigen::Vector3d>& points) const;

 private:
  using Jets = SurfaceInterpolation::Jets;
  using Signs = std::array<int, 3>;     ///< signs s_c under the reflections of the sector; all 1 for positions
  using Entry = std::array<double, 6>;  ///< a point x and its area vector N

  static std::vector<Entry> entries_of(const gravity::SurfacePoints& points);

  /// Values of x and its derivatives ∂x/∂ξ_p and ∂x/∂ξ_q at the points of this rank. The ghost nodes of x need not be
  /// up to date. Collective.
  Jets jets_at(const Vector& x) const;
  /// `own_points` computes the points and area vectors of the faces of this rank from the jets of x. `own_rates`
  /// computes the derivatives of these points and area vectors along u, from the jets of x and u.
  gravity::SurfacePoints own_points(const Jets& x) const;
  gravity::SurfacePoints own_rates(const Jets& x, const Jets& u) const;
  /// Points with their mirror images under the reflections of the sector, the given points first. For rates along u, s
  /// contains the signs s_c.
  gravity::SurfacePoints with_images(const std::vector<Entry>& points, const Signs& s) const;
  /// Points of all ranks with their mirror images, from the points of this rank. For rates along u, s contains the
  /// signs s_c. Collective.
  gravity::SurfacePoints sources(const gravity::SurfacePoints& own, const Signs& s = {1, 1, 1}) const;
  /// The pair sums of gravity/surface_gravity.h over all sources, for each point of this rank. Collective.
  gravity::PairSums sums_at(const gravity::SurfacePoints& own) const;
  /// The same sums and their derivatives, for points with rates whose signs are s. Collective.
  gravity::Moving<gravity::PairSums> sums_at(const gravity::Moving<gravity::SurfacePoints>& own, const Signs& s) const;
  /// Returns the sum of the totals of all ranks. Collective.
  gravity::SurfaceTotals over_ranks(const gravity::SurfaceTotals& own) const;
  /// f_n ← f_n − ∂E/∂x_n for every node n, for a function E of the points and their area vectors. `derivative` is the
  /// derivative of E with respect to the points and area vectors. x contains the jets of the position.
  void spread(const Jets& x, const gravity::SurfaceDerivative& derivative, Vector& f) const;

  double constant_;
  const BallSpace& space_;
  SurfaceInterpolation surface_;
  double rest_volume_;  ///< volume of the undeformed sector, from the same points of the surface
};

}  // namespace pseudorigid::continuum
