#include "scene/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "entries/entry_kinds.h"
#include "entries/matrix3.h"
#include "entries/units.h"
#include "scene/advice.h"
#include "scene/analyses_of_ball.h"
#include "scene/branches.h"
#include "scene/bulk.h"
#include "scene/companions.h"
#include "scene/contact.h"
#include "scene/entries.h"
#include "scene/initial_state.h"
#include "scene/models.h"
#include "scene/owners.h"
#include "scene/scales.h"
#include "scene/user_error.h"

namespace pseudorigid::scene {
namespace {

/// Largest semi-axis in radii. The least semi-axis is the reciprocal of this number. For an ellipsoid, the second
/// moment E₀ divided by the mass has entries that are proportional to squares of semi-axes. These entries are therefore
/// at most 10¹² times those of the ball.
constexpr double largest_axis = 1e6;

/// Largest value of ρr⁵, μr³ and the unit of time (check_units), in the units of the user. The least permitted value is
/// the reciprocal of this number. Products of three such numbers are finite.
constexpr double largest_unit = 1e100;

/// Largest number of steps. The fastest systems need 0.1 µs per step, and therefore about a day for this number. The
/// number is far below 2⁵², the number of steps whose times a double can distinguish.
constexpr double most_steps = 1e12;

/// The purpose of a check: to judge the scene, or to try a recommendation. A trial does not compute recommendations,
/// because each recommendation would need further trials.
enum class Purpose { judge, try_advice };

class Validator {
 public:
  Validator(Scene& scene, const Origins& origins, Purpose purpose)
      : scene_(scene), origins_(origins), purpose_(purpose) {}

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
      refuse("Analysis", fmt::format("{} is offered for systems other than the ball: {}",
                                     analysis_kind.print(scene_.analysis), joined(systems_for(scene_.analysis))));
    if (scene_.time.end < 0) refuse("Time/End", needs_complete_system());
    set_constant_of_gravity();
    check_problem();
    if (scene_.analysis == Analysis::motion)
      if (const auto refusal = refuses_duration(scene_.time.end, time_unit())) refuse(*refusal);
    check_reference_body();
    check_loads();
    check_output();
    if (const auto refusal = refuses_initial_state(scene_)) refuse(*refusal);
    if (const auto refusal = refuses_starting_figure(scene_)) refuse(*refusal);
    if (const auto refusal = refuses_planes(scene_)) refuse(*refusal);
    if (const auto refusal = refuses_companions(scene_)) refuse(*refusal);
    if (const auto refusal = refuses_branches(scene_)) refuse(*refusal);
    if (const auto refusal = refuses_bulk(scene_)) refuse(*refusal);
    if (scene_.body.incompressible)
      if (const auto refusal = make_isochoric(scene_)) refuse(*refusal);
    if (const auto refusal = refuses_vibration(scene_)) refuse(*refusal);
    check_models();
  }

  /// If the scene gives γ = ρgr/μ, sets the constant of gravity to G = 3γμ/(4πρ²r²). Here ρ is the density, r the
  /// radius, μ the shear modulus, and g = (4/3)πGρr. Refuses γ of a fluid, and a scene that also gives another G. A
  /// trial does not refuse another G, because it may follow from γ or μ before the recommended change.
  void set_constant_of_gravity() {
    if (scene_.gamma == 0) return;
    if (is_fluid(scene_))
      refuse("Gravity/Gamma", "a fluid has no shear modulus, so gamma is not defined; give Gravity/Constant instead");
    const double mass_by_length = scene_.body.density * scene_.body.radius;
    const double constant =
        3 * scene_.gamma / (4 * std::numbers::pi) * (scene_.material.shear_modulus / mass_by_length / mass_by_length);
    double& given = scene_.loads.get<loads::SelfGravity>().constant;
    if (purpose_ == Purpose::judge && given != 0 && given != constant)
      refuse("Gravity/Gamma", fmt::format("expected one of Gravity/Gamma and Gravity/Constant, got {} and {}",
                                          print_number(scene_.gamma), print_number(given)));
    given = constant;
  }

  [[noreturn]] void refuse(const std::string& path, const std::string& sentence) const {
    throw UserError(fmt::format("{}: {}: {}", origins_.of(path), path, sentence));
  }
  /// Throws UserError with the recommendations of the refusal. In a trial the sentence is empty, because is_accepted
  /// ignores the sentence.
  [[noreturn]] void refuse(const Refusal& refusal) const {
    const auto accepts = [&](Scene trial) { return is_accepted(std::move(trial), origins_); };
    refuse(refusal.path, purpose_ == Purpose::judge ? sentence_with_advice(refusal, scene_, accepts) : "");
  }

  /// The systems that offer `analysis`, which must be manifolds or section. All systems offer sections. Only systems
  /// with critical points offer manifolds.
  std::vector<std::string_view> systems_for(Analysis analysis) const {
    std::vector<std::string_view> names;
    for (const SystemDescription& system : catalogue_of(scene_).systems)
      if (system.has_equilibria || analysis == Analysis::section) names.push_back(system.name);
    return names;
  }

  /// Refuses entries that belong to another system. Such an entry would have no effect, and is probably a mistake.
  void check_ownership() const {
    for (const auto& [path, where] : origins_.all())
      if (!concerns(scene_, path))
        refuse(path, fmt::format("it belongs to System = {}, and the System of this scene is {}",
                                 owner_of(catalogue_of(scene_), path), scene_.system));
  }

  void check_sweep() const {
    if (scene_.sweep.empty()) return;
    const bool is_ball = scene_.system == ball;
    if (is_ball && scene_.models.size() > 1 && scene_.sweep_trajectories)
      refuse({"Sweep/Trajectories", "a sweep keeps the samples of one model", {{{"Sweep/Trajectories", "false"}}}});
    const bool is_equilibrium = is_ball && scene_.analysis == Analysis::equilibrium;
    if (scene_.analysis != Analysis::motion && !is_linear(scene_.analysis) && !is_equilibrium)
      refuse({"Analysis",
              "a sweep is offered for motions, and for modes, Love numbers and equilibria of the ball",
              {{{"Analysis", "motion"}}}});
    if (scene_.analysis != Analysis::motion && scene_.sweep_trajectories)
      refuse({"Sweep/Trajectories",
              "modes, Love numbers and equilibria have no samples",
              {{{"Sweep/Trajectories", "false"}}}});
    if (is_equilibrium) check_sweep_of_equilibria();
    if (is_ball && scene_.output.graphics != Graphics::none)
      refuse({"Output/Graphics", "a sweep writes no pictures", {{{"Output/Graphics", "none"}}}});
  }

  /// Refuses a sweep of equilibria if its runs do not have exactly one figure each.
  void check_sweep_of_equilibria() const {
    if (finds_static_equilibria(scene_)) {
      if (std::ranges::any_of(models_of(scene_), [](const auto* model) { return !model->has_nonaffine; }))
        refuse({"Models",
                "each run of a sweep has one figure of each model, and a static search finds several; "
                "Polynomial/Degree = 1 gives one",
                {{{"Models", is_discretized(scene_) ? "polynomial, continuum" : "polynomial"},
                  {"Polynomial/Degree", "1"}}}});
      return;
    }
    if (scene_.equilibria.number != 1)
      refuse({"Equilibrium/Number",
              "each run of a sweep computes one figure, that with the parameter Equilibrium/First",
              {{{"Equilibrium/Number", "1"}}}});
  }

  void check_system(const SystemDescription& system) {
    scene_.models.clear();
    if (is_linear(scene_.analysis))
      refuse("Analysis", fmt::format("{} are offered for the ball, not for System = {}",
                                     analysis_kind.print(scene_.analysis), system.name));
    const bool wants_critical_points =
        scene_.analysis == Analysis::equilibrium || scene_.analysis == Analysis::manifolds;
    if (wants_critical_points && !system.has_equilibria)
      refuse("Analysis", fmt::format("{} is not offered for System = {}, which has no critical points to find",
                                     analysis_kind.print(scene_.analysis), system.name));
    if (scene_.time.end < 0 && !system.complete) refuse("Time/End", needs_complete_system());
    if (const auto refusal = system.refuses(scene_)) refuse(*refusal);
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

  /// The error message if Time/End is negative and the system does not permit runs backwards in time.
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
    if (const auto refusal = refuses_analysis_of_ball(scene_)) refuse(*refusal);
    if (models_of(scene_).empty())
      refuse("Models", "expected at least one of " + joined(names_where(scene_, [](const auto&) { return true; })));
    check_method();
    check_units();
    check_law();
  }

  void check_method() const {
    const auto models = models_of(scene_);
    const auto all_take = [&](std::string_view method) {
      return std::ranges::all_of(models, [&](const auto* model) { return takes_method(*model, method); });
    };
    const std::string_view method = scene_.time.method;
    if (all_take(method)) return;
    std::vector<std::vector<Setting>> others;
    for (const NamedMethod& other : catalogue_of(scene_).methods)
      if (all_take(other.name)) others.push_back({{"Time/Method", std::string(other.name)}});
    refuse({"Time/Method", scene_.time.method + " is", others,
            names_where(scene_, [&](const auto& model) { return takes_method(model, method); })});
  }

  /// Refuses units that do not give moderate numbers. Let ρ be the density, r the radius and μ the shear modulus. The
  /// kinetic energy of the body is proportional to ρr⁵, and the elastic energy to μr³. These two numbers and the unit
  /// of time must be between 1/largest_unit and largest_unit.
  void check_units() const {
    const double radius = scene_.body.radius, density = scene_.body.density, modulus = scene_.material.shear_modulus;
    const double inertia = density * std::pow(radius, 5), stiffness = modulus * std::pow(radius, 3);
    const auto is_sound = [](double x) { return x >= 1 / largest_unit && x <= largest_unit; };
    if (is_sound(inertia) && is_sound(stiffness) && is_sound(time_unit())) return;
    const auto distance = [](double x) { return std::abs(std::log10(x)); };
    const auto [path, farthest] = std::max({std::pair("Body/Radius", 5 * distance(radius)),
                                            {"Body/Density", distance(density)},
                                            {"Material/Shear modulus", distance(modulus)}},
                                           [](const auto& a, const auto& b) { return a.second < b.second; });
    refuse(path,
           fmt::format(
               "with radius {}, density {} and shear modulus {} the body's inertia, stiffness or time scale is not "
               "between {:g} and {:g}; choose units nearer to the size of the body",
               print_number(radius), print_number(density), print_number(modulus), 1 / largest_unit, largest_unit));
  }

  /// Refuses parameters of the law that double precision cannot handle: a Lamé λ above 10¹² μ in a law that uses λ, and
  /// a limit of Gent's law below 10⁻¹².
  void check_law() const {
    const materials::AnyLaw law = law_of(scene_);
    const double mu = scene_.material.shear_modulus, lambda = scene_.material.lame_lambda;
    const double gent_limit = scene_.material.gent_limit;
    const bool is_svk = std::holds_alternative<materials::SaintVenantKirchhoff>(law) ||
                        std::holds_alternative<materials::SaintVenantKirchhoffAsPrinted>(law);
    if (!materials::is_fluid(law) && (is_svk || !scene_.body.incompressible) && lambda > largest_condition * mu)
      refuse({"Material/Lame lambda",
              fmt::format("expected at most {} shear moduli, got {}: waves that change the volume are too fast then",
                          print_number(largest_condition), print_number(lambda)),
              {{{"Body/Incompressible", "true"}}}});
    if (std::holds_alternative<materials::Gent>(law) && gent_limit < 1 / largest_condition)
      refuse("Material/Gent limit",
             fmt::format("expected at least {}, got {}: double precision does not tell I - 3 then",
                         print_number(1 / largest_condition), print_number(gent_limit)));
  }

  /// Throws UserError if a model of the scene refuses the scene (ModelDescription::refuses). The functions `refuses`
  /// assume that all other checks have accepted the scene.
  void check_models() const {
    for (const ModelDescription* model : models_of(scene_))
      if (const auto refusal = model->refuses ? model->refuses(scene_) : std::nullopt) refuse(*refusal);
  }

  static bool without_elements(const ModelDescription& model) { return !model.discretized; }

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
    const auto& a = scene_.body.semi_axes;
    const double of_ball = scene_.body.density * std::pow(scene_.body.radius, 5) * a[0] * a[1] * a[2];
    if (!(unit <= largest_condition * of_ball && unit >= of_ball / largest_condition))
      refuse("Body/Inertia",
             fmt::format("expected a largest entry between {} and {}, for this density, radius and semi-axes, got {}",
                         print_lower_bound(of_ball / largest_condition), print_upper_bound(largest_condition * of_ball),
                         print_matrix(E0)));
    if (loads::present(scene_.loads.get<loads::SelfGravity>()))
      refuse({"Body/Inertia",
              "self-gravity is known for ellipsoids only, which Semi-axes describe",
              {{{"Body/Inertia", "auto"}}}});
  }

  /// The largest absolute value of the numbers of an entry.
  static double largest(double value) { return std::abs(value); }
  static double largest(const std::optional<double>& value) { return std::abs(value.value_or(0)); }
  static double largest(const std::vector<double>& v) {
    double most = 0;
    for (const double value : v) most = std::max(most, std::abs(value));
    return most;
  }
  static double largest(const Matrix3& A) { return largest_entry(A); }

  void check_loads() const {
    const io::Units units = io::ball_units(scene_.body.radius, scene_.body.density, time_unit());
    const auto require_moderate = [&](std::string_view path, double value, Unit unit) {
      if (!(units.to_internal(value, unit) <= largest_stretch))
        refuse(std::string(path),
               fmt::format("expected values up to {} in the body's own units, got {}",
                           print_upper_bound(units.to_physical(largest_stretch, unit)), print_number(value)));
    };
    scene_.loads.for_each([&]<class Load>(const Load& load) {
      // The sizes of the entries of an absent load, such as the frequency of a tide, and of a rise are not checked.
      const bool acts = loads::present(load) && !std::is_same_v<Load, loads::Rise>;
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
    if (largest_entry(combine(1, A, -1, transposed)) > round_off_of_sum * largest_entry(A))
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
      refuse(
          "Time/Step",
          fmt::format("a run until Time/End = {} would take {} steps; expected at most {} of them, that is a step of "
                      "at least {}, got {}",
                      print_number(time.end), print_lower_bound(length / *time.step), print_number(most_steps),
                      print_lower_bound(length / most_steps), print_number(*time.step)));
  }

  void check_output() const {
    const auto& output = scene_.output;
    if (output.graphics != Graphics::none && output.frames > output.samples)
      refuse("Output/Frames", fmt::format("expected at most as many frames as Output/Samples = {}, got {}",
                                          output.samples, output.frames));
  }

  Scene& scene_;
  const Origins& origins_;
  Purpose purpose_;
};

}  // namespace

Scene validate(Scene scene, const Origins& origins) {
  Validator(scene, origins, Purpose::judge).run();
  return scene;
}

bool is_accepted(Scene scene, const Origins& origins) try {
  Validator(scene, origins, Purpose::try_advice).run();
  return true;
} catch (const UserError&) {
  return false;
}

}  // namespace pseudorigid::scene
