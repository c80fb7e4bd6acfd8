#pragma once
/// Every entry of a parameter file: name, member of Scene, kind with range, unit and documentation. The default is the
/// initial value of the member in scene/scene.h. The entries of a load are in its header in src/loads/. The reader, the
/// checks of ranges, used.prm, the suggestions for misspelt names and all formats of `pseudorigid parameters` use the
/// functions of this file. A new entry needs a member of Scene and a call of `visit` below, or in
/// scene/analysis_entries.h for an analysis. If the entry has an effect only for the ball, scene/owners.h must list the
/// entry or its section.

#include "scene/analysis_entries.h"
#include "scene/catalogue.h"
#include "scene/choices.h"
#include "scene/discretization.h"
#include "scene/scene.h"

namespace pseudorigid::scene {

/// The catalogue of the scene, or the empty catalogue if the scene has none.
inline const Catalogue& catalogue_of(const Scene& scene) {
  return scene.catalogue ? *scene.catalogue : empty_catalogue;
}

/// A scene with the default values and the given catalogue, which must outlive the scene.
inline Scene default_scene(const Catalogue& catalogue) {
  Scene scene;
  scene.catalogue = &catalogue;
  for (const ModelDescription& model : catalogue.models)
    if (model.by_default) scene.models.emplace_back(model.name);
  return scene;
}

template <SceneOrConst S, class Visit>
void visit_problem(S& scene, Visit& visit) {
  visit(scene.title, Text{}, About{"Title", "", "A title for the reader; it has no effect on the run."});
  visit(scene.models, models_kind(catalogue_of(scene)),
        About{"Models", "", "Models of the ball to run, see Models below. Several are compared automatically."});
  visit(scene.system, system_kind(catalogue_of(scene)),
        About{"System", "",
              "The system that moves: the elastic ball, or one of the finite-dimensional systems of mechanics, each of "
              "which has a subsection and a CSV file of its own."});
  visit(
      scene.analysis, analysis_kind,
      About{
          "Analysis", "",
          "The kind of computation. With motion, it is the motion that follows from the initial state. With modes, "
          "it is the lowest frequencies of small motions about rest, of the continuum or of a polynomial body "
          "(modes.csv); see Modes/Number. With love numbers, it is the static response of the ball with "
          "self-gravity to tides and to masses on its surface; see Love numbers/Degrees. Each model writes a file, for "
          "example love-reduced.csv. With equilibrium, it is for the ball a family of "
          "relative equilibria "
          "with their stability, or its equilibria at rest; see Equilibrium/Family. The reduced model writes "
          "equilibria.csv. Polynomial bodies write equilibria-polynomial.csv, if the family turns as a whole or is "
          "static. For "
          "another system (equilibria.csv): the critical "
          "points of the potential with their Morse indices, the rates of small motions, and the dimensions of "
          "the stable and unstable manifolds. They are those under the system's own dissipation or, where it "
          "has none, under a unit friction. With manifolds, it is for these systems the motions on the unstable "
          "and stable manifolds of the critical points, and their ends (manifolds.csv, connections.csv); see "
          "Manifolds/Starts. With section, it is the crossings of the motion with a surface of section "
          "(section.csv); see Section/Column."});
}

template <SceneOrConst S, class Visit>
void visit_body(S& scene, Visit& visit) {
  auto& [radius, density, incompressible, semi_axes, inertia] = scene.body;
  visit(radius, positive, About{"Body/Radius", "length", "Radius r of the undeformed ball."});
  visit(density, positive, About{"Body/Density", "mass/length^3", "Density of the undeformed ball."});
  visit(incompressible, Boolean{},
        About{"Body/Incompressible", "",
              "true: volume is preserved, det F = 1, by a pressure. false: the body is compressible."});
  visit(semi_axes, Numbers{3, positive},
        About{"Body/Semi-axes", "radius",
              "Semi-axes of the undeformed body along x, y, z, in radii: 1, 1, 1 is the ball. Other values are for the "
              "reduced model and polynomial bodies, and for the reduced body of a scene with a mesh from a file."});
  visit(inertia, AutoOrMatrix{},
        About{"Body/Inertia", "mass*length^2",
              "E0, the integral of density X X^T over the undeformed body: symmetric, positive definite. auto: that "
              "of the ellipsoid with these semi-axes. A matrix describes a body of another shape with the volume of "
              "that ellipsoid; self-gravity is then not offered."});
}

template <SceneOrConst S, class Visit>
void visit_material(S& scene, Visit& visit) {
  visit(scene.material.law, law_kind(), About{"Material/Law", "", documentation_of_laws()});
  for (const materials::LawEntry& entry : materials::law_entries)
    visit(scene.material.*entry.member, Number{entry.low, entry.high, entry.low_excluded},
          About{entry.path, entry.is_modulus ? Unit("pressure") : Unit(), entry.documentation});
  visit(
      scene.material.bulk, bulk_kind,
      About{"Material/Bulk", "",
            "How motions of compressible polynomial bodies and finite elements have the bulk term B of the law. "
            "pointwise: at each point, explicit in time. Pressure waves limit the step. Elements and bodies of low "
            "degree lock. projected: at the projection of ln det F on the functions of the pressure, implicit in time. "
            "Shear waves limit the step. It needs the method rattle or symmetric-4 and a Lame lambda of at least 100 "
            "shear moduli. "
            "Pressure waves are not resolved, so contact is refused. The pseudo-rigid model has one value of det F, "
            "explicit in time."});
}

template <SceneOrConst S, class Visit>
void visit_loads(S& scene, Visit& visit) {
  scene.loads.for_each([&]<class L>(L& load) {
    std::remove_const_t<L>::visit_entries(load, visit);
    if constexpr (std::is_same_v<std::remove_const_t<L>, loads::SelfGravity>)
      visit(scene.gamma, Number{0, largest_condition},
            About{"Gravity/Gamma", "",
                  "Self-gravity in proportion to elasticity, gamma = rho g r/mu with g = (4/3) pi G rho r, the "
                  "density rho, the radius r and the shear modulus mu. It takes the place of Constant, which follows "
                  "from it. 0: Constant counts."});
  });
}

template <SceneOrConst S, class Visit>
void visit_initial_state(S& scene, Visit& visit) {
  auto& [deformation, velocity, equilibrium, parameter, figure, mode, amplitude, center, center_velocity, origin] =
      scene.initial_state;
  visit(deformation, Matrix{},
        About{"Initial state/Deformation", "",
              "Q0: the ball starts as x = Q0 X; det Q0 > 0, and det Q0 = 1 within 1e-8 for an incompressible body "
              "(it is then projected exactly)."});
  visit(velocity, Matrix{},
        About{"Initial state/Velocity", "1/time",
              "Qdot0: the ball starts with the velocity Qdot0 X; for an incompressible body "
              "|tr(Q0^-1 Qdot0)| r/c <= 1e-8 (it is then projected exactly)."});
  visit(equilibrium, initial_family_kind,
        About{"Initial state/Equilibrium", "",
              "A relative equilibrium to start from, of a family as in Equilibrium/Family. With its A, omega and "
              "Lambda the motion starts from Q0 = Deformation A and Qdot0 = Deformation (omega^ A - A Lambda^) + "
              "Velocity."});
  visit(parameter, Number{},
        About{"Initial state/Equilibrium parameter", "",
              "Which member of the family: its parameter, as in Equilibrium/First. Ignored without Equilibrium."});
  visit(figure, starting_figure_kind,
        About{"Initial state/Figure", "",
              "With affine, every model starts from the ellipsoid of Equilibrium, the figure of the pseudo-rigid body. "
              "With own, every model starts from its own figure phi(X) of the same family and parameter. The positions "
              "are then Deformation phi, and the velocities Deformation (omega x phi) + Velocity X. The families are "
              "those of Equilibrium/Family that the model offers, without static."});
  visit(
      mode, AutoOrInteger{{0, 10}},
      About{"Initial state/Mode", "",
            "Number k of the small motion about the figure that is added to the start, 0 for none. Its rate is rate_k "
            "in the table of equilibria of the model (Analysis = equilibrium). Models number their motions "
            "differently, so a scene with a number has one model and one degree. auto: every model starts with the "
            "motion that grows fastest."});
  visit(amplitude, Number{0, 1},
        About{"Initial state/Mode amplitude", "",
              "Root mean square over the mass of the complex displacement of that motion, in radii."});
  visit(center, Numbers{3}, About{"Initial state/Center", "length", "Initial position of the centre of mass."});
  visit(center_velocity, Numbers{3},
        About{"Initial state/Center velocity", "length/time", "Initial velocity of the centre of mass."});
}

template <SceneOrConst S, class Visit>
void visit_time(S& scene, Visit& visit) {
  auto& [end, step, method, tolerance, constraint_tolerance] = scene.time;
  visit(end, Number{},
        About{"Time/End", "time",
              "The motion is computed from time 0 to this time. Less than 0: backwards, of systems whose motions "
              "exist for all time, in the form of a field on coordinates: the torus, and the double pendulum with "
              "Form = lagrange."});
  visit(step, AutoOrNumber{positive},
        About{"Time/Step", "time",
              "Upper bound of the time step (for rattle-4, -6, -8 of the whole composed step); each interval "
              "between samples holds a whole number of steps. auto: found from Tolerance."});
  visit(
      method, method_kind(catalogue_of(scene)),
      About{"Time/Method", "",
            "Integrator, as listed under Methods. auto: the cheapest that meets Tolerance over this length of time."});
  visit(
      tolerance, Number{1e-13, 1e-1},
      About{"Time/Tolerance", "",
            "Bound of the time error of Q over the run (largest entry, over all samples). For other systems it is the "
            "error of their configuration, in the system's own unit of length. It also bounds the relative change of "
            "energy of a ball by symmetric-4 in a run of 40 r/c or more, extrapolated from the first eighth."});
  visit(
      constraint_tolerance, AutoOrNumber{1e-13, 1e-3},
      About{
          "Time/Constraint tolerance", "",
          "Largest mean of |ln J| that a step of an incompressible body may leave: over a cell of the continuum, over "
          "a polynomial body. The next step starts from it, so it does not accumulate. At samples it also bounds "
          "the rate of this mean. With auto it is 1e-13 if Step is given. Otherwise it is 1e-4 of Tolerance, or 1e-8 "
          "of it (at least 1e-13) if the body dissipates energy. The reduced body keeps its volume to round-off."});
}

template <SceneOrConst S, class Visit>
void visit_polynomial(S& scene, Visit& visit) {
  auto& [degrees, tolerance, gravity_points, quadrature_points, contact_points] = scene.polynomial;
  visit(degrees, AutoOrIntegers{{1, largest_polynomial_degree}},
        About{"Polynomial/Degree", "",
              "Degree N of the polynomials in which the positions are written; degree 1 is the pseudo-rigid body. "
              "Several degrees, for example 1, 3, 5, are run one after another; each run is compared with that of the "
              "most accurate model. auto: 1, 3, 5, ... until the estimated error meets Tolerance."});
  visit(tolerance, Number{1e-10, 1e-1},
        About{"Polynomial/Tolerance", "",
              "If Degree is auto: largest error of Q that the choice of the degree may cause (largest entry over "
              "all samples). The time error is then kept below a twentieth of it."});
  visit(gravity_points, AutoOrInteger{{2, 24}},
        About{"Polynomial/Gravity points", "",
              "Points per direction on an octant of the surface for self-gravity, which sums over their pairs. auto: "
              "four more than Degree. The cost of gravity grows as the fourth power of this number."});
  visit(
      quadrature_points, AutoOrInteger{{2, 24}},
      About{
          "Polynomial/Quadrature points", "",
          "Points per direction on an octant of the body for all its integrals but self-gravity. There are never fewer "
          "than (Degree + 3)/2, rounded up, which integrate the forces of small motions exactly. With auto, these are "
          "taken, or as many as a Time/Tolerance below 1e-6 asks for if the step is found from it. The log has their "
          "estimated "
          "error of Q. The cost grows as the third power."});
  visit(contact_points, AutoOrInteger{{2, 128}},
        About{"Polynomial/Contact points", "",
              "Points per direction on an octant of the surface, at which contact with rigid planes is found. With "
              "auto, there are 24. Degree 1 does not use them: its contact is known in closed form."});
}

template <SceneOrConst S, class Visit>
void visit_continuum(S& scene, Visit& visit) {
  auto& [degree, refinements, tolerance, error_estimate, gravity_points, stiffness, mesh, symmetry, contact_points,
         grading] = scene.continuum;
  visit(degree, AutoOrInteger{{1, largest_degree}},
        About{"Continuum/Degree", "",
              "Polynomial degree of the positions; the pressure has one degree less. Degree 1 is for compressible "
              "bodies. auto: the cheapest that meets Tolerance, found by runs on coarser discretisations."});
  visit(refinements, AutoOrInteger{{0, 4}},
        About{"Continuum/Refinements", "",
              "How many times each cell of the mesh is divided into eight. auto: as Tolerance needs, up to 2."});
  visit(tolerance, Number{1e-10, 1e-1},
        About{"Continuum/Tolerance", "",
              "If Degree or Refinements is auto: largest error of Q that the discretisation in space may cause "
              "(largest entry over all samples). The time error is then kept below a twentieth of it."});
  visit(
      error_estimate, error_estimate_kind,
      About{"Continuum/Error estimate", "",
            "With auto, a comparison also runs the continuum on a coarser discretisation, for about a third of the "
            "cost, and reports the discretisation error. Equilibria then also have columns with their errors, from "
            "figures on a coarser mesh. In a violent motion, a run with twice the steps estimates the time error. With "
            "none, these runs and columns are left out."});
  visit(gravity_points, AutoOrInteger{{2, 16}},
        About{"Continuum/Gravity points", "",
              "Gauss points per direction on each face of the surface; self-gravity sums over their pairs. With auto, "
              "there are two more than Degree, or one more if an elastic body is refined, so that their error is below "
              "that of the mesh. Modes and Love numbers do not use them: their gravity is exact. The cost of gravity "
              "grows as the fourth power of this number."});
  visit(stiffness, AutoOrNumber{not_negative},
        About{"Continuum/Volumetric stiffness", "pressure",
              "kappa of the volumetric stabilisation of an incompressible body: the elements store the additional "
              "energy (kappa/8) (J - 1/J)^2, J = det F. An exact motion has J = 1 and is not affected; in the "
              "elements it resists the changes of volume that the pressure space does not control. 0: off. "
              "auto: the pressure at the centre that self-gravity and a confining tidal matrix cause. Finite elements "
              "whose motion starts violently have three times the shear modulus in addition. The command check prints "
              "the value."});
  visit(mesh, BuiltinOrMeshFile{},
        About{"Continuum/Mesh", "",
              "The mesh to start from: the builtin mesh of the ball, or a Gmsh file (format 2.2, ASCII, hexahedra "
              "of 8 nodes), searched in the folder of the parameter file. "
              "A mesh of which all cells are left-handed is turned. The file holds the whole body, with coordinates "
              "in the unit of Body/Radius; the body is moved so that its centre of mass is the origin. Semi-axes and "
              "Inertia are then those of the reduced body that is compared with it."});
  visit(symmetry, symmetry_kind,
        About{"Continuum/Symmetry", "",
              "Coordinate planes, named by their normals, that are taken as symmetry planes, so that only a sector of "
              "the ball is computed (octant: all three; none: the full ball). With auto, they are every plane that the "
              "initial state and the loads admit, and none if the mesh is from a file. Motions that would "
              "break the symmetry are then excluded."});
  visit(contact_points, AutoOrInteger{{2, 64}},
        About{"Continuum/Contact points", "",
              "Gauss points per direction on each face of the surface, at which contact with rigid planes is found. "
              "With auto, there are 2 (Degree + 1)."});
  visit(grading, Number{.low = 0.05, .high = 1},
        About{"Continuum/Grading", "",
              "Size of the cells of the builtin mesh at two opposite poles of the ball, over their size without "
              "grading, along the surface and inwards. The cells elsewhere are larger. The poles are on the "
              "coordinate axis that is nearest to the normal of the first plane, and on the z axis without planes. The "
              "stable step falls in proportion."});
}

template <SceneOrConst S, class Visit>
void visit_output(S& scene, Visit& visit) {
  auto& [directory, samples, quantities, graphics, frames, fields, cells, report] = scene.output;
  visit(directory, Directory{},
        About{"Output/Directory", "",
              "The directory in which the results get a folder with the name of the scene. It is taken as it is: ~ and "
              "$NAME are "
              "not replaced."});
  visit(samples, Integer{1, largest_number_of_samples},
        About{"Output/Samples", "",
              "Number of equal intervals of time. The quantities are written at time 0 and at the end of each "
              "interval."});
  visit(quantities, quantities_kind, About{"Output/Quantities", "", documentation_of_quantities()});
  visit(graphics, graphics_kind,
        About{"Output/Graphics", "", "Pictures of the motion: none, or vtu files for ParaView."});
  visit(frames, Integer{1},
        About{"Output/Frames", "", "Number of pictures of the motion, at most Samples. Ignored without Graphics."});
  visit(
      fields, fields_kind,
      About{"Output/Fields", "",
            "Groups of fields that a picture holds. displacement: with and without the rigid motion, and the reference "
            "coordinates; velocity; stress: Cauchy stress, pressure, von Mises stress; deformation: deformation "
            "gradient, its determinant, principal stretches; energy: energy density, potential of self-gravity; all: "
            "these five. A scene with planes adds the contact pressure. Fewer fields make smaller files. Ignored "
            "without Graphics."});
  visit(cells, cells_kind,
        About{"Output/Cells", "",
              "Cells of a picture. With linear, an element of degree k is cut into k^3 hexahedra with straight edges, "
              "which every program shows. With lagrange, it is one curved hexahedron of degree k, for programs that "
              "read VTK's Lagrange cells, such as ParaView (Nonlinear Subdivision Level). Ignored without Graphics."});
  visit(report, Boolean{},
        About{"Output/Report", "",
              "Whether to write report.html at the end: one page for a browser, without links to anything outside, "
              "that shows the run and holds its files. The continuum also writes shapes.csv for it, and a polynomial "
              "body shapes-polynomial.csv."});
}

template <SceneOrConst S, class Visit>
void visit_sweep(S& scene, Visit& visit) {
  visit(
      scene.sweep, SweepParameters{},
      About{
          "Sweep/Parameters", "",
          "Runs the scene for every combination of these values, without files for the single runs, and writes "
          "sweep.csv with one row per run. Example: \"l: 1.1 .. 2 in 100; w: 0, 1\". A range \"in 5 logarithmic\" "
          "has equal ratios. Ranges \"in 200 latin 7\" make one Latin hypercube of 200 runs, from the seed 7. Each row "
          "of a sweep of several models compares each with the last of them. Other entries use the "
          "parameters as $(expression), for instance $(1/sqrt(l)). Every parameter is used by some entry, and none has "
          "the "
          "name of a function or a constant of expressions or of another column of sweep.csv. It is for motions of "
          "every model and of the other systems, and for modes, Love numbers and equilibria (one figure in each "
          "run)."});
  visit(scene.sweep_part, SweepPartKind{},
        About{"Sweep/Part", "",
              "The part of the runs to make, such as 2 of 8: the runs are divided into 8 parts in their order. Parts "
              "can run at the same time, on several machines, with directories of their own. python3 -m pseudorigid "
              "merge joins their tables."});
  visit(scene.sweep_threads, AutoOrInteger{{1, 1024}},
        About{"Sweep/Threads", "", "Number of runs at the same time. auto: one per core."});
  visit(scene.sweep_trajectories, Boolean{},
        About{"Sweep/Trajectories", "",
              "Whether trajectories.csv keeps all samples of all runs, a row each: the number of the run, then the "
              "columns of the file that a single run writes. A table that the disk has no room for is refused."});
  visit(scene.sweep_lanes, Boolean{},
        About{"Sweep/Lanes", "",
              "Whether eight successive runs move together in the lanes of a SIMD vector. It takes incompressible "
              "bodies without gravity, loads and dissipation, and the same law, Time and Output/Samples in all eight. "
              "The method is symmetric-8 (symmetric, not symplectic), or another symmetric one that Time/Method names; "
              "the step is the one that the worst of the eight needs. Rows differ from those of single runs by at most "
              "the errors that Time/Tolerance allows, and with a given method and step by round-off. With false, each "
              "row is that of a single run, bit by bit."});
}

/// Visits the entries of all systems of the catalogue. Their values are texts. In a scene that is not const, missing
/// values are first set to their defaults. In a const scene, a missing value is visited as its default.
template <SceneOrConst S, class Visit>
void visit_systems(S& scene, Visit& visit) {
  for (const SystemDescription& system : catalogue_of(scene).systems)
    for (const SystemEntry& entry : system.entries) {
      if constexpr (std::is_const_v<S>) {
        const auto found = scene.system_values.find(entry.about.path);
        visit(found != scene.system_values.end() ? found->second : entry.default_text, entry.kind, entry.about);
      } else {
        visit(scene.system_values.try_emplace(std::string(entry.about.path), entry.default_text).first->second,
              entry.kind, entry.about);
      }
    }
}

/// Calls visit(member, kind, About) for every entry, in the order in which used.prm lists the entries.
template <SceneOrConst S, class Visit>
void visit_entries(S& scene, Visit&& visit) {
  visit_problem(scene, visit);
  visit_body(scene, visit);
  visit_material(scene, visit);
  visit_loads(scene, visit);
  visit_initial_state(scene, visit);
  visit_equilibria(scene, visit);
  visit_modes(scene, visit);
  visit_love_numbers(scene, visit);
  visit_manifolds(scene, visit);
  visit_section(scene, visit);
  visit_systems(scene, visit);
  visit_time(scene, visit);
  visit_polynomial(scene, visit);
  visit_continuum(scene, visit);
  visit_output(scene, visit);
  visit_sweep(scene, visit);
}

}  // namespace pseudorigid::scene
