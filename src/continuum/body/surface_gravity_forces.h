#pragma once
/// Self-gravity of the finite-element ball (gravity/surface_gravity.h): its free surface is all that it needs. With
/// the Gauss points of the faces, as many in a direction as a cell has nodes,
///
///   x = Σ φ_n x_n,   N = ±w ∂x/∂ξ_p × ∂x/∂ξ_q,
///   f_n = −∂Ê/∂x_n = −Σ_points [φ_n ∂Ê/∂x ± w (∂φ_n/∂ξ_p x_q × ∂Ê/∂N + ∂φ_n/∂ξ_q ∂Ê/∂N × x_p)],
///
/// the exact derivative of the discrete Ê: total force and total torque are zero. The sources are the points of all
/// ranks and, where a sector is computed, their mirror images. The density must be uniform: incompressible balls only.

#include <vector>

#include "continuum/mesh/surface_faces.h"
#include "gravity/surface_gravity.h"

namespace pseudorigid::continuum {

class SurfaceGravityForces {
 public:
  /// G in internal units, in which ρ = 1.
  SurfaceGravityForces(double gravity_constant, const BallSpace& space);

  /// f ← f − ∂Ê/∂x. Collective.
  void add(const Vector& x, Vector& f) const;
  /// Ê of the computed sector. Collective.
  double energy(const Vector& x) const;
  /// φ, the potential per mass, at points of the computed sector. Collective.
  std::vector<double> potential(const Vector& x, const std::vector<Eigen::Vector3d>& points) const;

 private:
  struct Point {
    FacePoint face_point;
    double weight;  ///< negative where ∂x/∂ξ_p × ∂x/∂ξ_q points inwards
  };
  /// The points of this rank's faces, and those of all ranks with their images.
  gravity::SurfacePoints own_points(const Vector& x) const;
  gravity::SurfacePoints sources(const gravity::SurfacePoints& own) const;
  gravity::SurfaceTotals over_ranks(const gravity::SurfaceTotals& own) const;

  double constant_;
  const BallSpace& space_;
  std::vector<Point> points_;
  double rest_volume_;
};

}  // namespace pseudorigid::continuum
