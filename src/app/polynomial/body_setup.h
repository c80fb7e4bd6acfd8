#pragma once
/// Data of one run of the polynomial model, and the setup of its body.

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "app/run/deformation_trace.h"
#include "app/run/run_context.h"
#include "app/run/scene_to_model.h"
#include "polynomial/polynomial_body.h"
#include "scene/stabilization.h"

namespace pseudorigid::app {

/// One run of a polynomial body of this degree.
struct PolynomialTask {
  int degree;
  std::string name = "polynomial";     ///< name of the files of the run
  DeformationTrace* trace = nullptr;   ///< receives the affine part Q at each sample; null if this is not requested
  std::optional<Stepping> stepping{};  ///< method and step of another run; if empty, the run searches for them
};

/// Number of quadrature points in each direction of an octant: the entry Polynomial/Quadrature points, but at least the
/// number that the degree requires. Empty if the scene does not have this entry; the body then uses its default.
inline std::optional<int> quadrature_points(const scene::Scene& scene, int degree) {
  if (!scene.polynomial.quadrature_points) return std::nullopt;
  return std::max(*scene.polynomial.quadrature_points, polynomial::PolynomialSpace::least_points(degree));
}

/// The setup of the body in internal units. If reflect[i] is true, only the half of the body on one side of the plane
/// X_i = 0 is computed. The other half is its mirror image.
inline polynomial::BodySetup body_setup(const scene::Scene& scene, const std::array<bool, 3>& reflect, int degree) {
  const double kappa = scene::volumetric_stiffness(scene) / units_of(scene).stress();
  const DiscreteLaw law = discrete_law(scene);
  return {.degree = degree,
          .reflect = reflect,
          .semi_axes = to_eigen(scene.body.semi_axes),
          .law = law.law,
          .volumetric_stiffness = kappa,
          .projected_bulk = law.projected_bulk,
          .loads = internal_loads(scene),
          .n_gravity_points = scene.polynomial.gravity_points,
          .n_points = quadrature_points(scene, degree),
          .n_contact_points = scene.polynomial.contact_points};
}

}  // namespace pseudorigid::app
