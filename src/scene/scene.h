#pragma once
/// The content of a parameter file: a member with its default for each entry. Names, ranges, units and documentation of
/// the entries are defined in scene/entries.h.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "entries/entry_kinds.h"
#include "loads/list.h"
#include "materials/law_table.h"
#include "observables/quantities.h"
#include "scene/sweep.h"

namespace pseudorigid::scene {

enum class Analysis { motion, modes, love_numbers, equilibrium, manifolds, section };
/// The crossings of the value Section/Value that Analysis = section records. The column that Section/Column names
/// increases at a crossing `up` and decreases at a crossing `down`. With `both`, all crossings are recorded.
enum class Crossings { up, down, both };
/// Families of relative equilibria (reduced/equilibrium_families.h). The value `at_rest` selects the equilibria at
/// rest, which do not form a family. With `none`, an initial state does not use an equilibrium.
enum class Family {
  none,
  maclaurin,
  spheroids,
  spinning,
  jacobi,
  dedekind,
  riemann_s,
  riemann_s_dual,
  riemann_planar,
  riemann_planar_dual,
  at_rest
};
/// The figure from which a model starts if the scene gives a relative equilibrium. The value `affine` selects the
/// ellipsoid of the pseudo-rigid body, and `own` the model's own figure of the same family and parameter.
enum class StartingFigure { affine, own };
enum class Graphics { none, vtu };
/// The cells of a picture. With `linear`, an element of degree k is divided into k³ hexahedra; with `lagrange`, it is
/// one cell (io/block_cells.h).
enum class Cells { linear, lagrange };
/// The estimate of the discretisation error of the finite-element model in a comparison. With `automatic`, a companion
/// run on another discretisation estimates the error. With `none`, there is no companion run.
enum class ErrorEstimate { none, automatic };
/// The form of the bulk term of a compressible body (scene/bulk.h).
enum class Bulk { pointwise, projected };

/// The symmetry planes that bound the computed sector. With `automatic`, the program derives them from the scene. The
/// letters x, y, z are the normals of the planes. The sector `octant` has all three planes, and `none` is the full
/// ball.
enum class Symmetry { automatic, none, x, y, z, xy, xz, yz, octant };

/// Selected groups of columns of the CSV files of a motion. The column `time` does not belong to a group.
using mechanics::Quantities;

/// Selected groups of fields of a picture. io/body_picture.h defines the fields.
struct Fields {
  bool displacement = true;  ///< displacement with and without the rotation, and reference coordinates
  bool velocity = true;
  bool stress = true;       ///< Cauchy stress, pressure, von Mises stress, and contact pressure if there are planes
  bool deformation = true;  ///< deformation gradient, its determinant, principal stretches
  bool energy = true;       ///< energy density, potential of self-gravity
};

struct Catalogue;

inline constexpr int largest_number_of_samples = 10'000'000;

/// Values of the entries System and Time/Method that are not names in the catalogue.
inline constexpr std::string_view ball = "ball", automatic = "auto";

struct Scene {
  const Catalogue* catalogue = nullptr;  ///< null until default_scene sets it
  std::string title;
  std::vector<std::string> models;  ///< names of models, in the order of the catalogue
  std::string system{ball};         ///< "ball" or the name of a system of the catalogue
  Analysis analysis = Analysis::motion;

  struct Body {
    double radius = 1, density = 1;
    bool incompressible = true;
    std::vector<double> semi_axes{1, 1, 1};  ///< semi-axes of the reference body, in radii
    std::optional<Matrix3> inertia;  ///< second moment E₀ = ∫ρXXᵀ dV; empty: that of the ellipsoid with `semi_axes`
  } body;
  struct Material : materials::LawParameters {
    std::string law{materials::law_table[0].name};
    Bulk bulk = Bulk::pointwise;
  } material;
  loads::Loads loads;  ///< the headers in src/loads/ define the entries of the loads
  /// Ratio γ of self-gravity to elasticity (scene/scale_numbers.h) of the entry Gravity/Gamma; 0: not given. From γ,
  /// validate() sets the constant of gravity.
  double gamma = 0;
  struct InitialState {
    /// An affine body starts at x = x_c + Q₀X with the velocity ẋ_c + Q̇₀X. Here X is the reference position, and x_c
    /// is the centre of mass of the body. Let D be `deformation` and V be `velocity`. If `equilibrium` is none, Q₀ = D
    /// and Q̇₀ = V. Otherwise, the equilibrium has the shape A, the spin ω and the circulation Λ. Then Q₀ = DA and Q̇₀
    /// = D(ω̂A − AΛ̂) + V. Here ω̂ is the matrix of the cross product, ω̂x = ω × x, and Λ̂ is that of Λ. If `figure` is
    /// own, a model with non-affine motions uses its own figure instead of the ellipsoid x = AX.
    Matrix3 deformation = identity3;
    Matrix3 velocity{};
    Family equilibrium = Family::none;
    double equilibrium_parameter = 0.5;
    StartingFigure figure = StartingFigure::affine;
    std::optional<int> mode = 0;   ///< number of the added small motion, or 0 for none; empty: the fastest growing one
    double mode_amplitude = 1e-3;  ///< rms displacement of the small motion, weighted with the mass, in radii
    /// Centre of mass of the body and its companions, and the velocity of this centre.
    std::vector<double> center{0, 0, 0}, center_velocity{0, 0, 0};
    /// The original `equilibrium`, `equilibrium_parameter`, D and V, if with_equilibrium
    /// (app/reduced/ball_equilibria.h) has replaced them by explicit values of Q₀ and Q̇₀. The member `origin` is empty
    /// if the scene did not give an equilibrium. No entry sets `origin`.
    struct Origin {
      Family family;
      double parameter;
      Matrix3 deformation, velocity;
    };
    std::optional<Origin> origin{};
  } initial_state;
  struct Equilibria {
    Family family = Family::maclaurin;
    double first = 0.1, last = 0.99;
    int number = 90;
    double ratio = 0.5;         ///< ratio a₃/a₁ of the semi-axes in Riemann's families
    bool small_motions = true;  ///< true if models with non-affine motions compute the small motions about figures
  } equilibria;
  struct Modes {
    int number = 8;
  } modes;
  struct Love {
    std::vector<int> degrees;  ///< increasing degrees of tides; empty: those of love_degrees (scene/models.h)
  } love;
  struct Manifolds {
    int starts = 24;
  } manifolds;
  struct Section {
    std::string column;
    double value = 0;
    double period = 0;  ///< the values `value` + k `period` with an integer k count as well; 0: only `value`
    Crossings crossings = Crossings::up;
  } section;
  struct Time {
    double end = 10;                ///< the end time; negative for a run backwards in time
    std::optional<double> step;     ///< upper bound of the step; empty: a step found from `tolerance`
    std::string method{automatic};  ///< "auto" or the name of a method of the catalogue
    double tolerance = 1e-6;
    std::optional<double> constraint_tolerance{};  ///< empty: the automatic value of app/run/model_stepping.h
  } time;
  struct Polynomial {
    std::vector<int> degrees{5};  ///< increasing degrees of the polynomials; empty: degrees found from `tolerance`
    double tolerance = 1e-3;
    std::optional<int> gravity_points;     ///< empty: the automatic value of polynomial/body_gravity.h
    std::optional<int> quadrature_points;  ///< empty: the automatic value of app/polynomial/run_quadrature.h
    std::optional<int> contact_points;     ///< empty: the automatic value of polynomial/body_contact.h
  } polynomial;
  struct Continuum {
    std::optional<int> degree = 4, refinements = 0;  ///< empty: a number found from `tolerance`
    double tolerance = 1e-3;
    ErrorEstimate error_estimate = ErrorEstimate::automatic;
    /// Empty: the automatic value of continuum/body/surface_gravity_forces.h.
    std::optional<int> gravity_points;
    std::optional<double> volumetric_stiffness;  ///< empty: the automatic value of scene/stabilization.h
    std::string mesh{builtin_mesh};              ///< "builtin" or the absolute path of a mesh file
    Symmetry symmetry = Symmetry::automatic;
    std::optional<int> contact_points;  ///< empty: the automatic value of continuum/body/contact_forces.h
    /// Size of the cells at two poles, divided by the size in an ungraded mesh (continuum/mesh/ball_mesh.h).
    double grading = 1;
  } continuum;
  struct Output {
    std::string directory = "output";
    int samples = 200;
    Quantities quantities;
    Graphics graphics = Graphics::none;
    int frames = 20;
    Fields fields;
    Cells cells = Cells::linear;
    bool report = false;
  } output;
  Sweep sweep;                       ///< parameters of the sweep; empty: one run
  SweepPart sweep_part;              ///< the part of the runs to make
  std::optional<int> sweep_threads;  ///< number of runs at the same time; empty: number of cores
  bool sweep_lanes = true;           ///< true if similar runs are integrated together in SIMD lanes
  bool sweep_trajectories = false;   ///< true if trajectories.csv is written, with the samples of all runs
  /// Values that contain expressions, path → text. The members of these entries have the values for the first run,
  /// until with_parameters (scene/read_scene.h) sets them for another run.
  std::map<std::string, std::string, std::less<>> expressions;
  /// Values of the entries of systems, path → canonical text. An entry without a value here has its default.
  std::map<std::string, std::string, std::less<>> system_values;
};

/// Returns true if the scene computes the equilibria at rest instead of a family of relative equilibria.
inline bool finds_static_equilibria(const Scene& scene) {
  return scene.analysis == Analysis::equilibrium && scene.equilibria.family == Family::at_rest;
}

/// True if each model of a motion starts from its own figure of a family.
inline bool starts_from_own_figure(const Scene& scene) {
  const Scene::InitialState& start = scene.initial_state;
  return scene.analysis == Analysis::motion && start.figure == StartingFigure::own &&
         (start.origin || start.equilibrium != Family::none);
}

/// The largest degree of a tide that Love numbers/Degrees accepts.
inline constexpr int largest_love_degree = 24;

/// Returns true if the analysis computes small displacements about rest: modes and Love numbers.
inline bool is_linear(Analysis analysis) { return analysis == Analysis::modes || analysis == Analysis::love_numbers; }

inline bool has_mesh_file(const Scene& scene) { return scene.continuum.mesh != builtin_mesh; }

}  // namespace pseudorigid::scene
