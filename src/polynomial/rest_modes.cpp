#include "polynomial/rest_modes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "mechanics/core/dense_algebra.h"
#include "polynomial/compressible_body.h"
#include "polynomial/incompressible_body.h"

namespace pseudorigid::polynomial {
namespace {

struct Mode {
  double omega;
  bool spheroidal;
  int degree;
  Eigen::VectorXd shape;
};

/// Columns of K.
template <class Body>
Eigen::MatrixXd stiffness(const Body& body, const Eigen::VectorXd& X, const Eigen::VectorXd& lambda) {
  const Eigen::Index n = X.size();
  Eigen::MatrixXd K(n, n);
  Eigen::VectorXd column(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    column.setZero();
    const Eigen::VectorXd u = Eigen::VectorXd::Unit(n, j);
    body.add_force_rate(X, u, column);
    if constexpr (!mechanics::unconstrained<Body>) body.add_reaction_rate(X, u, lambda, column);
    K.col(j) = -column;
  }
  return 0.5 * (K + K.transpose());
}

/// Unknowns and constraints of the motions of a parity.
struct Part {
  std::vector<int> unknowns, constraints;
};
Part part_of(const PolynomialSpace& space, Parity parity) {
  const auto add = [](const Block& block, std::vector<int>& places) {
    for (int a = 0; a < block.n(); ++a) places.push_back(block.offset + a);
  };
  Part part;
  for (const Block& block : space.blocks())
    if ((block.parity ^ 1U << block.component) == parity) add(block, part.unknowns);
  for (const Block& block : space.pressure_blocks())
    if (block.parity == parity) add(block, part.constraints);
  return part;
}

/// ∫(u·ξ)² over ∫|u|²|ξ|².
double radial_share(const PolynomialSpace& space, const Eigen::VectorXd& shape) {
  const PointValues u = space.values_at_points(shape);
  double radial = 0, whole = 0;
  for (int p = 0; p < space.n_points(); ++p) {
    const Eigen::RowVector3d xi(space.points()[p].data());
    radial += space.weights()[p] * std::pow(u.row(p).dot(xi), 2);
    whole += space.weights()[p] * u.row(p).squaredNorm() * xi.squaredNorm();
  }
  return radial / whole;
}

/// Toroidal motions of degree n have no part along ξ, and l = n. Spheroidal ones have l = n ± 1; of the highest degrees
/// the polynomials hold only l = n − 1, and a radial motion, n = 0, has l = 1 alone.
Mode classified(const PolynomialSpace& space, double omega, Eigen::VectorXd shape) {
  const std::vector<BallPolynomial> functions = ball_polynomials(space.degree());
  Eigen::VectorXd share = Eigen::VectorXd::Zero(space.degree() + 2);
  for (int i = 0; i < 3; ++i)
    for (std::size_t a = 0; a < functions.size(); ++a)
      if (const int at = space.place(i, static_cast<int>(a)); at >= 0) share[functions[a].l] += shape[at] * shape[at];
  constexpr double absent = 1e-8;  // shares that are there are of order 1; the others are round-off and aliasing
  int least = -1, largest = 0;
  for (int l = 0; l < share.size(); ++l)
    if (share[l] > absent * share.sum()) {
      if (least < 0) least = l;
      largest = l;
    }
  if (radial_share(space, shape) < absent) return {omega, false, least, std::move(shape)};
  if (largest > least) return {omega, true, (least + largest) / 2, std::move(shape)};
  const double dilation = std::abs(space.affine_part(shape).trace());  // of order 1, or round-off
  const bool is_radial = least == 1 && dilation > 1e-6;
  return {omega, true, is_radial ? 0 : least + 1, std::move(shape)};
}

/// Adds the modes of a parity.
void add_modes(const PolynomialSpace& space, const Eigen::MatrixXd& K, const Eigen::MatrixXd& G, Parity parity,
               std::vector<Mode>& modes) {
  const Part part = part_of(space, parity);
  const auto n = static_cast<Eigen::Index>(part.unknowns.size());
  Eigen::MatrixXd basis = Eigen::MatrixXd::Identity(n, n);
  constexpr double dependent = 1e-8;  // the least singular value of G is 3.14 at any degree
  if (!part.constraints.empty() && G.size() > 0)
    basis = mechanics::null_space(G(part.constraints, part.unknowns), dependent);
  if (basis.cols() == 0) return;
  const auto spectrum = mechanics::symmetric_spectrum(basis.transpose() * K(part.unknowns, part.unknowns) * basis);
  constexpr double rigid = 1e-6;  // of ω²: rigid motions have round-off
  for (Eigen::Index i = 0; i < spectrum.values.size(); ++i) {
    if (spectrum.values[i] < rigid) continue;
    Eigen::VectorXd shape = Eigen::VectorXd::Zero(space.n_unknowns());
    shape(part.unknowns) = basis * spectrum.vectors.col(i);
    modes.push_back(classified(space, std::sqrt(spectrum.values[i]), std::move(shape)));
  }
}

/// The 2n + 1 lowest modes of a kind and degree are its fundamental, the next its first overtone, and so on.
std::vector<RestFrequency> grouped(std::vector<Mode> modes) {
  std::ranges::stable_sort(modes, {}, &Mode::omega);
  std::map<std::pair<bool, int>, std::vector<const Mode*>> classes;
  for (const Mode& mode : modes) classes[{mode.spheroidal, mode.degree}].push_back(&mode);
  std::vector<RestFrequency> frequencies;
  for (const auto& [kind, members] : classes) {
    const std::size_t copies = 2 * static_cast<std::size_t>(kind.second) + 1;
    for (std::size_t first = 0; first + copies <= members.size(); first += copies) {
      double mean = 0;
      for (std::size_t i = first; i < first + copies; ++i) mean += members[i]->omega / static_cast<double>(copies);
      frequencies.push_back({mean, members[first]->omega, members[first + copies - 1]->omega, kind.first, kind.second,
                             static_cast<int>(first / copies), members[first]->shape});
    }
  }
  std::ranges::stable_sort(frequencies, {}, &RestFrequency::omega);
  return frequencies;
}

template <class Body>
mechanics::Status find(const Body& body, std::vector<RestFrequency>& frequencies) {
  const Eigen::VectorXd X = body.affine(Eigen::Matrix3d::Identity());
  Eigen::VectorXd f = body.make_vector(), lambda;
  Eigen::MatrixXd G;
  auto workspace = body.make_workspace();
  if (auto status = body.force(0, X, body.make_vector(), workspace, f); !status) return status;
  if constexpr (!mechanics::unconstrained<Body>) {
    lambda = body.make_multiplier();
    const mechanics::State<Body> rest{0, X, body.make_vector()};
    if (auto status = mechanics::multiplier_of_motion(body, rest, workspace, lambda); !status) return status;
    body.add_reaction(X, lambda, f);
    G = constraint_matrix(body.space(), X);
  }
  // The quadrature of gravity leaves up to 1e-5; a stress at rest is of order 1.
  constexpr double balanced = 1e-4;
  if (f.template lpNorm<Eigen::Infinity>() > balanced)
    return mechanics::Status::failure("the body is in no equilibrium at rest: its law is not free of stress there");
  const Eigen::MatrixXd K = stiffness(body, X, lambda);
  std::vector<Mode> modes;
  for (Parity parity = 0; parity < 8; ++parity) add_modes(body.space(), K, G, parity, modes);
  frequencies = grouped(std::move(modes));
  return {};
}

}  // namespace

mechanics::Status rest_frequencies(BodySetup setup, bool incompressible, std::size_t number,
                                   std::vector<RestFrequency>& frequencies) {
  setup.reflect = {};
  mechanics::Status status =
      incompressible ? find(IncompressibleBody(setup), frequencies) : find(CompressibleBody(setup), frequencies);
  if (frequencies.size() > number) frequencies.resize(number);
  return status;
}

}  // namespace pseudorigid::polynomial
