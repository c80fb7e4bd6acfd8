#include "scene/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "entries/entry_kinds.h"
#include "entries/matrix3.h"
#include "entries/units.h"
#include "scene/discretization.h"
#include "scene/entries.h"
#include "scene/models.h"
#include "scene/scales.h"
#include "scene/user_error.h"

namespace pseudorigid::scene {
namespace {

constexpr double isochoric_tolerance = 1e-8;
/// Beyond these sizes and condition numbers round-off leaves nothing of the problem that the user meant.
constexpr double largest_condition = 1e12, largest_stretch = 1e12;
/// E₀ goes with the squares of the semi-axes.
constexpr double largest_axis = 1e6;
constexpr double round_off = 8 * std::numeric_limits<double>::epsilon();

/// The fastest systems take a tenth of a microsecond a step, so that this is a day. Times are told apart up to 2⁵²
/// steps.
constexpr double most_steps = 1e12;

constexpr const char* deformation_path = "Initial state/Deformation";
constexpr const char* mesh_path = "Continuum/Mesh";
constexpr const char* velocity_path = "Initial state/Velocity";

/// Q^-1 : Qdot^T = tr(Q^-1 Qdot), and how large it is by round-off alone.
struct Divergence {
  double value, round_off_bound;
};

Divergence divergence(const Matrix3& q, const Matrix3& qdot) {
  const Matrix3 inverse_transposed = scaled(1 / det(q), cofactor(q));
  return {inner(inverse_transposed, qdot), round_off * inner(absolute(inverse_transposed), absolute(qdot))};
}

class Validator {
 public:
  Validator(Scene& scene, const Origins& origins) : scene_(scene), origins_(origins) {}

  void run() {
    check_ownership();
    check_time();
    check_sweep();
    if (const SystemDescription* system = catalogue_of(scene_).system(scene_.system))
      check_system(*system);
    else
      check_ball();
  }

 private:
  void check_ball() {
    if (scene_.analysis == Analysis::manifolds || scene_.analysis == Analysis::section)
      refuse("Analysis", fmt::format("{} is offered for the systems beside the ball; set System",
                                     analysis_kind.print(scene_.analysis)));
    if (scene_.time.end < 0) refuse("Time/End", needs_complete_system());
    check_problem();
    if (scene_.analysis == Analysis::motion)
      if (const auto refusal = refuses_duration(scene_.time.end, time_unit())) refuse(refusal->path, refusal->sentence);
    check_reference_body();
    check_loads();
    check_output();
    check_deformation();
    check_velocity();
    if (scene_.body.incompressible) {
      scene_.initial_state.deformation = isochoric_deformation();
      scene_.initial_state.velocity = isochoric_velocity();
    }
    check_models();
  }

  [[noreturn]] void refuse(const std::string& path, const std::string& sentence) const {
    throw UserError(fmt::format("{}: {}: {}", origins_.of(path), path, sentence));
  }

  /// An entry of another system would be without effect; its author has something else in mind.
  void check_ownership() const {
    for (const auto& [path, where] : origins_.all())
      if (!concerns(scene_, path))
        refuse(path, fmt::format("it belongs to System = {}, and the System of this scene is {}",
                                 owner_of(catalogue_of(scene_), path), scene_.system));
  }

  void check_sweep() const {
    if (scene_.sweep.empty()) return;
    const bool is_ball = scene_.system == ball;
    if (is_ball && is_discretized(scene_)) refuse("Models", offered_for("a sweep is", &without_elements));
    if (is_ball && scene_.models.size() > 1) refuse("Models", "a sweep runs one model; name one");
    if (scene_.analysis != Analysis::motion) refuse("Analysis", "a sweep is offered for motions");
    if (is_ball && scene_.output.graphics != Graphics::none)
      refuse("Output/Graphics", "a sweep writes no pictures; set Graphics = none");
  }

  void check_system(const SystemDescription& system) {
    scene_.models.clear();
    if (scene_.analysis == Analysis::modes)
      refuse("Analysis", fmt::format("modes are offered for the ball, not for System = {}", system.name));
    const bool wants_critical_points =
        scene_.analysis == Analysis::equilibrium || scene_.analysis == Analysis::manifolds;
    if (wants_critical_points && !system.has_equilibria)
      refuse("Analysis", fmt::format("{} is not offered for System = {}, which has no critical points to find",
                                     analysis_kind.print(scene_.analysis), system.name));
    if (scene_.time.end < 0 && !system.complete) refuse("Time/End", needs_complete_system());
    if (const auto refusal = system.refuses(scene_)) refuse(refusal->path, refusal->sentence);
    if (scene_.analysis == Analysis::section) check_section(system);
  }

  void check_section(const SystemDescription& system) const {
    std::vector<std::string_view> names;
    const auto columns = system.columns_of(scene_);
    for (const Column& column : columns) names.push_back(column.name);
    if (std::ranges::find(names, scene_.section.column) == names.end())
      refuse("Section/Column", fmt::format("expected a column of {}.csv, one of {}; got \"{}\"", system.file,
                                           joined(names), scene_.section.column));
  }

  /// Of an end before the start.
  std::string needs_complete_system() const {
    std::vector<std::string_view> names;
    for (const SystemDescription& system : catalogue_of(scene_).systems)
      if (system.complete) names.push_back(system.name);
    return fmt::format(
        "expected a number > 0, got {}; backwards in time go the systems whose motions exist for all time: {}",
        print_number(scene_.time.end), joined(names));
  }

  double time_unit() const { return time_scale(scene_); }

  void check_problem() const {
    const double radius = scene_.body.radius, density = scene_.body.density;
    const auto models = models_of(scene_);
    const auto has_equilibria = [](const ModelDescription& model) { return model.has_equilibria; };
    if (scene_.analysis == Analysis::equilibrium &&
        !std::ranges::all_of(models, [&](const auto* model) { return has_equilibria(*model); }))
      refuse("Analysis", offered_for("equilibrium is", has_equilibria));
    const bool wants_family = scene_.analysis == Analysis::equilibrium && !finds_static_equilibria(scene_);
    if (wants_family || scene_.initial_state.equilibrium != Family::none) check_relative_equilibrium();
    if (finds_static_equilibria(scene_)) check_static_equilibria();
    if (scene_.analysis == Analysis::modes) check_modes();
    if (models.empty())
      refuse("Models", "expected at least one of " + joined(names_where(scene_, [](const auto&) { return true; })));
    for (const NamedMethod& method : catalogue_of(scene_).methods)
      if (method.name == scene_.time.method && is_discretized(scene_) && !method.for_discretized)
        refuse("Time/Method", fmt::format("{}; the continuum takes {}",
                                          offered_for(std::string(method.name) + " is", &without_elements),
                                          joined(methods_for_discretized())));
    // Energies of the body scale with these; r^5 occurs in its moment of inertia.
    const double inertia = density * std::pow(radius, 5);
    const double stiffness = scene_.material.shear_modulus * std::pow(radius, 3);
    if (!std::isnormal(inertia) || !std::isnormal(stiffness) || !std::isnormal(time_unit()))
      refuse(
          "Body/Radius",
          fmt::format("with radius {}, density {} and shear modulus {} the body's inertia, stiffness or time scale is "
                      "not a representable number; choose units nearer to the size of the body",
                      print_number(radius), print_number(density), print_number(scene_.material.shear_modulus)));
  }

  /// What the models themselves have to say of a scene that is sound.
  void check_models() const {
    for (const ModelDescription* model : models_of(scene_))
      if (const auto refusal = model->refuses ? model->refuses(scene_) : std::nullopt)
        refuse(refusal->path, refusal->sentence);
  }

  static bool without_elements(const ModelDescription& model) { return !model.discretized; }
  std::vector<std::string_view> methods_for_discretized() const {
    std::vector<std::string_view> names;
    for (const NamedMethod& method : catalogue_of(scene_).methods)
      if (method.for_discretized) names.push_back(method.name);
    return names;
  }

  /// "a sweep is offered for the reduced model and the other systems; set Models = reduced"
  template <class Predicate>
  std::string offered_for(const std::string& what, Predicate&& offers) const {
    const auto models = names_where(scene_, offers);
    return fmt::format("{} offered for {} and the other systems; set Models = {}", what, the_models(models),
                       joined(models));
  }

  /// Relative equilibria are known for the ball under potentials that depend on its shape alone.
  void check_relative_equilibrium() const {
    if (scene_.body.inertia || scene_.body.semi_axes != std::vector<double>{1, 1, 1})
      refuse("Body/Semi-axes",
             "relative equilibria are offered for a ball; set Semi-axes = 1, 1, 1 and Inertia = auto");
    scene_.loads.for_each([&]<class L>(const L& load) {
      if (!L::no_equilibria.empty() && loads::present(load)) refuse(first_entry(load), std::string(L::no_equilibria));
    });
    if (is_fluid(scene_) && !loads::present(scene_.loads.get<loads::SelfGravity>()))
      refuse("Gravity/Constant", "a fluid without gravity has no relative equilibrium; give it a constant > 0");
    if (is_fluid(scene_) && !scene_.body.incompressible)
      refuse("Material/Law", "none has no relative equilibrium where Incompressible = false: nothing resists gravity");
  }

  /// A body can be at rest under every load that has a potential; dissipation changes the rates alone.
  void check_static_equilibria() const {
    const auto finds = [](const ModelDescription& model) { return model.static_equilibria != nullptr; };
    if (!std::ranges::all_of(models_of(scene_), [&](const auto* model) { return finds(*model); }))
      refuse("Equilibrium/Family",
             fmt::format("static is offered for {}; set Models = {}", the_models(names_where(scene_, finds)),
                         joined(names_where(scene_, finds))));
    scene_.loads.for_each([&]<class L>(const L& load) {
      if (loads::DependsOnTime<L> && loads::present(load)) refuse(first_entry(load), std::string(L::no_equilibria));
    });
    const loads::Forcing forcing = loads::constant_forcing(scene_.loads);
    const bool shaped = forcing.gravity_constant != 0 || !forcing.quadratic.isZero(0) ||
                        !forcing.nominal_traction.isZero(0) || (forcing.pressure != 0 && !scene_.body.incompressible);
    if (is_fluid(scene_) && !shaped)
      refuse("Material/Law", "a fluid on which nothing acts rests in every shape; give it gravity or a load");
  }

  /// Modes are those of small motions about rest, and take the symmetry of the ball themselves.
  void check_modes() const {
    if (has_mesh_file(scene_)) refuse(mesh_path, "modes are those of the ball; set Mesh = builtin");
    const auto with_modes = names_where(scene_, [](const auto& model) { return model.has_modes; });
    if (std::ranges::none_of(models_of(scene_), &ModelDescription::has_modes))
      refuse("Analysis",
             fmt::format("modes are offered for {}; set Models = {}", the_models(with_modes), with_modes.back()));
    const auto& state = scene_.initial_state;
    if (state.deformation != identity3 || state.equilibrium != Family::none)
      refuse(deformation_path, "modes are small motions about rest, Q0 = 1; leave the entry out");
    if (largest_entry(state.velocity) != 0)
      refuse(velocity_path, "modes are small motions about rest; leave the entry out");
    if (scene_.material.law == Law::saint_venant_kirchhoff_as_printed && !scene_.body.incompressible)
      refuse("Material/Law",
             "saint-venant-kirchhoff (as printed) is stressed at rest, so a compressible ball does not stay there and "
             "has no modes about rest");
    const bool centered = state.center == std::vector<double>{0, 0, 0} && state.center_velocity == state.center;
    loads::Forcing others = loads::constant_forcing(scene_.loads);
    others.gravity_constant = 0;
    if (others.present() || loads::depend_on_time(scene_.loads) || !centered)
      refuse("Analysis",
             "modes are those of the ball alone, with self-gravity or without; leave out other loads, viscosity, drag "
             "and motions of the centre");
    if (is_fluid(scene_))
      refuse("Material/Law", "modes are those of an elastic ball: a fluid has infinitely many motions of frequency 0");
    if (is_discretized(scene_) && !fixed_discretization(scene_))
      refuse(scene_.continuum.degree ? "Continuum/Refinements" : "Continuum/Degree",
             "auto is offered for motions; for modes give a number (the column spread measures the error of the mesh)");
    if (scene_.continuum.symmetry != Symmetry::automatic && scene_.continuum.symmetry != Symmetry::octant)
      refuse("Continuum/Symmetry",
             "modes are computed on one octant, with every choice of signs at its planes; set Symmetry = auto");
  }

  void check_reference_body() const {
    for (const double a : scene_.body.semi_axes)
      if (a > largest_axis || a < 1 / largest_axis)
        refuse("Body/Semi-axes",
               fmt::format("expected semi-axes between {} and {} radii, got {}", print_number(1 / largest_axis),
                           print_number(largest_axis), print_row(scene_.body.semi_axes)));
    if (!scene_.body.inertia) return;
    const Matrix3& E0 = *scene_.body.inertia;
    require_symmetric("Body/Inertia", E0);
    const double unit = largest_entry(E0);
    const Matrix3 shape = unit > 0 ? scaled(1 / unit, E0) : E0;
    const bool definite = shape[0][0] > 1 / largest_condition && det(shape) > 1 / largest_condition &&
                          shape[0][0] * shape[1][1] - shape[0][1] * shape[1][0] > 1 / largest_condition;
    if (!definite)
      refuse("Body/Inertia",
             "expected a positive definite matrix with a condition number up to 1e12, got " + print_matrix(E0));
    if (loads::present(scene_.loads.get<loads::SelfGravity>()))
      refuse("Body/Inertia", "self-gravity is known for ellipsoids only; set Inertia = auto and give the Semi-axes");
  }

  static double largest(double value) { return std::abs(value); }
  static double largest(const std::vector<double>& v) {
    return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
  }
  static double largest(const Matrix3& A) { return largest_entry(A); }

  template <class L>
  static std::string first_entry(const L& load) {
    std::string path;
    const auto note = [&](const auto&, const auto&, const About& about) {
      if (path.empty()) path = about.path;
    };
    L::visit_entries(load, note);
    return path;
  }

  void check_loads() const {
    const io::Units units = io::ball_units(scene_.body.radius, scene_.body.density, time_unit());
    const auto require_moderate = [&](std::string_view path, double value, Unit unit) {
      if (!(units.to_internal(value, unit) <= largest_stretch))
        refuse(std::string(path),
               fmt::format("expected values up to {} in the body's own units, got {}",
                           print_number(units.to_physical(largest_stretch, unit)), print_number(value)));
    };
    scene_.loads.for_each([&]<class Load>(const Load& load) {
      const bool acts = loads::present(load);  // the default frequency of a tide that is not there may be any number
      const auto check = [&]<class Kind>(const auto& member, const Kind& kind, const About& about) {
        if constexpr (requires { kind.symmetric; })
          if (kind.symmetric) require_symmetric(std::string(about.path).c_str(), member);
        if (acts) require_moderate(about.path, largest(member), about.unit);
      };
      Load::visit_entries(load, check);
    });
    require_moderate("Initial state/Center", largest(scene_.initial_state.center), "length");
    require_moderate("Initial state/Center velocity", largest(scene_.initial_state.center_velocity), "length/time");
  }

  void require_symmetric(const char* path, const Matrix3& A) const {
    Matrix3 transposed{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) transposed[i][j] = A[j][i];
    if (largest_entry(combine(1, A, -1, transposed)) > round_off * largest_entry(A))
      refuse(path, fmt::format("expected a symmetric matrix, got {}; its symmetric part is \"{}\"", print_matrix(A),
                               print_matrix(combine(0.5, A, 0.5, transposed))));
  }

  void check_time() const {
    const auto& time = scene_.time;
    const double length = std::abs(time.end);
    if (length == 0) refuse("Time/End", "expected a number > 0, got \"0\"");
    if (scene_.analysis != Analysis::motion) return;
    if (!std::isnormal(time.end / scene_.output.samples))
      refuse("Time/End", fmt::format("expected an end that Output/Samples = {} can divide, got {}",
                                     scene_.output.samples, print_number(time.end)));
    if (time.step && *time.step > length)
      refuse("Time/Step", fmt::format("expected a step not longer than Time/End = {}, got {}", print_number(time.end),
                                      print_number(*time.step)));
    if (time.step && length / *time.step > most_steps)
      refuse("Time/Step",
             fmt::format("a run until Time/End = {} would take {:.3g} steps; expected at most {:.0g} of them, "
                         "that is a step of at least {:.3g}, got {}",
                         print_number(time.end), length / *time.step, most_steps, length / most_steps,
                         print_number(*time.step)));
  }

  void check_output() const {
    const auto& output = scene_.output;
    if (output.graphics != Graphics::none && output.frames > output.samples)
      refuse("Output/Frames", fmt::format("expected at most as many frames as Output/Samples = {}, got {}",
                                          output.samples, output.frames));
  }

  void check_deformation() const {
    const Matrix3& q = scene_.initial_state.deformation;
    const double size = largest_entry(q);
    if (size == 0) refuse(deformation_path, "expected a matrix of positive determinant, got zero");
    if (size > largest_stretch || size < 1 / largest_stretch)
      refuse(deformation_path,
             fmt::format("expected a largest entry between {} and {}, got {}", print_number(1 / largest_stretch),
                         print_number(largest_stretch), print_number(size)));
    const Matrix3 unit = scaled(1 / size, q);
    const double volume = det(unit);
    if (volume <= 0)
      refuse(deformation_path, fmt::format("expected a matrix of positive determinant, got {} with determinant {}",
                                           print_matrix(q), print_number(det(q))));
    const double condition = norm(unit) * norm(cofactor(unit)) / volume;
    if (condition > largest_condition)
      refuse(deformation_path, fmt::format("expected a matrix with a condition number up to {}, got {} with {:.3g}",
                                           print_number(largest_condition), print_matrix(q), condition));
  }

  void check_velocity() const {
    const double rate = largest_entry(scene_.initial_state.velocity);
    if (rate * time_unit() > largest_stretch)
      refuse(velocity_path, fmt::format("expected entries up to {} c/r = {} (c the speed of shear waves), got {}",
                                        print_number(largest_stretch), print_number(largest_stretch / time_unit()),
                                        print_number(rate)));
  }

  Matrix3 isochoric_deformation() const {
    const Matrix3& q = scene_.initial_state.deformation;
    const Matrix3 projected = project_deformation(q);
    if (std::abs(det(q) - 1) > isochoric_tolerance)
      refuse(deformation_path,
             fmt::format("expected det = 1 within {} for an incompressible body, got det = {}; the nearest choice is "
                         "\"set Deformation = {}\"",
                         print_number(isochoric_tolerance), print_number(det(q)), print_matrix(projected)));
    return projected;
  }

  Matrix3 isochoric_velocity() const {
    const Matrix3 &q = scene_.initial_state.deformation, &qdot = scene_.initial_state.velocity;
    const Matrix3 projected = project_velocity(q, qdot);
    const double rate = divergence(q, qdot).value * time_unit();
    if (std::abs(rate) > isochoric_tolerance)
      refuse(
          velocity_path,
          fmt::format("expected |tr(Q0^-1 Qdot0)| r/c <= {} for an incompressible body, got {}; the nearest choice is "
                      "\"set Velocity = {}\"",
                      print_number(isochoric_tolerance), print_number(std::abs(rate)), print_matrix(projected)));
    return projected;
  }

  Scene& scene_;
  const Origins& origins_;
};

}  // namespace

Scene validate(Scene scene, const Origins& origins) {
  Validator(scene, origins).run();
  return scene;
}

Matrix3 project_deformation(const Matrix3& deformation) {
  const double volume = det(deformation);
  const double round_off_bound = round_off * inner(absolute(deformation), absolute(cofactor(deformation)));
  if (std::abs(volume - 1) <= round_off_bound) return deformation;
  return scaled(1 / std::cbrt(volume), deformation);
}

Matrix3 project_velocity(const Matrix3& deformation, const Matrix3& velocity) {
  Matrix3 projected = velocity;
  // Twice, because after the removal of a large divergence its own round-off remains.
  for (int pass = 0; pass < 2; ++pass) {
    const Divergence trace = divergence(deformation, projected);
    if (std::abs(trace.value) <= trace.round_off_bound) break;
    const Matrix3 normal = scaled(1 / det(deformation), cofactor(deformation));
    projected = combine(1, projected, -trace.value / inner(normal, normal), normal);
  }
  return projected;
}

}  // namespace pseudorigid::scene
