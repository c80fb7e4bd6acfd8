#pragma once
/// Conversion of a scene to a pseudo-rigid body x = QX in internal units, and choice of the form of the body that is
/// integrated.

#include <optional>

#include "materials/law_table.h"
#include "reduced/center_of_mass.h"
#include "reduced/diagonal_body.h"
#include "reduced/dissipative_body.h"
#include "reduced/loaded_body.h"
#include "reduced/potential.h"
#include "reduced/pseudo_rigid_body.h"
#include "scene/scene.h"

namespace pseudorigid::app {

/// The data of a pseudo-rigid body and its motion, in internal units.
struct ReducedScene {
  materials::AnyLaw law;
  reduced::ReferenceBody body;
  loads::Loads loads;      ///< all loads
  loads::Forcing forcing;  ///< loads that do not depend on time, and all planes
  reduced::Dissipation dissipation;
  reduced::CenterOfMass center;
  mechanics::VectorState<Eigen::Matrix3d> start;  ///< initial deformation Q₀ and its rate Q̇₀
  bool keeps_diagonal;  ///< true if Q remains diagonal in a motion without planes and companions
};

/// Converts a scene. If the body is incompressible, loads that only change its volume are removed.
ReducedScene reduced_scene(const scene::Scene& scene);

/// The forms of the pseudo-rigid body. Each form has only the forces and coordinates that it needs.
enum class ReducedForm {
  elastic,      ///< neo-Hookean energy (Ciarlet–Geymonat's type) and no loads; law known at compile time
  general,      ///< any law, self-gravity, and loads with a potential
  diagonal,     ///< Q remains diagonal, three unknowns; loads as for `general`
  dissipative,  ///< viscosity, drag or loads that depend on time; computes their energies
  loaded        ///< planes, companions or viscoelastic branches, with all other loads
};

template <bool incompressible>
using ElasticBody = reduced::PseudoRigidBody<materials::CiarletGeymonat, incompressible>;
template <bool incompressible>
using GeneralBody = reduced::PseudoRigidBody<reduced::Potential, incompressible>;

/// The sum of the potentials of all conservative forces: stored energy, self-gravity and loads that do not depend on
/// time.
inline reduced::Potential potential_of(const ReducedScene& s) { return {s.law, s.body, s.forcing}; }

template <bool incompressible>
GeneralBody<incompressible> general_body(const ReducedScene& s) {
  return {potential_of(s), s.body};
}

/// The form with the fewest forces and coordinates that contains all forces and coordinates of the scene.
ReducedForm form_of(const ReducedScene& scene);

/// The system of a form. The form `elastic` is valid only for the law of Ciarlet and Geymonat without self-gravity and
/// loads. For another law, the function throws std::bad_variant_access. The form `diagonal` is valid only if Q remains
/// diagonal.
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
    return reduced::LoadedBody<Body>(general_body<incompressible>(s), s.loads);
}

/// The initial state of the scene in the coordinates of `system`.
template <class System>
mechanics::State<System> start_of(const System& system, const ReducedScene& s) {
  if constexpr (requires { system.start(s.start, s.center.position, s.center.velocity); })
    return system.start(s.start, s.center.position, s.center.velocity);
  else if constexpr (requires { System::state_of(s.start); })
    return System::state_of(s.start);
  else
    return s.start;
}

}  // namespace pseudorigid::app
