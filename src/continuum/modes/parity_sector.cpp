#include "continuum/modes/parity_sector.h"

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#ifdef PSEUDORIGID_CHOLMOD
#include <Eigen/CholmodSupport>
#else
#include <Eigen/SparseCholesky>
#endif

#include <algorithm>
#include <cmath>
#include <utility>

#include "continuum/modes/krylov.h"

namespace pseudorigid::continuum {
namespace {

/// Numbers of corrections of the constraint G u (parity_sector.h): for the operator of the eigenvalue problem, for a
/// mode or a step of the conjugate gradients, and for a static response. The iteration for eigenvectors needs G u = 0
/// only roughly, because the step of inverse iteration after it corrects G u.
constexpr int n_corrections_of_operator = 0, n_corrections_of_mode = 1, n_corrections_of_response = 4;
/// Relative tolerances of the conjugate gradients in the energy norm. The first is for eigenvectors and modes, the
/// second for a static response.
constexpr double tolerance_of_operator = 1e-9, tolerance_of_response = 1e-13;
/// Largest number of steps of the augmented Lagrangian method in `solve`.
constexpr int n_steps_of_multiplier = 8;
/// Largest numbers of iterations of the conjugate gradients and of GMRES.
constexpr int n_iterations_of_gradients = 100, n_iterations_of_gmres = 120;
/// The matrix of the unknowns between cells is factorised as a dense matrix for up to this number of unknowns.
constexpr Eigen::Index n_dense = 1500;

#ifdef PSEUDORIGID_CHOLMOD
using SparseCholesky = Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>>;
#else
using SparseCholesky = Eigen::SimplicialLLT<Eigen::SparseMatrix<double>>;
#endif

}  // namespace

/// The free entries of a cell, which the parity does not set to 0. First are the entries of nodes that only this cell
/// has (`own`), and then those of shared nodes (LinearProblem::is_shared). B_own and B_own,shared are the blocks
/// of the matrix B of parity_sector.h for these entries.
struct ParitySector::Cell {
  std::vector<int> own, shared, free;      ///< 3·(node of the cell) + component; `free` is `own` followed by `shared`
  std::vector<Eigen::Index> unknown;       ///< index of each entry in the vectors of the sector
  Eigen::LLT<Eigen::MatrixXd> own_factor;  ///< Cholesky factor L of B_own
  Eigen::MatrixXd coupling;                ///< L⁻¹ B_own,shared
  Eigen::MatrixXd constraint;              ///< G of the free entries
};

/// The Cholesky factor of the matrix of the unknowns between cells, after condensation. It is `dense` for at most
/// n_dense such unknowns, and otherwise `sparse`.
struct ParitySector::Interface {
  Eigen::LLT<Eigen::MatrixXd> dense;
  SparseCholesky sparse;
};

ParitySector::ParitySector(const LinearProblem& problem, const Parity& parity)
    : problem_(problem), parity_(parity), interface_(std::make_unique<Interface>()) {
  number_unknowns();
}
ParitySector::~ParitySector() = default;

void ParitySector::number_unknowns() {
  const BallSpace& space = problem_.space;
  const auto is_free = [&](unsigned int node, int component) {
    for (int plane = 0; plane < 3; ++plane)
      if (space.reference_positions().local_element(3 * node + plane) == 0 && parity_.holds(component, plane))
        return false;
    return true;
  };
  std::vector<Eigen::Index> unknown(3 * space.n_nodes(), -1);
  const auto number = [&](unsigned int entry) {
    if (unknown[entry] >= 0) return;
    unknown[entry] = static_cast<Eigen::Index>(entry_of_unknown_.size());
    entry_of_unknown_.push_back(entry);
  };
  cells_.resize(space.n_cells());
  for (unsigned int c = 0; c < space.n_cells(); ++c) {
    const auto& nodes = space.cell_nodes(c);
    for (unsigned int a = 0; a < nodes.size(); ++a)
      for (int i = 0; i < 3; ++i) {
        if (!is_free(nodes[a], i)) continue;
        const bool own = !problem_.is_shared[nodes[a]];
        (own ? cells_[c].own : cells_[c].shared).push_back(static_cast<int>(3 * a) + i);
        if (own) number(3 * nodes[a] + i);
      }
  }
  first_interface_ = entry_of_unknown_.size();
  for (unsigned int c = 0; c < space.n_cells(); ++c) {
    const auto& nodes = space.cell_nodes(c);
    for (const auto* part : {&cells_[c].own, &cells_[c].shared})
      for (const int local : *part) {
        const unsigned int entry = 3 * nodes[local / 3] + local % 3;
        number(entry);
        cells_[c].free.push_back(local);
        cells_[c].unknown.push_back(unknown[entry]);
      }
  }
  n_unknowns_ = entry_of_unknown_.size();
  mass_.resize(static_cast<Eigen::Index>(n_unknowns_));
  for (std::size_t i = 0; i < n_unknowns_; ++i)
    mass_[static_cast<Eigen::Index>(i)] = space.mass().local_element(entry_of_unknown_[i]);
  root_mass_ = mass_.cwiseSqrt();
  diagonal_ = mass_;
  for (std::size_t i = 0; i < n_unknowns_; ++i)
    diagonal_[static_cast<Eigen::Index>(i)] *= problem_.shift + problem_.of_mass[entry_of_unknown_[i] % 3];
}

/// Computes the Cholesky factor L of B_own, the block of B = K + s M + γ GᵀG for the own entries of the cell. Sets
/// cell.coupling to L⁻¹B_own,shared. Sets the lower triangle of `schur` to that of B_shared − couplingᵀ coupling. Here
/// B_shared does not contain the entries of diagonal_, which `factorize` adds. Returns false if B_own is not positive
/// definite.
bool ParitySector::condense(Cell& cell, unsigned int number, Eigen::MatrixXd& schur) const {
  const auto n_own = static_cast<Eigen::Index>(cell.own.size()),
             n_shared = static_cast<Eigen::Index>(cell.shared.size());
  Eigen::MatrixXd B = problem_.stiffness[number](cell.free, cell.free);
  if (problem_.incompressible) {
    cell.constraint = problem_.constraint[number](Eigen::all, cell.free);
    B.selfadjointView<Eigen::Lower>().rankUpdate(cell.constraint.transpose(), problem_.penalty);
  }
  for (Eigen::Index i = 0; i < n_own; ++i) B(i, i) += diagonal_[cell.unknown[i]];
  cell.own_factor.compute(B.topLeftCorner(n_own, n_own));
  cell.coupling = B.bottomLeftCorner(n_shared, n_own).transpose();
  cell.own_factor.matrixL().solveInPlace(cell.coupling);
  schur = B.bottomRightCorner(n_shared, n_shared);
  if (n_own > 0) schur.selfadjointView<Eigen::Lower>().rankUpdate(cell.coupling.transpose(), -1);
  return cell.own_factor.info() == Eigen::Success;
}

mechanics::Status ParitySector::factorize() {
  beyond_cells_ = problem_.beyond_cells(*this);
  const auto first = static_cast<Eigen::Index>(first_interface_), n = static_cast<Eigen::Index>(n_unknowns_) - first;
  Eigen::MatrixXd dense = n <= n_dense ? Eigen::MatrixXd::Zero(n, n).eval() : Eigen::MatrixXd();
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](Eigen::Index i, Eigen::Index j, double value) {  // i, j: unknowns between cells, i >= j
    if (n <= n_dense)
      dense(i, j) += value;
    else
      entries.emplace_back(static_cast<int>(i), static_cast<int>(j), value);
  };
  bool regular = true;
  for (unsigned int c = 0; c < cells_.size(); ++c) {
    Cell& cell = cells_[c];
    Eigen::MatrixXd schur;
    regular = condense(cell, c, schur) && regular;
    const Eigen::Index* shared = cell.unknown.data() + cell.own.size();
    for (Eigen::Index j = 0; j < schur.cols(); ++j)
      for (Eigen::Index i = j; i < schur.rows(); ++i) {
        const auto [low, high] = std::minmax({shared[i] - first, shared[j] - first});
        add(high, low, schur(i, j));
      }
  }
  for (Eigen::Index i = 0; i < n; ++i) add(i, i, diagonal_[first + i]);
  const auto& coupled = beyond_cells_.unknowns;
  for (std::size_t j = 0; j < coupled.size(); ++j)
    for (std::size_t i = j; i < coupled.size(); ++i)
      add(coupled[i] - first, coupled[j] - first,
          beyond_cells_.matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
  if (n <= n_dense) {
    interface_->dense.compute(dense);
    regular = regular && interface_->dense.info() == Eigen::Success;
  } else {
    Eigen::SparseMatrix<double> sparse(n, n);
    sparse.setFromTriplets(entries.begin(), entries.end());
    interface_->sparse.compute(sparse);
    regular = regular && interface_->sparse.info() == Eigen::Success;
  }
  if (regular) return {};
  return mechanics::Status::failure("the ball is not stable in this state: its stiffness is not positive");
}

template <int n>
void ParitySector::scatter_add(const Cell& cell, const Columns<n>& local, Columns<n>& u) const {
  for (std::size_t i = 0; i < cell.unknown.size(); ++i)
    u.row(cell.unknown[i]) += local.row(static_cast<Eigen::Index>(i));
}

template <int n>
void ParitySector::solve_penalized(Columns<n>& f) const {
  const auto first = static_cast<Eigen::Index>(first_interface_), size = static_cast<Eigen::Index>(n_unknowns_) - first;
  for (const Cell& cell : cells_) {
    if (cell.own.empty()) continue;
    auto own = f.middleRows(cell.unknown[0], static_cast<Eigen::Index>(cell.own.size()));
    cell.own_factor.matrixL().solveInPlace(own);
    const Columns<n> reaction = cell.coupling.transpose() * own;
    for (Eigen::Index i = 0; i < reaction.rows(); ++i) f.row(cell.unknown[cell.own.size() + i]) -= reaction.row(i);
  }
  auto between = f.bottomRows(size);
  if (size <= n_dense)
    interface_->dense.solveInPlace(between);
  else
    between = interface_->sparse.solve(Columns<n>(between));
  for (const Cell& cell : cells_) {
    if (cell.own.empty()) continue;
    auto own = f.middleRows(cell.unknown[0], static_cast<Eigen::Index>(cell.own.size()));
    Columns<n> shared(static_cast<Eigen::Index>(cell.shared.size()), f.cols());
    for (Eigen::Index i = 0; i < shared.rows(); ++i) shared.row(i) = f.row(cell.unknown[cell.own.size() + i]);
    own.noalias() -= cell.coupling * shared;
    cell.own_factor.matrixU().solveInPlace(own);
  }
}

template void ParitySector::solve_penalized<1>(Eigen::VectorXd& f) const;

template <int n>
ParitySector::Columns<n> ParitySector::constraint_of(const Columns<n>& u) const {
  const auto n_of_cell = static_cast<Eigen::Index>(problem_.space.n_pressure());
  Columns<n> h(static_cast<Eigen::Index>(cells_.size()) * n_of_cell, u.cols());
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const Columns<n> local = u(cells_[c].unknown, Eigen::all);
    h.middleRows(static_cast<Eigen::Index>(c) * n_of_cell, n_of_cell).noalias() = cells_[c].constraint * local;
  }
  return h;
}

template <int n>
ParitySector::Columns<n> ParitySector::reaction_of(const Columns<n>& lambda) const {
  const auto n_of_cell = static_cast<Eigen::Index>(problem_.space.n_pressure());
  Columns<n> f = Columns<n>::Zero(static_cast<Eigen::Index>(n_unknowns_), lambda.cols());
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const Columns<n> local =
        cells_[c].constraint.transpose() * lambda.middleRows(static_cast<Eigen::Index>(c) * n_of_cell, n_of_cell);
    scatter_add<n>(cells_[c], local, f);
  }
  return f;
}

template <int n>
ParitySector::Columns<n> ParitySector::solve_cells(Columns<n> f, int n_corrections) const {
  solve_penalized<n>(f);
  if (!problem_.incompressible) return f;
  for (int correction = 0; correction < n_corrections; ++correction) {
    Columns<n> reaction = reaction_of<n>(problem_.penalty * constraint_of<n>(f));
    solve_penalized<n>(reaction);
    f -= reaction;
  }
  return f;
}

mechanics::Status ParitySector::solve_definite(const Eigen::VectorXd& f, int n_corrections, double tolerance,
                                               Eigen::VectorXd& u) const {
  if (!iterates()) {
    u = solve_cells<1>(f, n_corrections);
    return {};
  }
  u = Eigen::VectorXd::Zero(f.size());
  Eigen::VectorXd r = f, z = solve_cells<1>(r, n_corrections), p = z;
  // B_p is the vector B p, except for a term Gᵀμ with some multiplier μ. The products of this term with p and z are 0,
  // because G p = G z = 0.
  Eigen::VectorXd B_p = r;
  double rz = r.dot(z);
  const double enough = tolerance * tolerance * rz;
  for (int iteration = 0; !(rz <= enough); ++iteration) {
    const Eigen::VectorXd A_p = B_p + beyond_cells_.product(p);
    const double curvature = p.dot(A_p);
    if (iteration == n_iterations_of_gradients || !(curvature > 0) || !std::isfinite(rz))
      return mechanics::Status::failure("the stiffness cannot be inverted: the ball is unstable");
    const double step = rz / curvature;
    u += step * p;
    r -= step * A_p;
    z = solve_cells<1>(r, n_corrections);
    const double next = r.dot(z), beta = next / rz;
    p = z + beta * p;
    B_p = r + beta * B_p;
    rz = next;
  }
  return {};
}

mechanics::Status ParitySector::solve_all(const Eigen::MatrixXd& f, int n_corrections, double tolerance,
                                          Eigen::MatrixXd& u) const {
  if (f.cols() > 0 && !iterates()) {
    u = solve_cells<Eigen::Dynamic>(f, n_corrections);
    return {};
  }
  u.resize(f.rows(), f.cols());
  for (Eigen::Index k = 0; k < f.cols(); ++k) {
    Eigen::VectorXd column;
    if (auto status = solve_definite(f.col(k), n_corrections, tolerance, column); !status) return status;
    u.col(k) = column;
  }
  return {};
}

Eigen::MatrixXd ParitySector::product(const Eigen::MatrixXd& u) const {
  Eigen::MatrixXd f = diagonal_.asDiagonal() * u;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const Cell& cell = cells_[c];
    Eigen::MatrixXd local = Eigen::MatrixXd::Zero(problem_.stiffness[c].rows(), u.cols());
    local(cell.free, Eigen::all) = u(cell.unknown, Eigen::all);
    local = (problem_.stiffness[c] * local).eval();
    scatter_add<Eigen::Dynamic>(cell, local(cell.free, Eigen::all), f);
  }
  for (Eigen::Index k = 0; iterates() && k < u.cols(); ++k) f.col(k) += beyond_cells_.product(u.col(k));
  const auto& coupled = beyond_cells_.unknowns;
  if (!coupled.empty()) f(coupled, Eigen::all) += beyond_cells_.matrix * u(coupled, Eigen::all);
  return f;
}

Eigen::VectorXd ParitySector::with_volume(const Eigen::VectorXd& h) const {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(n_unknowns_));
  if (!problem_.incompressible) return u;
  for (int correction = 0; correction < n_corrections_of_response; ++correction) {
    Eigen::VectorXd part = reaction_of<1>(problem_.penalty * (h - constraint_of<1>(u)));
    solve_penalized<1>(part);
    u += part;
  }
  return u;
}

Eigen::VectorXd ParitySector::without_volume(const Eigen::VectorXd& u) const {
  if (!problem_.incompressible) return u;
  return u - with_volume(constraint_of<1>(u));
}

mechanics::SolveReport ParitySector::solve(const Eigen::VectorXd& f, const Eigen::VectorXd& h, double tolerance,
                                           Eigen::VectorXd& u, Eigen::VectorXd& lambda) const {
  const auto n = static_cast<Eigen::Index>(n_unknowns_);
  const LinearOperator preconditioned = [&](std::span<const double> in, std::span<double> out) -> mechanics::Status {
    const Eigen::Map<const Eigen::VectorXd> change(in.data(), n);
    Eigen::VectorXd force = beyond_cells_.product(change);
    solve_penalized<1>(force);
    Eigen::Map<Eigen::VectorXd>(out.data(), n) = change + force;
    return {};
  };
  u = Eigen::VectorXd::Zero(n);
  lambda = Eigen::VectorXd::Zero(h.size());
  Eigen::VectorXd rest = f, rest_of_constraint = h;
  mechanics::SolveReport report;
  for (int step = 0; step < n_steps_of_multiplier; ++step) {
    if (problem_.incompressible) rest += reaction_of<1>(problem_.penalty * rest_of_constraint);
    solve_penalized<1>(rest);
    if (iterates()) {
      std::vector<double> change;
      const mechanics::SolveReport of_step = solve_by_gmres(preconditioned, {rest.begin(), rest.end()}, tolerance,
                                                            tolerance * u.norm(), n_iterations_of_gmres, change);
      report.iterations += of_step.iterations;
      if (!of_step.status) return {of_step.status, report.iterations};
      rest = Eigen::Map<const Eigen::VectorXd>(change.data(), n);
    }
    u += rest;
    if (!problem_.incompressible) break;
    const bool is_last = rest.norm() <= tolerance * u.norm();
    rest_of_constraint -= constraint_of<1>(rest);
    lambda += problem_.penalty * rest_of_constraint;
    if (is_last) break;
    rest.setZero();
  }
  return report;
}

mechanics::Status ParitySector::apply(const Eigen::MatrixXd& y, Eigen::MatrixXd& z) const {
  const int n_corrections = iterates() ? n_corrections_of_mode : n_corrections_of_operator;
  if (auto status = solve_all(root_mass_.asDiagonal() * y, n_corrections, tolerance_of_operator, z); !status)
    return status;
  z = root_mass_.asDiagonal() * z;
  return {};
}

mechanics::Status ParitySector::modes_of(const Eigen::MatrixXd& y, Modes& modes) const {
  if (auto status = solve_all(root_mass_.asDiagonal() * y, n_corrections_of_mode, tolerance_of_operator, modes.u);
      !status)
    return status;
  const Eigen::MatrixXd K_u = product(modes.u);
  modes.omega_squared.resize(y.cols());
  for (Eigen::Index k = 0; k < y.cols(); ++k) {
    const auto u = modes.u.col(k);
    modes.omega_squared[k] = u.dot(K_u.col(k)) / u.dot(mass_.cwiseProduct(u)) - problem_.shift;
  }
  return {};
}

mechanics::Status ParitySector::respond(const Eigen::MatrixXd& f, Eigen::MatrixXd& u) const {
  return solve_all(f, n_corrections_of_response, tolerance_of_response, u);
}

Eigen::VectorXd ParitySector::entries_of(const Vector& field) const {
  Eigen::VectorXd entries(static_cast<Eigen::Index>(n_unknowns_));
  for (std::size_t i = 0; i < n_unknowns_; ++i)
    entries[static_cast<Eigen::Index>(i)] = field.local_element(entry_of_unknown_[i]);
  return entries;
}

Vector ParitySector::field_of(const Eigen::VectorXd& u) const {
  Vector field = problem_.space.make_vector();
  for (std::size_t i = 0; i < n_unknowns_; ++i)
    field.local_element(entry_of_unknown_[i]) = u[static_cast<Eigen::Index>(i)];
  return field;
}

}  // namespace pseudorigid::continuum
