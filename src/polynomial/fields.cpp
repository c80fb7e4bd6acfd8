#include "polynomial/fields.h"

#include <array>
#include <cstddef>

#include "materials/point_fields.h"

namespace pseudorigid::polynomial {
namespace {

/// The multiplier λ at a point. `functions` has the values of the basis functions at this point, and `lambda` has the
/// coefficients of λ.
double multiplier_at(const PolynomialSpace& space, const std::vector<Jet>& functions, const Eigen::VectorXd& lambda) {
  double value = 0;
  for (std::size_t b = 0; b < functions.size(); ++b)
    if (const int at = space.pressure_place(static_cast<int>(b)); at >= 0) value += lambda[at] * functions[b].value;
  return value;
}

/// The least-squares approximation of Σ μ_b C_b⁻¹ by the functions φ_a of the space. Row a has the six coefficients of
/// φ_a, one for each entry (i, j) with i ≤ j. Branch b has the modulus μ_b and the internal metric C_b. If the motion
/// has symmetry planes, the entry (i, j) has the parity of x_i x_j under their reflections. Coefficients of functions
/// with another parity are then set to 0.
Eigen::MatrixXd coefficients_of_branches(const PolynomialBody& body, const Eigen::VectorXd& q) {
  const PolynomialSpace& space = body.space();
  constexpr std::array<std::array<int, 2>, 6> axes{{{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}};
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(space.n_functions(), 6);
  for (int p = 0; p < space.n_points(); ++p) {
    if (space.weights()[p] == 0) continue;
    const std::vector<Jet> functions = space.functions_at(space.points()[p]);
    const auto A = body.branches_at(q, p).inverse_sum;
    for (int a = 0; a < space.n_functions(); ++a)
      for (int k = 0; k < 6; ++k) sums(a, k) += space.weights()[p] * functions[a].value * A.a[k];
  }
  for (int a = 0; a < space.n_functions(); ++a)
    for (int k = 0; k < 6; ++k) {
      const Parity parity = (1U << axes[k][0]) ^ (1U << axes[k][1]);
      for (int i = 0; i < 3; ++i)
        if (space.reflect()[i] && ((parity ^ space.parity(a)) >> i & 1U) != 0) sums(a, k) = 0;
    }
  return sums;
}

materials::BranchesAtPoint branches_at(const std::vector<Jet>& functions, const Eigen::MatrixXd& coefficients,
                                       double sum_of_moduli) {
  materials::BranchesAtPoint branches{.sum_of_moduli = sum_of_moduli};
  for (Eigen::Index a = 0; a < coefficients.rows(); ++a)
    for (int k = 0; k < 6; ++k) branches.inverse_sum.a[k] += coefficients(a, k) * functions[a].value;
  return branches;
}

}  // namespace

FieldsAtPoints::FieldsAtPoints(const PolynomialSpace& space, const std::vector<Eigen::Vector3d>& points)
    : points_(points) {
  for (const Eigen::Vector3d& xi : points) functions_.push_back(space.functions_at({xi[0], xi[1], xi[2]}));
}

mechanics::Status FieldsAtPoints::fields(const PolynomialBody& body, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                         const Eigen::VectorXd& lambda, mechanics::BodyFields& fields) const {
  const PolynomialSpace& space = body.space();
  const auto x = q.head(space.n_unknowns()), u = v.head(space.n_unknowns());
  fields = {};
  fields.center = space.mean(x);
  fields.moment = space.affine_part(x) * space.inertia().asDiagonal();
  double mean_potential = 0;
  if (body.gravity()) {
    std::vector<Eigen::Vector3d> positions;
    for (const auto& functions : functions_) positions.push_back(space.value(functions, x));
    fields.potential = body.gravity()->potential(q, positions);
    mean_potential = 5.0 / 3 * body.gravity()->energy(q) / space.volume();
  }
  const double sum_of_moduli = materials::sum_of_moduli(body.constant_forcing().branches.list);
  const Eigen::MatrixXd of_branches = body.relaxes() ? coefficients_of_branches(body, q) : Eigen::MatrixXd(0, 6);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Eigen::Vector3d X = space.semi_axes().cwiseProduct(points_[i]);
    double pressure = lambda.size() > 0 ? multiplier_at(space, functions_[i], lambda) : 0;
    if (body.gravity()) pressure -= fields.potential[i] - mean_potential;
    if (auto status = materials::add_point(body.law(), X, space.value(functions_[i], x), space.value(functions_[i], u),
                                           space.gradient(functions_[i], x), pressure,
                                           branches_at(functions_[i], of_branches, sum_of_moduli), fields);
        !status)
      return status;
  }
  return {};
}

}  // namespace pseudorigid::polynomial
