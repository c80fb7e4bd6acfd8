#include "mechanics/core/gauss_stages.h"

#include "mechanics/core/gauss_kernels.h"

namespace pseudorigid::mechanics {
namespace {

void split(gauss::Real x, double& high, double& low) {
  high = static_cast<double>(x);
  low = static_cast<double>(x - high);
}

/// Returns the matrix with the entries ℓ_j(1 + r c_i) in row i and column j, with the Lagrange polynomials ℓ_j and the
/// nodes c_i of the stages. The matrix extrapolates the accelerations of a step to the stages of a next step that is r
/// times as long.
constexpr gauss::Matrix ahead(gauss::Real r) {
  gauss::Matrix l{};
  for (std::size_t i = 0; i < gauss::n_stages; ++i) l[i] = gauss::lagrange(1 + r * gauss::c[i]);
  return l;
}
/// The matrix `ahead` for a next step of the same length, which is the most frequent case.
constexpr gauss::Matrix equally_ahead = ahead(1);

}  // namespace

void GaussTables::set_step(double step) {
  h = step;
  const gauss::Real exact_h = h;
  for (std::size_t j = 0; j < gauss::n_stages; ++j) {
    for (std::size_t i = 0; i < gauss::n_stages; ++i) {
      split(exact_h * gauss::a[i][j], a[j][i], a_low[j][i]);
      split(exact_h * exact_h * gauss::a_squared[i][j], a_squared[j][i], a_squared_low[j][i]);
    }
    split(exact_h * gauss::c[j], c[j], c_low[j]);
    const gauss::Real of_v = exact_h * gauss::b[j], of_q = of_v * exact_h * (1 - gauss::c[j]);
    sums[j] = {};
    split(of_v, sums[j][velocity], sums[j][velocity_low]);
    split(of_q, sums[j][position], sums[j][position_low]);
    sums[j][legendre_6] = static_cast<double>(gauss::detail::expansions[j][6]);
    sums[j][legendre_7] = static_cast<double>(gauss::detail::expansions[j][7]);
  }
}

void GaussTables::set_ratio(double r) {
  ratio = r;
  const gauss::Matrix l = r == 1 ? equally_ahead : ahead(r);
  for (std::size_t i = 0; i < gauss::n_stages; ++i)
    for (std::size_t j = 0; j < gauss::n_stages; ++j) guess[j][i] = static_cast<double>(l[i][j]);
}

void solve_gauss_stages(const GaussField& field, GaussStages& stages) {
  static const GaussKernels& kernels = *choose_build(builds_of_gauss_kernels()).table;
  kernels.solve(field, stages);
}

}  // namespace pseudorigid::mechanics
