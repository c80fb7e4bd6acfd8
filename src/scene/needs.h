#pragma once
/// The parts of the program that a scene needs, and the parts that are skipped: never built, computed or written.

#include <string>
#include <vector>

#include "scene/catalogue.h"
#include "scene/scene.h"
#include "scene/sector.h"

namespace pseudorigid::scene {

struct Needs {
  const SystemDescription* system = nullptr;    ///< null for the ball
  std::vector<const ModelDescription*> models;  ///< models of the ball, in the order of their runs
  bool discretized = false;                     ///< one of them: deal.II, MPI, PETSc, a mesh
  bool constraint = false;                      ///< det = 1 and its multiplier
  bool pressure_space = false;                  ///< pressure space of the models that are not affine
  bool comparison = false;                      ///< comparison of the other models with the last model
  bool companion = false;                       ///< the reference has a run on another discretisation, for its error
  bool quadrature_error = false;                ///< estimate of the error of Q by the quadrature of a polynomial body
  bool contact = false;                         ///< contact with rigid planes, and its columns
  bool surface_watch = false;  ///< check of the finite-element model: whether its surface reaches Biot's limit
  bool graphics = false;       ///< files for ParaView
  bool report = false;         ///< report.html, and shapes.csv of a discretized model
  Quantities quantities;       ///< the observables to evaluate
  Sector sector;               ///< sector of the models that are not affine
  std::vector<std::string> needed, skipped;  ///< one line each, for people
  std::vector<std::string> expected;         ///< a line each: errors that can be told beforehand
  std::vector<std::string> warnings;         ///< a sentence each: valid input that is seldom intended
};

/// Takes a scene that scene::validate returned.
Needs needs(const Scene& scene);

/// The scene in one line without a line break: analysis, and body or system.
std::string summary(const Scene& scene, const Needs& needs);

/// The text of `pseudorigid check`, also written to the log: needed parts, and skipped parts with the reason.
std::string describe(const Scene& scene, const Needs& needs);

}  // namespace pseudorigid::scene
