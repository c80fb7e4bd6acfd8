#pragma once
/// What a scene needs, and what it does not need and therefore is never built, computed or written.

#include <string>
#include <vector>

#include "scene/catalogue.h"
#include "scene/scene.h"
#include "scene/sector.h"

namespace pseudorigid::scene {

struct Needs {
  const SystemDescription* system = nullptr;    ///< null for the ball
  std::vector<const ModelDescription*> models;  ///< of the ball, to run in this order
  bool discretized = false;                     ///< one of them: deal.II, MPI, PETSc, a mesh
  bool constraint = false;                      ///< det = 1 and its multiplier
  bool pressure_space = false;                  ///< of the models that may bend
  bool comparison = false;                      ///< of the others with the last of the models
  bool companion = false;                       ///< the reference has a run on another discretisation, for its error
  bool quadrature_error = false;                ///< an estimate of what the rule of a polynomial body does to Q
  bool contact = false;                         ///< with rigid planes, and the columns about it
  bool surface_watch = false;  ///< of the discretized model: whether its surface reaches the limit of its law
  bool graphics = false;       ///< files for ParaView
  bool report = false;         ///< report.html, and shapes.csv of a discretized model
  Quantities quantities;       ///< the observables to evaluate
  Sector sector;               ///< of the models that may bend
  std::vector<std::string> needed, skipped;  ///< one line each, for people
  std::vector<std::string> warnings;         ///< a sentence each: what is allowed but seldom meant
};

/// Takes a scene that scene::validate returned.
Needs needs(const Scene& scene);

/// The scene in one line without an end of line: what is computed, of which body or system.
std::string summary(const Scene& scene, const Needs& needs);

/// The text of `pseudorigid check`, also written to the log: what the scene needs, and what is skipped and why.
std::string describe(const Scene& scene, const Needs& needs);

}  // namespace pseudorigid::scene
