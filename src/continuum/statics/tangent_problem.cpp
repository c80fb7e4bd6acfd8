#include "continuum/statics/tangent_problem.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "continuum/modes/cell_stiffness.h"

namespace pseudorigid::continuum {
namespace {

/// A third of the trace of the Kirchhoff stress PFᵀ of the law, with the first Piola–Kirchhoff stress P.
double mean_stress(const StoredEnergy& stored, const materials::Tensor<double>& F) {
  return std::visit([&](const auto& known) { return materials::dot(known.stress(F), F) / 3; }, stored.law);
}

}  // namespace

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
  if (definite_) of_mass = rate_of_drive();
  if (incompressible) set_constraint(state.body.kernels(), state.x);
  const CellStiffness cells(space);
  const double pressure = state.forcing.pressure * (state.kind == Drive::loads ? state.drive : 1);
  const double weight = weight_of_density(state.forcing.gravity_constant);
  const bool splits_gravity = weight > 0 && !definite_;
  std::vector<double> lambda(space.nodes_per_cell(), 0);
  set_stiffness([&](unsigned int cell) {
    if (incompressible) state.body.kernels().multiplier_at_points(state.lambda, cell, lambda);
    if (splits_gravity)
      of_gravity_.push_back(cells.cell_matrix(cell, state.x, [&](int q, const materials::Tensor<double>& F) {
        Tangent tangent{};
        return tangent.add(lambda[static_cast<std::size_t>(q)] - mean_stress(state.stored, F),
                           tangent_of_constraint(F));
      }));
    return cells.cell_matrix(cell, state.x, [&](int q, const materials::Tensor<double>& F) {
      const double balanced = splits_gravity ? mean_stress(state.stored, F) : lambda[static_cast<std::size_t>(q)];
      Tangent tangent = tangent_at(state.stored, F, balanced);
      return pressure == 0 ? tangent : tangent.add(pressure, tangent_of_pressure(F));
    });
  });
  if (splits_gravity)
    springs_ = add_springs([&](const FacePoint& point) -> Eigen::Vector3d {
      const FacePoint::Jet at = point.jet(state.x);
      const Eigen::Vector3d area = at.by_p.cross(at.by_q);
      return std::sqrt(weight / area.norm()) * area;
    });
  if (definite_ && weight > 0) couple_surface();
}

Eigen::Vector3d TangentProblem::rate_of_drive() const {
  if (state_.kind == Drive::loads) return state_.drive * state_.forcing.quadratic.diagonal();
  return -state_.drive * Eigen::Vector3d(1, 1, 0);
}

Vector TangentProblem::rate_at_surface(const Vector& u, const Parity& parity) const {
  Vector force = space.make_vector();
  state_.body.gravity()->add_rate(state_.x, u, parity.sign, force);
  force *= -1;
  for (const FaceSprings& springs : springs_) {
    const Eigen::VectorXd of_face = of_cell(springs.cell, u)(springs.places);
    Eigen::VectorXd local = Eigen::VectorXd::Zero(3 * space.nodes_per_cell());
    local(springs.places) = -(springs.rows.transpose() * (springs.rows * of_face));
    add_of_cell(springs.cell, local, force);
  }
  return force;
}

Vector TangentProblem::rate_within(const Vector& u) const {
  Vector force = space.make_vector();
  for (unsigned int i = 0; i < 3 * space.n_nodes(); ++i)
    force.local_element(i) = rate_of_drive()[i % 3] * space.mass().local_element(i) * u.local_element(i);
  if (held_) force.add(held_->stiffness * (held_->w * u), held_->w);
  for (unsigned int cell = 0; cell < of_gravity_.size(); ++cell)
    add_of_cell(cell, of_gravity_[cell] * of_cell(cell, u), force);
  return force;
}

Eigen::VectorXd TangentProblem::of_cell(unsigned int cell, const Vector& u) const {
  Eigen::VectorXd local(3 * space.nodes_per_cell());
  Eigen::Index i = 0;
  for (const unsigned int node : space.cell_nodes(cell))
    for (unsigned int c = 0; c < 3; ++c) local[i++] = u.local_element(3 * node + c);
  return local;
}

void TangentProblem::add_of_cell(unsigned int cell, const Eigen::VectorXd& local, Vector& f) const {
  Eigen::Index i = 0;
  for (const unsigned int node : space.cell_nodes(cell))
    for (unsigned int c = 0; c < 3; ++c) f.local_element(3 * node + c) += local[i++];
}

BeyondCells TangentProblem::beyond_cells(const ParitySector& sector) const {
  const SurfaceGravityForces* gravity = state_.body.gravity();
  if (!definite_) {
    if (!gravity && !held_ && rate_of_drive().isZero(0)) return {};
    return {[this, &sector, gravity](const Eigen::VectorXd& u) -> Eigen::VectorXd {
      const Vector field = sector.field_of(u);
      Vector f = rate_within(field);
      if (gravity) f += rate_at_surface(field, sector.parity());
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
