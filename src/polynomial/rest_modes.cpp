#include "polynomial/rest_modes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

#include "materials/rest_moduli.h"
#include "mechanics/core/dense_algebra.h"
#include "mechanics/equilibria/mode_groups.h"
#include "polynomial/compressible_body.h"
#include "polynomial/incompressible_body.h"
#include "polynomial/octant_quadrature.h"
#include "polynomial/parity_parts.h"
#include "polynomial/turns.h"

namespace pseudorigid::polynomial {
namespace {

struct Mode {
  mechanics::ClassifiedMode known;
  double share;
  Eigen::VectorXd shape;
};

/// Rows ∮(u·n) Y_nm dS, each times the root of its stiffness ρg (1 − 3/(2n + 1)); those of n ≤ 1 are 0.
Eigen::MatrixXd gravity_rows(const PolynomialSpace& space, double gravity_constant) {
  const int N = space.degree(), n_harmonics = (N + 2) * (N + 2);
  const double weight_of_density = 4 * std::numbers::pi / 3 * gravity_constant;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(n_harmonics, space.n_unknowns());
  for (const SurfacePoint& point : octant_surface_points((N + 3) / 2))  // exact for the degree 2N + 2
    for (int image = 0; image < n_parities; ++image) {
      std::array<double, 3> xi = point.xi;
      for (int i = 0; i < 3; ++i)
        if (image >> i & 1) xi[i] = -xi[i];
      const std::vector<Jet> functions = space.functions_at(xi);
      Eigen::RowVectorXd normal(space.n_unknowns());
      for (int i = 0; i < 3; ++i)
        for (int a = 0; a < space.n_functions(); ++a) normal[space.place(i, a)] = xi[i] * functions[a].value;
      const auto harmonics = solid_harmonics(N + 1, xi);
      for (int n = 2; n <= N + 1; ++n)
        for (int m = 0; m <= 2 * n; ++m)
          rows.row(n * n + m) +=
              point.weight * std::sqrt(weight_of_density * (1 - 3 / (2.0 * n + 1))) * harmonics[n][m].value * normal;
    }
  return rows;
}

/// The rigid motions, a row each; one that is turned or shifted has a parity.
Eigen::MatrixXd rigid_motions(const PolynomialSpace& space, const Turns& turns, const Eigen::VectorXd& X) {
  Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(6, space.n_unknowns());
  for (int i = 0; i < 3; ++i) {
    rigid(i, space.place(i, 0)) = 1;
    rigid.row(3 + i) = turns.of_space(i, X).normalized();
  }
  return rigid;
}

/// The modes of a parity: of K on the motions that `excluded`, rows of constraints and rigid motions, leaves.
class ModesOfParity {
 public:
  ModesOfParity(const Turns& turns, Parity parity, const std::vector<int>& unknowns)
      : turns_(turns), unknowns_(unknowns), n_odd_(std::popcount(parity)) {}

  void add(const Eigen::MatrixXd& K, const Eigen::MatrixXd& excluded, std::vector<Mode>& modes) const {
    Eigen::MatrixXd basis = Eigen::MatrixXd::Identity(K.rows(), K.cols());
    constexpr double dependent = 1e-8;  // the least singular value of G is 3.14 at any degree
    if (excluded.rows() > 0) basis = mechanics::null_space(excluded, dependent);
    if (basis.cols() == 0) return;
    const mechanics::SymmetricSpectrum degrees = mechanics::symmetric_spectrum(basis.transpose() * square(basis));
    const auto spectrum = mechanics::symmetric_spectrum(basis.transpose() * K * basis);
    for (Eigen::Index i = 0; i < spectrum.values.size(); ++i)
      modes.push_back(classified(spectrum.values[i], basis * spectrum.vectors.col(i),
                                 degrees.vectors.transpose() * spectrum.vectors.col(i), degrees.values));
  }

 private:
  Eigen::VectorXd whole(const Eigen::VectorXd& part) const {
    Eigen::VectorXd u = Eigen::VectorXd::Zero(turns_.n_unknowns());
    u(unknowns_) = part;
    return u;
  }

  /// The square of the rotations of fields, one column each.
  Eigen::MatrixXd square(const Eigen::MatrixXd& fields) const {
    Eigen::MatrixXd squares(fields.rows(), fields.cols());
    for (Eigen::Index j = 0; j < fields.cols(); ++j) squares.col(j) = turns_.square(whole(fields.col(j)))(unknowns_);
    return squares;
  }

  /// `parts`: the coefficients of the mode in motions with the squares n(n + 1).
  Mode classified(double omega_squared, const Eigen::VectorXd& shape, const Eigen::VectorXd& parts,
                  const Eigen::VectorXd& squares) const {
    std::vector<double> shares;
    for (Eigen::Index k = 0; k < squares.size(); ++k) {
      const auto n = static_cast<std::size_t>(std::lround(std::sqrt(std::max(squares[k], 0.0) + 0.25) - 0.5));
      if (shares.size() <= n) shares.resize(n + 1, 0);
      shares[n] += parts[k] * parts[k];
    }
    const auto largest = std::ranges::max_element(shares);
    const int degree = static_cast<int>(largest - shares.begin());
    return {{omega_squared, n_odd_ % 2 == degree % 2, degree}, *largest, whole(shape)};
  }

  const Turns& turns_;
  const std::vector<int>& unknowns_;
  int n_odd_;
};

mechanics::Status grouped(std::vector<Mode> modes, std::vector<RestFrequency>& frequencies) {
  std::vector<mechanics::ClassifiedMode> known;
  for (const Mode& mode : modes) known.push_back(mode.known);
  frequencies.clear();
  for (const mechanics::ModeGroup& group : mechanics::group_modes(known)) {
    if (!group.complete())
      return mechanics::Status::failure(
          "the modes cannot be sorted by kind and degree: their degrees are mixed, so that copies are missing");
    double share = 1;
    for (const std::size_t mode : group.modes) share = std::min(share, modes[mode].share);
    frequencies.push_back({group.omega, group.least, group.largest, group.spheroidal, group.degree, group.overtone,
                           share, std::move(modes[group.modes.front()].shape)});
  }
  std::ranges::stable_sort(frequencies, {}, &RestFrequency::omega);
  return {};
}

/// λ at rest, and the remainder of the force of the law.
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
  constexpr double balanced = 1e-6;  // relative to the modulus: a stress at rest is of the order of the modulus, and
                                     // smaller values are round-off
  if (f.template lpNorm<Eigen::Infinity>() > balanced * std::abs(shear_modulus))
    return mechanics::Status::failure("the body is in no equilibrium at rest: its law is not free of stress there");
  return {};
}

template <class Body>
mechanics::Status find(const Body& body, double gravity_constant, std::vector<RestFrequency>& frequencies) {
  const PolynomialSpace& space = body.space();
  const bool incompressible = !mechanics::unconstrained<Body>;
  const Eigen::VectorXd X = body.affine(Eigen::Matrix3d::Identity());
  Eigen::VectorXd lambda;
  if (auto status = at_rest(body, materials::moduli_at_rest(body.law(), incompressible).shear, lambda); !status)
    return status;
  const Eigen::MatrixXd K = stiffness_by_parity(space, [&](const Eigen::VectorXd& u) {
    Eigen::VectorXd rate = body.make_vector();
    body.add_force_rate(X, u, rate);
    if constexpr (!mechanics::unconstrained<Body>) body.add_reaction_rate(X, u, lambda, rate);
    return rate;
  });
  const Turns turns(space);
  const Eigen::MatrixXd rigid = rigid_motions(space, turns, X);
  const Eigen::MatrixXd gravity = gravity_rows(space, gravity_constant);
  Eigen::MatrixXd G;
  if constexpr (!mechanics::unconstrained<Body>) G = constraint_matrix(space, X);
  const auto unknowns = unknowns_by_parity(space), pressures = pressures_by_parity(space);
  std::vector<Mode> modes;
  for (Parity parity = 0; parity < n_parities; ++parity) {
    const std::vector<int>& of_parity = unknowns[parity];
    std::vector<int> of_rigid;
    for (int i = 0; i < 6; ++i)
      if (!rigid.row(i)(of_parity).isZero(0)) of_rigid.push_back(i);
    const auto n_constraints = static_cast<Eigen::Index>(incompressible ? pressures[parity].size() : 0);
    Eigen::MatrixXd excluded(n_constraints + static_cast<Eigen::Index>(of_rigid.size()),
                             static_cast<Eigen::Index>(of_parity.size()));
    if (incompressible) excluded.topRows(n_constraints) = G(pressures[parity], of_parity);
    excluded.bottomRows(excluded.rows() - n_constraints) = rigid(of_rigid, of_parity);
    const Eigen::MatrixXd of_gravity = gravity(Eigen::all, of_parity);
    ModesOfParity(turns, parity, of_parity)
        .add(K(of_parity, of_parity) + of_gravity.transpose() * of_gravity, excluded, modes);
  }
  return grouped(std::move(modes), frequencies);
}

}  // namespace

mechanics::Status rest_frequencies(BodySetup setup, bool incompressible, std::size_t number,
                                   std::vector<RestFrequency>& frequencies) {
  setup.reflect = {};
  const double gravity_constant = loads::constant_forcing(setup.loads).gravity_constant;
  setup.loads.get<loads::SelfGravity>().constant = 0;
  mechanics::Status status = incompressible ? find(IncompressibleBody(setup), gravity_constant, frequencies)
                                            : find(CompressibleBody(setup), gravity_constant, frequencies);
  if (frequencies.size() > number) frequencies.resize(number);
  return status;
}

}  // namespace pseudorigid::polynomial
