#pragma once
/// The models of the ball. A model is one source file of this folder, which describes the model and runs it, and its
/// two lines below.

#include <optional>
#include <span>
#include <vector>

#include "app/run/run_context.h"
#include "scene/catalogue.h"

namespace pseudorigid::app {

using RunModel = ModelOutcome (*)(const RunContext&);
/// Runs at the same time, as a sweep has many; nothing if each has to run by itself.
using RunTogether = std::optional<std::vector<ModelOutcome>> (*)(std::span<const RunContext>);

struct BallModel {
  /// `run` is null for a discretized model, until the library that runs it is opened. Throws std::logic_error if
  /// anything else is missing.
  BallModel(scene::ModelDescription description, RunModel run, RunTogether together = nullptr);

  scene::ModelDescription description;
  RunModel run;
  RunTogether together;  ///< null: one by one
};

BallModel reduced_model();
BallModel polynomial_model();
BallModel continuum_model();

/// The poorest in motions first, as the catalogue has them.
inline std::vector<BallModel> ball_models() {
  return {
      reduced_model(),
      polynomial_model(),
      continuum_model(),
  };
}

/// Why the method of the scene cannot integrate it, or the law cannot have its start, if so. It is asked of the
/// pseudo-rigid body, of which every model of the ball is a finer one.
std::optional<scene::Refusal> refuses_motion(const scene::Scene& scene);

}  // namespace pseudorigid::app
