#include "continuum/statics/multigrid_level.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "continuum/modes/krylov.h"
#include "continuum/parallel/ghost_values.h"
#include "continuum/statics/tangent_problem.h"

namespace pseudorigid::continuum {
namespace {

constexpr int n_smoothing_steps = 4;
constexpr double smoothing_range = 20;  // b/a
constexpr int n_lanczos_steps = 12;
constexpr double safety = 1.1;  // b over the estimate of the largest eigenvalue

}  // namespace

std::unique_ptr<StiffnessTangent> make_stiffness(const CellKernels& kernels, const StiffnessCoefficients& c) {
  return kernels.make_stiffness([&](unsigned int cell, std::span<double> values) {
    std::copy_n(c[cell].data(), c[cell].size(), values.begin());
  });
}

MultigridLevel::MultigridLevel(const BallBody& body)
    : space_(&body.space()), kernels_(&body.kernels()), cells_(*space_) {}

MultigridLevel::MultigridLevel(const Sector& sector, const StoredEnergy& stored, int n_refinements, int degree,
                               bool smooths, MPI_Comm communicator)
    : own_space_(std::make_unique<BallSpace>(BallMesh(sector, n_refinements, communicator), degree)),
      own_kernels_(smooths ? make_cell_kernels(*own_space_, stored) : nullptr),
      space_(own_space_.get()),
      kernels_(own_kernels_.get()),
      cells_(*space_) {}

mechanics::Status MultigridLevel::set(const StiffnessCoefficients& c, std::vector<FaceSprings> springs) {
  const MPI_Comm communicator = space_->communicator();
  springs_ = std::move(springs);
  has_springs_ = sum_over_ranks(static_cast<double>(springs_.size()), communicator) > 0;
  if (!kernels_) return {};
  inverse_diagonal_ = make_vector();
  for (unsigned int cell = 0; cell < space_->n_cells(); ++cell) {
    const Eigen::VectorXd of_cell = cells_.diagonal(c[cell]);
    for (Eigen::Index i = 0; i < of_cell.size(); ++i)
      inverse_diagonal_.local_element(space_->entry_of(cell, i)) += of_cell[i];
  }
  for (const FaceSprings& face : springs_)
    for (Eigen::Index i = 0; i < face.rows.cols(); ++i)
      inverse_diagonal_.local_element(space_->entry_of(face.cell, face.places[static_cast<std::size_t>(i)])) +=
          face.rows.col(i).squaredNorm();
  add_to_owners(inverse_diagonal_);
  bool is_positive = true;
  for (unsigned int i = 0; i < 3 * space_->n_nodes(); ++i) {
    double& d = inverse_diagonal_.local_element(i);
    is_positive = is_positive && d > 0;
    d = 1 / d;
  }
  if (least_over_ranks(is_positive ? 1 : 0, communicator) == 0)
    return mechanics::Status::failure("the stiffness has a diagonal entry that is not positive");
  space_->clear_fixed(inverse_diagonal_);
  stiffness_ = make_stiffness(*kernels_, c);
  return find_largest_eigenvalue();
}

mechanics::Status MultigridLevel::find_largest_eigenvalue() {
  Vector u = make_vector(), f = make_vector();
  const LinearOperator scaled = [&](std::span<const double> in, std::span<double> out) -> mechanics::Status {
    for (std::size_t i = 0; i < in.size(); ++i) u.begin()[i] = std::sqrt(inverse_diagonal_.begin()[i]) * in[i];
    product(u, f);
    for (std::size_t i = 0; i < in.size(); ++i) out[i] = std::sqrt(inverse_diagonal_.begin()[i]) * f.begin()[i];
    return {};
  };
  std::vector<double> start(u.locally_owned_size());  // irregular, so that it has a part of every eigenvector
  for (std::size_t i = 0; i < start.size(); ++i)
    start[i] = inverse_diagonal_.begin()[i] > 0 ? std::sin(static_cast<double>(i * i)) : 0;
  const auto status = estimate_largest_eigenvalue(scaled, start, n_lanczos_steps, largest_, space_->communicator());
  largest_ *= safety;
  return status;
}

void MultigridLevel::product(const Vector& u, Vector& f) const {
  kernels_->stiffness_product(*stiffness_, u, f);
  if (has_springs_) add_rate_of_springs(*space_, springs_, 1, u, f);
  space_->clear_fixed(f);
}

void MultigridLevel::residual(const Vector& f, const Vector& u, Vector& r) const {
  product(u, r);
  const double* force = f.begin();
  double* rest = r.begin();
  for (std::size_t i = 0, n = f.locally_owned_size(); i < n; ++i) rest[i] = force[i] - rest[i];
}

void MultigridLevel::smooth(const Vector& f, Vector& r, Vector& u) const {
  const double least = largest_ / smoothing_range, theta = (largest_ + least) / 2, delta = (largest_ - least) / 2;
  Vector change = make_vector();
  const double *D = inverse_diagonal_.begin(), *rest = r.begin();
  double *s = change.begin(), *to = u.begin();
  double rho = delta / theta, keep = 0, add = 1 / theta;
  for (int m = 0; m < n_smoothing_steps; ++m) {
    if (m > 0) {
      residual(f, u, r);
      const double next = 1 / (2 * theta / delta - rho);
      keep = next * rho, add = 2 * next / delta, rho = next;
    }
    for (std::size_t i = 0, n = f.locally_owned_size(); i < n; ++i) {
      s[i] = keep * s[i] + add * D[i] * rest[i];
      to[i] += s[i];
    }
  }
}

}  // namespace pseudorigid::continuum
