#include "polynomial/rest_modes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "mechanics/core/dense_algebra.h"
#include "mechanics/equilibria/mode_groups.h"
#include "polynomial/rest_problem.h"

namespace pseudorigid::polynomial {
namespace {

struct Mode {
  mechanics::ClassifiedMode known;
  double share;
  Eigen::VectorXd shape;
};

/// Computes the modes of a parity, and finds their kind and degree.
class ModesOfParity {
 public:
  ModesOfParity(const Turns& turns, Parity parity, const std::vector<int>& unknowns)
      : turns_(turns), unknowns_(unknowns), n_odd_(std::popcount(parity)) {}

  /// Appends the eigenmodes of the stiffness K to `modes`. The columns of `basis` are an orthonormal basis of the
  /// motions of the parity, and K is the stiffness for this parity.
  void add(const Eigen::MatrixXd& K, const Eigen::MatrixXd& basis, std::vector<Mode>& modes) const {
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

  /// The operator −Σ_e J_e² (turns.h), applied to fields. Each column is a field.
  Eigen::MatrixXd square(const Eigen::MatrixXd& fields) const {
    Eigen::MatrixXd squares(fields.rows(), fields.cols());
    for (Eigen::Index j = 0; j < fields.cols(); ++j) squares.col(j) = turns_.square(whole(fields.col(j)))(unknowns_);
    return squares;
  }

  /// Finds the kind and the degree n of a mode with the coefficients `shape`. `parts` are the components of the mode
  /// along the eigenvectors of −Σ_e J_e², and `squares` are the eigenvalues n(n + 1) of this operator.
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

template <class Body>
mechanics::Status find(const Body& body, double gravity_constant, std::vector<RestFrequency>& frequencies) {
  const Turns turns(body.space());
  RestProblem problem;
  if (auto status = make_rest_problem(body, turns, gravity_constant, problem); !status) return status;
  std::vector<Mode> modes;
  for (Parity parity = 0; parity < n_parities; ++parity)
    ModesOfParity(turns, parity, problem.unknowns[parity])
        .add(problem.stiffness_of(parity), problem.motions_of(parity), modes);
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
