#pragma once
/// Self-gravity of the finite-element ball (gravity/surface_gravity.h): its free surface is all that it needs. With
/// the Gauss points of the faces,
///
///   x = Σ φ_n x_n,   N = ±w ∂x/∂ξ_p × ∂x/∂ξ_q,
///   f_n = −∂Ê/∂x_n = −Σ_points [φ_n ∂Ê/∂x ± w (∂φ_n/∂ξ_p x_q × ∂Ê/∂N + ∂φ_n/∂ξ_q ∂Ê/∂N × x_p)],
///
/// the exact derivative of the discrete Ê: total force and total torque are zero. The sources are the points of all
/// ranks and, where a sector is computed, their mirror images. Pairs of this rank's points are computed once for both.
/// The density must be uniform: incompressible balls only.

#include <array>
#include <vector>

#include "continuum/mesh/surface_interpolation.h"
#include "gravity/surface_gravity.h"

namespace pseudorigid::continuum {

/// Points in each direction for which the error of gravity is below the error of the mesh: k + 2, and k + 1 if the
/// faces of an elastic body are refined. With k + 1 points on the surface of a fluid, which only gravity stabilises,
/// the shortest waves of the mesh grow by a factor of 2.3 in the time 1/√(Gρ). With k + 2 points their weight is
/// resolved.
int n_gravity_points(const BallSpace& space, bool is_fluid);

class SurfaceGravityForces {
 public:
  /// G in internal units, in which ρ = 1; the number of points in a direction of each face.
  SurfaceGravityForces(double gravity_constant, const BallSpace& space, int n_points);

  /// G
  double constant() const { return constant_; }

  /// f ← f − ∂Ê/∂x. Collective.
  void add(const Vector& x, Vector& f) const;
  /// f ← f − D²Ê(x)[u] for x with the symmetry of the sector and u(R_c X) = s_c R_c u(X) under its reflections R_c:
  /// with s_c = 1 the rate of the force, with others that of a motion which is odd under some reflections. Collective.
  void add_rate(const Vector& x, const Vector& u, const std::array<int, 3>& s, Vector& f) const;
  /// Ê of the computed sector. Collective.
  double energy(const Vector& x) const;
  /// φ, the potential per mass, at points of the computed sector. Collective.
  std::vector<double> potential(const Vector& x, const std::vector<Eigen::Vector3d>& points) const;

 private:
  using Jets = SurfaceInterpolation::Jets;
  using Signs = std::array<int, 3>;  ///< signs under the reflections of the sector: all 1, except for rates

  Jets jets_at(const Vector& x) const;
  /// The points of this rank's faces from the jets of x, and the rates of points and areas from those of u.
  gravity::SurfacePoints own_points(const Jets& x) const;
  gravity::SurfacePoints own_rates(const Jets& x, const Jets& u) const;
  /// Points or rates with their images.
  gravity::SurfacePoints with_images(const std::vector<std::array<double, 6>>& points, const Signs& s) const;
  /// The points of all ranks with their images.
  gravity::SurfacePoints sources(const gravity::SurfacePoints& own, const Signs& s = {1, 1, 1}) const;
  /// The sums over all sources.
  gravity::PairSums sums_at(const gravity::SurfacePoints& own) const;
  gravity::SurfaceTotals over_ranks(const gravity::SurfaceTotals& own) const;
  /// f ← f − the forces of a derivative by points and areas.
  void spread(const Jets& x, const gravity::SurfaceDerivative& derivative, Vector& f) const;

  double constant_;
  const BallSpace& space_;
  SurfaceInterpolation surface_;
  double rest_volume_;
};

}  // namespace pseudorigid::continuum
