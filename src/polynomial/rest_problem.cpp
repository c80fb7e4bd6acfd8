#include "polynomial/rest_problem.h"

#include <cmath>
#include <numbers>

#include "materials/rest_moduli.h"
#include "mechanics/core/dense_algebra.h"
#include "polynomial/octant_quadrature.h"

namespace pseudorigid::polynomial {
namespace {

/// The rows ∮(u·e) Y_nm dS of the self-gravity (rest_problem.h) in units with ρ = r = 1. Each row is multiplied by the
/// square root of its stiffness ρg (1 − 3/(2n + 1)). The rows with n ≤ 1 are 0.
Eigen::MatrixXd gravity_rows(const PolynomialSpace& space, double gravity_constant) {
  const int max_degree = space.degree() + 1;
  const double weight_of_density = 4 * std::numbers::pi / 3 * gravity_constant;
  Eigen::MatrixXd rows = surface_rows(space, max_degree).radial;
  for (int n = 0; n <= max_degree; ++n)
    rows.middleRows(n * n, 2 * n + 1) *= n < 2 ? 0 : std::sqrt(weight_of_density * (1 - 3 / (2.0 * n + 1)));
  return rows;
}

/// Coefficients of the six rigid motions, with norm 1, one motion in each row. Each of these motions has a parity.
Eigen::MatrixXd rigid_motions(const PolynomialSpace& space, const Turns& turns, const Eigen::VectorXd& X) {
  Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(6, space.n_unknowns());
  for (int i = 0; i < 3; ++i) {
    rigid(i, space.place(i, 0)) = 1;
    rigid.row(3 + i) = turns.of_space(i, X).normalized();
  }
  return rigid;
}

/// Sets λ to the multiplier at rest if the body is incompressible. Fails if the forces on the body at rest are not
/// balanced, or if the forces or the multiplier cannot be computed.
template <class Body>
mechanics::Status at_rest(const Body& body, double shear_modulus, Eigen::VectorXd& lambda) {
  const Eigen::VectorXd X = body.affine(Eigen::Matrix3d::Identity());
  Eigen::VectorXd f = body.make_vector();
  auto workspace = body.make_workspace();
  if (auto status = body.force(0, X, body.make_vector(), workspace, f); !status) return status;
  if constexpr (!mechanics::unconstrained<Body>) {
    lambda = body.make_multiplier();
    const mechanics::State<Body> rest{0, X, body.make_vector()};
    if (auto status = mechanics::multiplier_of_motion(body, rest, workspace, lambda); !status) return status;
    body.add_reaction(X, lambda, f);
  }
  // Bound of the forces relative to the shear modulus. The forces of a stress at rest are of the order of the modulus.
  // Forces below the bound are round-off.
  constexpr double balanced = 1e-6;
  if (f.template lpNorm<Eigen::Infinity>() > balanced * std::abs(shear_modulus))
    return mechanics::Status::failure("the body is in no equilibrium at rest: its law is not free of stress there");
  return {};
}

template <class Body>
mechanics::Status make(const Body& body, const Turns& turns, double gravity_constant, RestProblem& problem) {
  constexpr bool incompressible = !mechanics::unconstrained<Body>;
  const PolynomialSpace& space = body.space();
  const Eigen::VectorXd X = body.affine(Eigen::Matrix3d::Identity());
  Eigen::VectorXd lambda;
  if (auto status = at_rest(body, materials::moduli_at_rest(body.law(), incompressible).shear, lambda); !status)
    return status;
  problem.stiffness = stiffness_by_parity(space, [&](const Eigen::VectorXd& u) {
    Eigen::VectorXd rate = body.make_vector();
    body.add_force_rate(X, u, rate);
    if constexpr (incompressible) body.add_reaction_rate(X, u, lambda, rate);
    return rate;
  });
  if (gravity_constant != 0) {
    const Eigen::MatrixXd gravity = gravity_rows(space, gravity_constant);
    problem.stiffness += gravity.transpose() * gravity;
  }
  problem.unknowns = unknowns_by_parity(space);
  Eigen::MatrixXd G(0, space.n_unknowns());
  if constexpr (incompressible) {
    G = constraint_matrix(space, X);
    problem.rows = pressures_by_parity(space);
  }
  const Eigen::MatrixXd rigid = rigid_motions(space, turns, X);
  for (Parity parity = 0; parity < n_parities; ++parity)
    for (int i = 0; i < 6; ++i)
      if (!rigid.row(i)(problem.unknowns[parity]).isZero(0))
        problem.rows[parity].push_back(static_cast<int>(G.rows()) + i);
  problem.excluded.resize(G.rows() + 6, space.n_unknowns());
  problem.excluded << G, rigid;
  return {};
}

}  // namespace

Eigen::MatrixXd RestProblem::motions_of(Parity parity) const {
  const auto n = static_cast<Eigen::Index>(unknowns[parity].size());
  if (rows[parity].empty()) return Eigen::MatrixXd::Identity(n, n);
  constexpr double dependent = 1e-8;  // measurements give 3.14 for the least singular value of G at every degree
  return mechanics::null_space(excluded(rows[parity], unknowns[parity]), dependent);
}

SurfaceRows surface_rows(const PolynomialSpace& space, int max_degree) {
  const int n_harmonics = (max_degree + 1) * (max_degree + 1), n_exact = space.degree() + max_degree + 1;
  SurfaceRows rows{Eigen::MatrixXd::Zero(n_harmonics, space.n_unknowns()),
                   Eigen::MatrixXd::Zero(n_harmonics, space.n_unknowns())};
  Eigen::RowVectorXd component(space.n_functions());
  Eigen::VectorXd radial(n_harmonics), tangential(n_harmonics);
  for (const SurfacePoint& point : octant_surface_points((n_exact + 4) / 4))  // q points are exact to degree 4q − 1
    for (int image = 0; image < n_parities; ++image) {
      std::array<double, 3> xi = point.xi;
      for (int i = 0; i < 3; ++i)
        if (image >> i & 1) xi[i] = -xi[i];
      const std::vector<Jet> functions = space.functions_at(xi);
      const auto harmonics = solid_harmonics(max_degree, xi);
      for (int i = 0; i < 3; ++i) {
        const int first = i * space.n_functions();  // the whole ball has every function in every component
        for (int a = 0; a < space.n_functions(); ++a)
          component[space.place(i, a) - first] = point.weight * functions[a].value;
        for (int n = 0; n <= max_degree; ++n)
          for (int m = 0; m <= 2 * n; ++m) {
            const Jet& Y = harmonics[n][m];
            radial[n * n + m] = Y.value * xi[i];
            tangential[n * n + m] = Y.gradient[i] - n * Y.value * xi[i];
          }
        rows.radial.middleCols(first, space.n_functions()) += radial * component;
        rows.tangential.middleCols(first, space.n_functions()) += tangential * component;
      }
    }
  return rows;
}

mechanics::Status make_rest_problem(const IncompressibleBody& body, const Turns& turns, double gravity_constant,
                                    RestProblem& problem) {
  return make(body, turns, gravity_constant, problem);
}
mechanics::Status make_rest_problem(const CompressibleBody& body, const Turns& turns, double gravity_constant,
                                    RestProblem& problem) {
  return make(body, turns, gravity_constant, problem);
}

}  // namespace pseudorigid::polynomial
