#pragma once
/// The models of the ball. To add a model, write a source file of this folder that describes and runs it. Then add two
/// lines below: the declaration of its function and the entry in `ball_models`.

#include <optional>
#include <span>
#include <vector>

#include "app/run/run_context.h"
#include "scene/catalogue.h"

namespace pseudorigid::app {

using RunModel = ModelOutcome (*)(const RunContext&);
/// Computes several runs of a sweep at the same time. Returns nothing if they must run one by one.
using RunTogether = std::optional<std::vector<ModelOutcome>> (*)(std::span<const RunContext>);

struct BallModel {
  /// `run` is null for a discretized model: the program opens the library that runs it later. Throws std::logic_error
  /// if any other part is missing.
  BallModel(scene::ModelDescription description, RunModel run, RunTogether together = nullptr);

  scene::ModelDescription description;
  RunModel run;
  RunTogether together;  ///< null if runs of a sweep run one by one
};

BallModel reduced_model();
BallModel polynomial_model();
BallModel continuum_model();

/// The models in the order of the catalogue: a later model has more degrees of freedom.
inline std::vector<BallModel> ball_models() {
  return {
      reduced_model(),
      polynomial_model(),
      continuum_model(),
  };
}

/// The reason why the method or the law of the scene is refused; empty if both are accepted. The test uses the
/// pseudo-rigid body, because the motions of every model of the ball include the affine ones.
std::optional<scene::Refusal> refuses_motion(const scene::Scene& scene);

}  // namespace pseudorigid::app
