#pragma once
/// The parts of the program that a scene needs. The program does not build, compute or write the other parts.

#include <string>
#include <vector>

#include "scene/catalogue.h"
#include "scene/scene.h"
#include "scene/sector.h"

namespace pseudorigid::scene {

struct Needs {
  const SystemDescription* system = nullptr;    ///< null for the ball
  std::vector<const ModelDescription*> models;  ///< models of the ball in the order of their runs
  bool discretized = false;                     ///< whether a model needs a mesh, deal.II, MPI and PETSc
  bool constraint = false;                      ///< the constraint det = 1 and its multiplier
  bool pressure_space = false;    ///< pressure space of the incompressible models with motions other than x = QX
  bool comparison = false;        ///< comparison of the other models with the last model
  bool companion = false;         ///< a companion run on another discretisation, for the error of the reference
  bool quadrature_error = false;  ///< estimate of the error of Q by the quadrature of a polynomial body
  bool contact = false;           ///< contact with rigid planes and its columns
  bool surface_watch = false;     ///< check whether the surface of the finite-element model reaches Biot's limit
  bool graphics = false;          ///< files for ParaView
  bool report = false;            ///< report.html, and shapes of the models with motions other than x = QX
  Quantities quantities;          ///< the observables to evaluate
  Sector sector;                  ///< sector of the models with motions other than x = QX
  std::vector<std::string> needed, skipped;  ///< lines for the user
  std::vector<std::string> expected;         ///< lines about errors that are known before the run
  std::vector<std::string> warnings;         ///< sentences about valid input that is seldom intended
};

/// The needs of a scene that scene::validate has returned.
Needs needs(const Scene& scene);

/// One line of text: the analysis, the body or system, and the end time of a motion or section.
std::string summary(const Scene& scene, const Needs& needs);

/// The text that `pseudorigid check` prints, and that a run writes to the log. It lists the needed parts, and the
/// skipped parts with the reasons.
std::string describe(const Scene& scene, const Needs& needs);

}  // namespace pseudorigid::scene
