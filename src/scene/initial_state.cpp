#include "scene/initial_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "entries/entry_kinds.h"
#include "scene/discretization.h"
#include "scene/models.h"
#include "scene/scales.h"
#include "scene/scene.h"

namespace pseudorigid::scene {
namespace {

constexpr double isochoric_tolerance = 1e-8;

constexpr const char* deformation_path = "Initial state/Deformation";
constexpr const char* velocity_path = "Initial state/Velocity";

/// The trace tr(Q⁻¹Q̇) = Q⁻ᵀ : Q̇ for the initial deformation Q and the initial velocity Q̇, and a bound of its
/// round-off.
struct Divergence {
  double value, round_off_bound;
};

Divergence divergence(const Matrix3& q, const Matrix3& qdot) {
  const Matrix3 inverse_transposed = scaled(1 / det(q), cofactor(q));
  return {inner(inverse_transposed, qdot), round_off_of_sum * inner(absolute(inverse_transposed), absolute(qdot))};
}

std::optional<Refusal> refuses_deformation(const Matrix3& q) {
  const double size = largest_entry(q);
  if (size == 0) return Refusal{deformation_path, "expected a matrix of positive determinant, got zero"};
  if (size > largest_stretch || size < 1 / largest_stretch)
    return Refusal{deformation_path,
                   fmt::format("expected a largest entry between {} and {}, got {}", print_number(1 / largest_stretch),
                               print_number(largest_stretch), print_number(size))};
  const Matrix3 unit = scaled(1 / size, q);
  const double volume = det(unit);
  if (volume <= 0)
    return Refusal{deformation_path,
                   fmt::format("expected a matrix of positive determinant, got {} with determinant {}", print_matrix(q),
                               print_number(det(q)))};
  const double condition = norm(unit) * norm(cofactor(unit)) / volume;
  if (condition > largest_condition)
    return Refusal{deformation_path,
                   fmt::format("expected a matrix with a condition number up to {}, got {} with {}",
                               print_number(largest_condition), print_matrix(q), print_lower_bound(condition))};
  return {};
}

std::optional<Refusal> refuses_velocity(const Matrix3& qdot, double time_unit) {
  const double rate = largest_entry(qdot);
  if (rate * time_unit <= largest_stretch) return {};
  return Refusal{velocity_path, fmt::format("expected entries up to {} c/r = {} (c the speed of shear waves), got {}",
                                            print_number(largest_stretch),
                                            print_upper_bound(largest_stretch / time_unit), print_number(rate))};
}

std::optional<Refusal> refuses_expansion(const Matrix3& q, const Matrix3& projected) {
  if (std::abs(det(q) - 1) <= isochoric_tolerance) return {};
  return Refusal{deformation_path,
                 fmt::format("expected det = 1 within {} for an incompressible body, got det = {}; the nearest choice "
                             "is \"set Deformation = {}\"",
                             print_number(isochoric_tolerance), print_number(det(q)), print_matrix(projected)),
                 {{{"Body/Incompressible", "false"}}}};
}

std::optional<Refusal> refuses_rate_of_expansion(double rate, const Matrix3& projected) {
  if (std::abs(rate) <= isochoric_tolerance) return {};
  return Refusal{velocity_path,
                 fmt::format("expected |tr(Q0^-1 Qdot0)| r/c <= {} for an incompressible body, got {}; the nearest "
                             "choice is \"set Velocity = {}\"",
                             print_number(isochoric_tolerance), print_number(std::abs(rate)), print_matrix(projected))};
}

}  // namespace

std::optional<Refusal> refuses_initial_state(const Scene& scene) {
  if (auto refusal = refuses_deformation(scene.initial_state.deformation)) return refusal;
  return refuses_velocity(scene.initial_state.velocity, time_scale(scene));
}

std::optional<Refusal> refuses_starting_figure(const Scene& scene) {
  const Scene::InitialState& start = scene.initial_state;
  if (scene.analysis != Analysis::motion) return {};
  if (start.figure == StartingFigure::affine && start.mode == 0) return {};
  if (start.equilibrium == Family::none && !start.origin)
    return Refusal{start.mode != 0 ? "Initial state/Mode" : "Initial state/Figure",
                   "it belongs to a relative equilibrium; give Initial state/Equilibrium and its parameter"};
  if (start.mode == 0) return {};
  const auto models = models_of(scene);
  const char* path = "Initial state/Mode";
  if (start.mode && models.size() > 1)
    return Refusal{path,
                   "the number of a small motion is that of one model, and the scene has several",
                   {},
                   names_where(scene, [](const auto&) { return true; })};
  if (!std::ranges::any_of(models, &ModelDescription::has_nonaffine)) return {};
  if (start.figure == StartingFigure::affine)
    return Refusal{
        path, "a small motion is added to the figure of the model itself", {{{"Initial state/Figure", "own"}}}};
  if (!start.mode) return {};
  if (std::ranges::any_of(models, &ModelDescription::discretized)) {
    if (!fixed_discretization(scene))
      return Refusal{path, "the number of a small motion depends on the mesh; give Continuum/Degree and Refinements"};
  } else if (scene.polynomial.degrees.size() != 1) {
    return Refusal{path, "the number of a small motion is that of one degree; give one number to Polynomial/Degree"};
  }
  return {};
}

std::optional<Refusal> make_isochoric(Scene& scene) {
  Matrix3 &q = scene.initial_state.deformation, &qdot = scene.initial_state.velocity;
  const Matrix3 projected = project_deformation(q);
  if (auto refusal = refuses_expansion(q, projected)) return refusal;
  q = projected;
  // The velocity is judged when the equilibrium has been replaced by explicit values, because its rate of expansion
  // depends on the figure.
  if (scene.initial_state.equilibrium != Family::none) return {};
  const Matrix3 tangent = project_velocity(q, qdot);
  Matrix3 permitted = tangent;  // value of the entry Velocity that gives `tangent`
  if (const auto& origin = scene.initial_state.origin)
    permitted = combine(1, origin->velocity, 1, combine(1, tangent, -1, qdot));
  if (auto refusal = refuses_rate_of_expansion(divergence(q, qdot).value * time_scale(scene), permitted))
    return refusal;
  qdot = tangent;
  return {};
}

Matrix3 project_deformation(const Matrix3& deformation) {
  const double volume = det(deformation);
  const double round_off_bound = round_off_of_sum * inner(absolute(deformation), absolute(cofactor(deformation)));
  if (std::abs(volume - 1) <= round_off_bound) return deformation;
  return scaled(1 / std::cbrt(volume), deformation);
}

Matrix3 project_velocity(const Matrix3& deformation, const Matrix3& velocity) {
  Matrix3 projected = velocity;
  // Two passes, because the removal of a large divergence leaves round-off.
  for (int pass = 0; pass < 2; ++pass) {
    const Divergence trace = divergence(deformation, projected);
    if (std::abs(trace.value) <= trace.round_off_bound) break;
    const Matrix3 normal = scaled(1 / det(deformation), cofactor(deformation));
    projected = combine(1, projected, -trace.value / inner(normal, normal), normal);
  }
  return projected;
}

}  // namespace pseudorigid::scene
