#pragma once
/// Conversion of the quantities of a scene from the user's units to internal units. The internal units are the radius
/// r, the mass ρr³ with the density ρ, and the unit of time of scene/scales.h.

#include <Eigen/Core>
#include <vector>

#include "entries/units.h"
#include "loads/list.h"
#include "materials/law_table.h"
#include "scene/scales.h"
#include "scene/scene.h"

namespace pseudorigid::app {

using loads::to_eigen;
/// Returns the vector of the three numbers of v.
Eigen::Vector3d to_eigen(const std::vector<double>& v);

/// The internal units of length, mass and time, measured in the user's units.
io::Units units_of(const scene::Scene& scene);

/// The initial deformation Q₀, and its rate Q̇₀ per internal unit of time.
Eigen::Matrix3d initial_deformation(const scene::Scene& scene);
Eigen::Matrix3d initial_velocity(const scene::Scene& scene, const io::Units& units);

/// The initial position and velocity of the centre of mass, in internal units.
Eigen::Vector3d initial_center(const scene::Scene& scene, const io::Units& units);
Eigen::Vector3d initial_center_velocity(const scene::Scene& scene, const io::Units& units);

/// The loads of a scene, in internal units.
loads::Loads internal_loads(const scene::Scene& scene);

/// The time at which loads that rise from 0 reach their full strength, in internal units; 0 if the loads do not rise.
double rise_time(const scene::Scene& scene);

/// The material law in internal units. For a solid without self-gravity, the unit of time is r/c with the speed c of
/// shear waves, and the shear modulus is exactly 1.
materials::AnyLaw internal_law(const scene::Scene& scene);

/// The law of a model with non-affine motions at each point, and the modulus λ of its projected bulk term
/// (scene/bulk.h). The modulus is 0 if the bulk term is pointwise, and then it belongs to the law.
struct DiscreteLaw {
  materials::AnyLaw law;
  double projected_bulk;
};
/// The law in internal units.
DiscreteLaw discrete_law(const scene::Scene& scene);

/// The ratio γ = ρgr/μ of gravity to elasticity, with the density ρ, the radius r and the shear modulus μ at rest. The
/// gravity at the surface is g = (4/3)πGρr, with Newton's constant G.
double gravity_to_elasticity(const scene::Scene& scene);

}  // namespace pseudorigid::app
