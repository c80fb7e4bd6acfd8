#pragma once
/// The reduced body of a scene, in internal units, and the form in which it is integrated.

#include <optional>

#include "materials/law_table.h"
#include "reduced/body_on_planes.h"
#include "reduced/center_of_mass.h"
#include "reduced/diagonal_body.h"
#include "reduced/dissipative_body.h"
#include "reduced/potential.h"
#include "reduced/pseudo_rigid_body.h"
#include "scene/scene.h"

namespace pseudorigid::app {

struct ReducedScene {
  materials::AnyLaw law;
  reduced::ReferenceBody body;
  loads::Loads loads;
  loads::Forcing forcing;  ///< the loads that do not depend on time
  reduced::Dissipation dissipation;
  reduced::CenterOfMass center;
  mechanics::VectorState<Eigen::Matrix3d> start;  ///< Q₀, Q̇₀
  bool keeps_diagonal;                            ///< Q = diag(a) for all times
};

ReducedScene reduced_scene(const scene::Scene& scene);

/// The forms of the same body, each without the parts that only other forms need.
enum class ReducedForm {
  elastic,      ///< stored energy of the neo-Hookean kind alone, known when the program is compiled
  general,      ///< any sum of potentials
  diagonal,     ///< neither turns nor circulates: three unknowns
  dissipative,  ///< viscosity or drag, or loads that depend on time, and the energy that they take or give
  touching      ///< rigid planes, which couple the centre of mass to Q, with all of the above
};

template <bool incompressible>
using ElasticBody = reduced::PseudoRigidBody<materials::CiarletGeymonat, incompressible>;
template <bool incompressible>
using GeneralBody = reduced::PseudoRigidBody<reduced::Potential, incompressible>;

/// All that acts on the body of a scene and has a potential.
inline reduced::Potential potential_of(const ReducedScene& s) { return {s.law, s.body, s.forcing}; }

template <bool incompressible>
GeneralBody<incompressible> general_body(const ReducedScene& s) {
  return {potential_of(s), s.body};
}

ReducedForm form_of(const ReducedScene& scene);

/// The system of that form; elastic and diagonal only if form_of says so.
template <ReducedForm form, bool incompressible>
auto system_of(const ReducedScene& s) {
  using Body = GeneralBody<incompressible>;
  if constexpr (form == ReducedForm::elastic)
    return ElasticBody<incompressible>(std::get<materials::CiarletGeymonat>(s.law), s.body);
  else if constexpr (form == ReducedForm::general)
    return general_body<incompressible>(s);
  else if constexpr (form == ReducedForm::diagonal)
    return reduced::DiagonalBody<Body>(general_body<incompressible>(s));
  else if constexpr (form == ReducedForm::dissipative)
    return reduced::DissipativeBody<Body>(general_body<incompressible>(s), s.dissipation, s.loads);
  else
    return reduced::BodyOnPlanes<Body>(general_body<incompressible>(s), s.loads);
}

/// The start in the coordinates of a form.
template <class System>
mechanics::State<System> start_of(const ReducedScene& s) {
  if constexpr (requires { System::state_of(s.start, s.center.position, s.center.velocity); })
    return System::state_of(s.start, s.center.position, s.center.velocity);
  else if constexpr (requires { System::state_of(s.start); })
    return System::state_of(s.start);
  else
    return s.start;
}

}  // namespace pseudorigid::app
