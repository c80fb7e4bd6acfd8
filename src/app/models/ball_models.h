#pragma once
/// The models of the ball. To add a model, write a source file in this folder that describes and runs the model. Then
/// add two lines below: the declaration of its function, and its entry in `ball_models`.

#include <optional>
#include <span>
#include <vector>

#include "app/run/run_context.h"
#include "scene/catalogue.h"

namespace pseudorigid::app {

/// A function that runs a model and writes its results to the sinks of the context. If the context has several ranks,
/// every rank must call the function.
using RunModel = ModelOutcome (*)(const RunContext&);
/// A function that computes several runs of a sweep at the same time, one for each context. It returns their outcomes
/// in the order of the contexts. It returns an empty value if a caller must compute each run separately.
using RunTogether = std::optional<std::vector<ModelOutcome>> (*)(std::span<const RunContext>);

/// A model of the ball: its description for parameter files, and the functions that run it.
struct BallModel {
  /// `run` may be null only for a discretized model, whose function is in a library that the program opens later.
  /// Throws std::logic_error if `run` is null for another model. Also throws std::logic_error if the description lacks
  /// the name, adjective, documentation, columns or one of the functions `header`, `needed`, `skipped` and `refuses`.
  BallModel(scene::ModelDescription description, RunModel run, RunTogether together = nullptr);

  scene::ModelDescription description;
  RunModel run;
  RunTogether together;  ///< null if the model computes each run of a sweep separately
};

/// The pseudo-rigid model, the polynomial bodies and the finite-element model.
BallModel reduced_model();
BallModel polynomial_model();
BallModel continuum_model();

/// The models in the order of the catalogue, by increasing number of degrees of freedom.
inline std::vector<BallModel> ball_models() {
  return {
      reduced_model(),
      polynomial_model(),
      continuum_model(),
  };
}

/// The reason to refuse the method or the initial deformation of the scene; empty if both are accepted. The check uses
/// the pseudo-rigid body, because the motions of every model of the ball include the affine motions.
std::optional<scene::Refusal> refuses_motion(const scene::Scene& scene);

}  // namespace pseudorigid::app
