#include "polynomial/love_numbers.h"

#include <Eigen/Core>
#include <algorithm>
#include <map>
#include <numbers>

#include "mechanics/core/dense_algebra.h"
#include "polynomial/rest_problem.h"

namespace pseudorigid::polynomial {
namespace {

/// The parity of the displacement u under the tide V = Y_nm (parity_parts.h). Like ∂V/∂x_i, u_i is even in x_i if V is
/// odd in x_i. Therefore bit i is set if V is odd in x_i.
Parity parity_of_tide(int n, int m) { return BallPolynomial{n, n, m}.parity(); }

/// Static responses u = B (BᵀKB)⁻¹ Bᵀ f to forces f. K is the stiffness, and the columns of B are a basis of the
/// motions of one parity. The responses are valid only if is_stable() is true. `problem` must outlive this object.
class RestResponse {
 public:
  RestResponse(const RestProblem& problem, Parity parity)
      : unknowns_(problem.unknowns[parity]), motions_(problem.motions_of(parity)) {
    factor_.compute(motions_.transpose() * problem.stiffness_of(parity) * motions_);
  }

  bool is_stable() const { return factor_.is_valid(); }
  /// Returns the integrals ∮(u·e) Y_nm dS and ∮u·∇Y_nm dS of the response u to the force f = radialᵀ. `radial` and
  /// `tangential` are the rows of the harmonic Y_nm in SurfaceRows.
  Eigen::Vector2d operator()(const Eigen::RowVectorXd& radial, const Eigen::RowVectorXd& tangential) const {
    const Eigen::VectorXd f = radial(unknowns_).transpose();
    Eigen::VectorXd y = motions_.transpose() * f;
    factor_.solve_in_place(y);
    const Eigen::VectorXd u = motions_ * y;
    return {f.dot(u), tangential(unknowns_).dot(u)};
  }

 private:
  const std::vector<int>& unknowns_;
  Eigen::MatrixXd motions_;
  mechanics::CholeskyFactor factor_;
};

}  // namespace

mechanics::Status love_numbers(BodySetup setup, const std::vector<int>& degrees,
                               std::vector<gravity::LoveNumbers>& numbers) {
  setup.reflect = {};
  const double gravity_constant = loads::constant_forcing(setup.loads).gravity_constant;
  setup.loads.get<loads::SelfGravity>().constant = 0;
  const IncompressibleBody body(setup);
  const Turns turns(body.space());
  RestProblem problem;
  if (auto status = make_rest_problem(body, turns, gravity_constant, problem); !status) return status;
  const double g = 4 * std::numbers::pi / 3 * gravity_constant;
  const SurfaceRows rows = surface_rows(body.space(), std::ranges::max(degrees));
  std::map<Parity, RestResponse> responses;
  numbers.clear();
  for (const int n : degrees) {
    if (n > setup.degree + 1) {  // radial displacements of the surface in P_N have at most the degree N + 1
      numbers.push_back({n, 0, 0});
      continue;
    }
    constexpr int zonal = 0;
    const Parity parity = parity_of_tide(n, zonal);
    const auto response = responses.try_emplace(parity, problem, parity).first;
    if (!response->second.is_stable()) return mechanics::Status::failure("the ball at rest is unstable");
    const int row = n * n + n + zonal;
    const Eigen::Vector2d u = response->second(rows.radial.row(row), rows.tangential.row(row));
    numbers.push_back({n, g * u[0], g * u[1] / (n * (n + 1.0))});
  }
  return {};
}

}  // namespace pseudorigid::polynomial
