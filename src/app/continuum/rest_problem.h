#pragma once
/// The finite-element ball of a scene at rest, on one octant of the builtin mesh, for the computation of modes and Love
/// numbers.

#include <memory>

#include "app/continuum/stored_energy.h"
#include "app/run/scene_to_model.h"
#include "continuum/modes/rest_problem.h"
#include "scene/discretization.h"

namespace pseudorigid::app {

/// The mesh, the kernels and the linear problem of small motions about the undeformed ball at rest. The object cannot
/// be copied, because `problem` refers to the other members.
class BallAtRestOnMesh {
 public:
  BallAtRestOnMesh(const scene::Scene& scene, const scene::Discretization& discretization)
      : stored_(stored_energy(scene)),
        space_(continuum::BallMesh({{true, true, true}}, discretization.refinements), discretization.degree),
        kernels_(continuum::make_cell_kernels(space_, stored_)),
        problem_(space_, *kernels_, stored_, scene.body.incompressible,
                 loads::constant_forcing(internal_loads(scene)).gravity_constant) {}
  BallAtRestOnMesh(const BallAtRestOnMesh&) = delete;
  BallAtRestOnMesh& operator=(const BallAtRestOnMesh&) = delete;

  const continuum::BallSpace& space() const { return space_; }
  const continuum::RestProblem& problem() const { return problem_; }

 private:
  continuum::StoredEnergy stored_;
  continuum::BallSpace space_;
  std::unique_ptr<continuum::CellKernels> kernels_;
  continuum::RestProblem problem_;
};

}  // namespace pseudorigid::app
