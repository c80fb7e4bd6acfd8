#pragma once
/// The run of one form of the pseudo-rigid body. Each form has a source file (run_reduced_form.cpp.in), because all
/// forms in one file would take a minute to compile.

#include "app/reduced/reduced_scene.h"
#include "app/run/run_context.h"

namespace pseudorigid::app {

/// Runs the motion of the body in this form. The form must contain all forces of the scene (form_of).
template <ReducedForm form>
ModelOutcome run_reduced_form(const ReducedScene& scene, const RunContext& context);

}  // namespace pseudorigid::app
