#pragma once
/// The picture of a body at one time, at its current position and in the units of the user. Every model computes the
/// same mechanics::BodyFields, from which body_picture computes the fields of the picture. A material point has the
/// position x and the reference position X. The centre of mass is x_c, and F = ∂x/∂X:
///
///   displacement                  u = x − X
///   displacement_without_rotation x − x_c − R X; the rotation R makes ∫ρ |x − x_c − R X|² dV least, and is the polar
///                                 factor of ∫ρ (x − x_c) Xᵀ dV
///   reference_coordinates         X
///   velocity                      ẋ
///   cauchy_stress                 σ, nine entries row by row;  pressure −tr σ/3;  von_mises √(3/2) |dev σ|
///   deformation_gradient          F, nine entries row by row;  jacobian det F;  principal_stretches λ₁ ≥ λ₂ ≥ λ₃,
///                                 the singular values of F
///   energy_density                stored energy W per reference volume;  gravity_potential φ per mass, if it is known
///   contact_pressure              Σ k d (1 + β ḋ) over the rigid planes with a penetration d > 0, per reference area;
///                                 k is the stiffness and β the damping of a plane (loads/plane.h), and ḋ is the rate
///                                 of d; 0 at points that are not on the surface; only if there are planes
///
/// The picture has three constants of the whole body: the time (TimeValue), the centre of mass (center_of_mass), and
/// the rotation R as nine entries row by row (rotation).

#include <Eigen/Core>

#include "entries/units.h"
#include "io/vtu.h"
#include "loads/plane.h"
#include "mechanics/core/body_fields.h"
#include "scene/scene.h"

namespace pseudorigid::io {

/// The rigid planes that the body can touch, and the ellipsoid that is the surface of the reference body, in internal
/// units. The planes must have their positions and speeds at the time of the picture (loads::Plane::at).
struct PicturedContact {
  loads::Planes planes{};
  Eigen::Vector3d semi_axes = Eigen::Vector3d::Ones();  ///< semi-axes of the reference surface
};

/// Returns the grid with the fields that `wanted` selects in groups: the displacements and reference coordinates, the
/// velocity, the stresses and pressures, the deformation, and the energies. `body` has values in internal units at the
/// points to which `blocks` refers. `time` is in the units of the user. `units` converts all other quantities to the
/// units of the user. `cells` selects linear or Lagrange cells.
UnstructuredGrid body_picture(const mechanics::PointBlocks& blocks, const mechanics::BodyFields& body, double time,
                              const Units& units, const scene::Fields& wanted, scene::Cells cells,
                              const PicturedContact& contact = {});

}  // namespace pseudorigid::io
