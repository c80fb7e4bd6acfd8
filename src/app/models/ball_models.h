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
/// Runs several contexts of a sweep at the same time. Empty if they have to run one by one.
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

/// By rising number of motions, as in the catalogue.
inline std::vector<BallModel> ball_models() {
  return {
      reduced_model(),
      polynomial_model(),
      continuum_model(),
  };
}

/// The reason why the method or the law of the scene is refused, if it is. The pseudo-rigid body is asked, because
/// every model of the ball refines it.
std::optional<scene::Refusal> refuses_motion(const scene::Scene& scene);

}  // namespace pseudorigid::app
