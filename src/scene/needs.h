#pragma once
/// The parts of the program that a scene needs. Parts that a scene does not need are not built, computed or written.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/catalogue.h"
#include "scene/scene.h"
#include "scene/sector.h"

namespace pseudorigid::scene {

struct Needs {
  const SystemDescription* system = nullptr;  ///< null for the ball
  /// Models of the scene that offer the analysis, in the order of their runs. The list is empty for a system other than
  /// the ball.
  std::vector<const ModelDescription*> models;
  bool discretized = false;  ///< whether a model needs a mesh, deal.II, MPI and PETSc
  bool constraint = false;   ///< whether the body is incompressible
  /// Whether a model has motions that are not affine, and the body is incompressible or has a projected bulk term
  /// (scene/bulk.h).
  bool pressure_space = false;
  bool comparison = false;  ///< whether the runs of the models are compared with the last run
  bool companion = false;   ///< whether a companion run estimates the error in space of the last model
  /// Whether pilot runs estimate the error that the quadrature of polynomial bodies causes.
  bool quadrature_error = false;
  bool contact = false;  ///< whether the scene has rigid planes
  bool orbit = false;    ///< whether the body has companions
  /// Whether the compression of the surface of finite elements is compared with Biot's limit, at which a surface
  /// wrinkles.
  bool surface_watch = false;
  bool graphics = false;                     ///< whether files for ParaView are written
  bool report = false;                       ///< whether report.html is written
  Quantities quantities;                     ///< groups of columns to compute and write
  Sector sector;                             ///< sector of the models with motions that are not affine
  std::vector<std::string> needed, skipped;  ///< lines about needed and skipped parts, for the user
  std::vector<std::string> expected;         ///< lines about errors that are known before the run
  std::vector<std::string> warnings;         ///< sentences about valid input that is seldom intended
  /// Least and largest ratio γ (scene/scale_numbers.h) in the runs of a sweep; empty if there is only one run.
  std::optional<std::pair<double, double>> gammas;
};

/// The needs of a scene that scene::validate has returned. The members `expected` and `gammas` remain empty, and
/// callers set them. For a system other than the ball, only `system`, `report`, `needed` and `skipped` are set.
Needs needs(const Scene& scene);

/// One line of text: the analysis, the body or system, and the end time of a motion or section.
std::string summary(const Scene& scene, const Needs& needs);

/// The text that `pseudorigid check` prints, and that a run writes to the log. It begins with the title and the
/// summary. It then lists the scales of a ball, the needed parts, the skipped parts with the reasons, the expected
/// errors, and warnings.
std::string describe(const Scene& scene, const Needs& needs);

}  // namespace pseudorigid::scene
