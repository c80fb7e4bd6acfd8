#pragma once
/// One form of the reduced body times all methods: a source file each (run_reduced_form.cpp.in), since together they
/// would take a minute to compile.

#include "app/reduced/reduced_scene.h"
#include "app/run/run_context.h"

namespace pseudorigid::app {

template <ReducedForm form>
ModelOutcome run_reduced_form(const ReducedScene& scene, const RunContext& context);

}  // namespace pseudorigid::app
