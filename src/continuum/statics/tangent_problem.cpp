#include "continuum/statics/tangent_problem.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "continuum/parallel/ghost_values.h"

namespace pseudorigid::continuum {
namespace {

/// A third of the trace of the Kirchhoff stress PFᵀ of the law, with the first Piola–Kirchhoff stress P.
double mean_stress(const StoredEnergy& stored, const materials::Tensor<double>& F) {
  return std::visit([&](const auto& known) { return materials::dot(known.stress(F), F) / 3; }, stored.law);
}

/// The diagonal of −Ω²P for a rotation, or of νT for a ball at rest: the stiffness per mass of the centrifugal force or
/// of the quadratic potential. The planes of the octant are planes of symmetry, so T is diagonal.
Eigen::Vector3d rate_of_drive(const FigureState& state) {
  if (state.kind == Drive::loads) return state.drive * state.forcing.quadratic.diagonal();
  return -state.drive * Eigen::Vector3d(1, 1, 0);
}

/// The pressure on the surface.
double pressure_of(const FigureState& state) {
  return state.forcing.pressure * (state.kind == Drive::loads ? state.drive : 1);
}

/// λ_h at the Gauss points of a cell. It is 0 for a compressible body.
std::vector<double> multiplier_at_points(const FigureState& state, unsigned int cell) {
  std::vector<double> lambda(state.body.space().nodes_per_cell(), 0);
  if (state.incompressible) state.body.kernels().multiplier_at_points(state.lambda, cell, lambda);
  return lambda;
}

}  // namespace

PointCoefficients tangent_coefficients(const CellStiffness& cells, const FigureState& state, unsigned int cell,
                                       Balance balance) {
  const std::vector<double> lambda = multiplier_at_points(state, cell);
  const double pressure = pressure_of(state);
  return cells.coefficients(cell, state.x, [&](int q, const materials::Tensor<double>& F) {
    const bool is_multiplier = balance == Balance::multiplier;
    Tangent tangent =
        tangent_at(state.stored, F, is_multiplier ? lambda[static_cast<std::size_t>(q)] : mean_stress(state.stored, F));
    return pressure == 0 ? tangent : tangent.add(pressure, tangent_of_pressure(F));
  });
}

double weight_of_surface(const FigureState& state) {
  const double of_gravity = weight_of_density(state.forcing.gravity_constant);
  if (!state.incompressible || state.kind != Drive::loads) return of_gravity;
  return of_gravity + std::max(0.0, state.drive * state.forcing.quadratic.diagonal().minCoeff());
}

std::vector<FaceSprings> springs_of_weight(const BallSpace& space, const Vector& x, double weight) {
  const GhostValues of_x(x);
  return springs_at_surface(space, [&](const FacePoint& point) -> Eigen::Vector3d {
    const FacePoint::Jet at = point.jet(x);
    const Eigen::Vector3d area = at.by_p.cross(at.by_q);
    return std::sqrt(weight / area.norm()) * area;
  });
}

Vector rate_of_gravity(const FigureState& state, const Vector& u, const Parity& parity) {
  Vector force = state.body.make_vector();
  state.body.gravity()->add_rate(state.x, u, parity.sign, force);
  force *= -1;
  return force;
}

void add_rate_of_springs(const BallSpace& space, const std::vector<FaceSprings>& springs, double factor,
                         const Vector& u, Vector& force) {
  const GhostValues of_u(u);
  for (const FaceSprings& of_face : springs) {
    const auto entry = [&](Eigen::Index i) {
      return space.entry_of(of_face.cell, of_face.places[static_cast<std::size_t>(i)]);
    };
    Eigen::VectorXd at_face(of_face.rows.cols());
    for (Eigen::Index i = 0; i < at_face.size(); ++i) at_face[i] = u.local_element(entry(i));
    const Eigen::VectorXd of_springs = factor * (of_face.rows.transpose() * (of_face.rows * at_face));
    for (Eigen::Index i = 0; i < at_face.size(); ++i) force.local_element(entry(i)) += of_springs[i];
  }
  add_to_owners(force);
}

void add_rate_beyond_cells(const FigureState& state, const HeldDirection* held, const Vector& u, Vector& force) {
  const Eigen::Vector3d rate = rate_of_drive(state);
  const Vector& mass = state.body.space().mass();
  if (!rate.isZero(0))
    for (unsigned int i = 0; i < 3 * state.body.space().n_nodes(); ++i)
      force.local_element(i) += rate[i % 3] * mass.local_element(i) * u.local_element(i);
  if (held) force.add(held->stiffness * (held->w * u), held->w);
}

double typical_stiffness(const StoredEnergy& stored, bool incompressible, const loads::Forcing& forcing) {
  return std::max(materials::moduli_at_rest(stored.law, incompressible).shear,
                  weight_of_density(forcing.gravity_constant));
}

TangentProblem::TangentProblem(const FigureState& state, double of_shift, const HeldDirection* held)
    : LinearProblem(state.body.space(), state.incompressible, of_shift,
                    typical_stiffness(state.stored, state.incompressible, state.forcing)),
      state_(state),
      definite_(of_shift > 0),
      held_(held) {
  if (definite_) of_mass = rate_of_drive(state);
  if (incompressible) set_constraint(state.body.kernels(), state.x);
  const CellStiffness cells(space);
  const double weight = weight_of_surface(state);
  const bool splits_gravity = weight > 0 && !definite_;
  set_stiffness([&](unsigned int cell) {
    if (!splits_gravity) return cells.cell_matrix(tangent_coefficients(cells, state, cell, Balance::multiplier));
    const std::vector<double> lambda = multiplier_at_points(state, cell);
    of_gravity_.push_back(cells.cell_matrix(cell, state.x, [&](int q, const materials::Tensor<double>& F) {
      Tangent tangent{};
      return tangent.add(lambda[static_cast<std::size_t>(q)] - mean_stress(state.stored, F), tangent_of_constraint(F));
    }));
    return cells.cell_matrix(tangent_coefficients(cells, state, cell, Balance::mean_stress));
  });
  if (splits_gravity) {
    springs_ = springs_of_weight(space, state.x, weight);
    add_springs(springs_);
  }
  if (definite_ && state.body.gravity()) couple_surface();
}

Vector TangentProblem::rate_at_surface(const Vector& u, const Parity& parity) const {
  Vector force = state_.body.gravity() ? rate_of_gravity(state_, u, parity) : space.make_vector();
  add_rate_of_springs(space, springs_, -1, u, force);
  return force;
}

Vector TangentProblem::rate_within(const Vector& u) const {
  Vector force = space.make_vector();
  add_rate_beyond_cells(state_, held_, u, force);
  Eigen::VectorXd local(3 * space.nodes_per_cell());
  for (unsigned int cell = 0; cell < of_gravity_.size(); ++cell) {
    for (Eigen::Index i = 0; i < local.size(); ++i) local[i] = u.local_element(space.entry_of(cell, i));
    local = (of_gravity_[cell] * local).eval();
    for (Eigen::Index i = 0; i < local.size(); ++i) force.local_element(space.entry_of(cell, i)) += local[i];
  }
  return force;
}

BeyondCells TangentProblem::beyond_cells(const ParitySector& sector) const {
  const SurfaceGravityForces* gravity = state_.body.gravity();
  if (!definite_) {
    if (!gravity && !held_ && rate_of_drive(state_).isZero(0)) return {};
    return {[this, &sector, gravity](const Eigen::VectorXd& u) -> Eigen::VectorXd {
      const Vector field = sector.field_of(u);
      Vector f = rate_within(field);
      if (gravity || !springs_.empty()) f += rate_at_surface(field, sector.parity());
      return sector.entries_of(f);
    }};
  }
  if (!gravity) return {};
  BeyondCells beyond{{}, unknowns_at_surface(sector), {}};
  std::vector<unsigned int> entries;
  for (const Eigen::Index unknown : beyond.unknowns) entries.push_back(sector.entry_of(unknown));
  beyond.matrix = gravity->hessian(state_.x, sector.parity().sign, entries);
  beyond.matrix = (beyond.matrix + beyond.matrix.transpose()).eval() / 2;  // removes round-off
  return beyond;
}

}  // namespace pseudorigid::continuum
