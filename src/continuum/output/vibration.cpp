#include "continuum/output/vibration.h"

#include <deal.II/base/quadrature_lib.h>

#include <Eigen/Dense>

#include "continuum/parallel/ghost_values.h"

namespace pseudorigid::continuum {
namespace {

/// The number of quadrature points of a cell in each direction, minus the number of its nodes. The modes vary faster
/// than the basis functions if the mesh is not refined, so their integrals need more points.
constexpr int n_more_points = 4;

/// Number of local nodes, including the additional nodes and the ghost nodes.
Eigen::Index n_local_nodes(const Vector& u) {
  const auto& partitioner = *u.get_partitioner();
  return (partitioner.locally_owned_size() + partitioner.n_ghost_indices()) / 3;
}

/// The values of u at all local nodes, with one column for each node. The ghost values of u must be up to date.
Eigen::Matrix3Xd at_nodes(const Vector& u) {
  Eigen::Matrix3Xd values(3, n_local_nodes(u));
  for (Eigen::Index i = 0; i < values.size(); ++i) values(i) = u.local_element(static_cast<unsigned int>(i));
  return values;
}

/// The values and derivatives of the basis functions of a cell at Gauss points, and the weights of the points. A row
/// belongs to a function, and a column to a point. For functions and points, the first direction is the fastest index.
struct CellRule {
  explicit CellRule(const ReferenceCell& ref) {
    const dealii::QGauss<1> rule(static_cast<unsigned int>(ref.n + n_more_points));
    const auto n_points = static_cast<Eigen::Index>(rule.size());
    Eigen::MatrixXd value(ref.n, n_points), slope = value;
    for (Eigen::Index p = 0; p < n_points; ++p)
      for (int i = 0; i < ref.n; ++i) {
        const double xi = rule.point(static_cast<unsigned int>(p))[0];
        value(i, p) = lagrange(ref.nodes, i, xi);
        slope(i, p) = lagrange_derivative(ref.nodes, i, xi);
      }
    const auto product = [](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const Eigen::MatrixXd& c) {
      Eigen::MatrixXd result(a.rows() * b.rows() * c.rows(), a.cols() * b.cols() * c.cols());
      for (Eigen::Index column = 0; column < result.cols(); ++column)
        for (Eigen::Index row = 0; row < result.rows(); ++row)
          result(row, column) = a(row % a.rows(), column % a.cols()) *
                                b(row / a.rows() % b.rows(), column / a.cols() % b.cols()) *
                                c(row / a.rows() / b.rows(), column / a.cols() / b.cols());
      return result;
    };
    Eigen::MatrixXd weight(1, n_points);
    for (Eigen::Index p = 0; p < n_points; ++p) weight(0, p) = rule.weight(static_cast<unsigned int>(p));
    values = product(value, value, value);
    slopes = {product(slope, value, value), product(value, slope, value), product(value, value, slope)};
    weights = product(weight, weight, weight);
  }
  Eigen::MatrixXd values;
  std::array<Eigen::MatrixXd, 3> slopes;
  Eigen::RowVectorXd weights;
};

}  // namespace

mechanics::Vibration vibration_of(const BallBody& ball) {
  const BallSpace& space = ball.space();
  const mechanics::SpheroidalMotions motions(space.mesh().sector().reflect);
  const Eigen::Matrix3Xd X = at_nodes(space.reference_positions());
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(motions.size(), X.size());
  const CellRule rule(space.reference_cell());
  const Eigen::Index n_points = rule.weights.size();
  Eigen::MatrixXd at_points(3 * motions.size(), n_points);
  for (const auto& nodes : space.cells()) {
    const Eigen::Matrix3Xd corners = X(Eigen::all, nodes), positions = corners * rule.values;
    for (Eigen::Index p = 0; p < n_points; ++p) {
      Eigen::Matrix3d gradient;
      for (int d = 0; d < 3; ++d) gradient.col(d) = corners * rule.slopes[d].col(p);
      at_points.col(p) = rule.weights[p] * gradient.determinant() * motions.at(positions.col(p)).reshaped();
    }
    const Eigen::MatrixXd of_nodes = at_points * rule.values.transpose();
    for (std::size_t i = 0; i < nodes.size(); ++i)
      products.middleCols<3>(3 * static_cast<Eigen::Index>(nodes[i])) +=
          of_nodes.col(static_cast<Eigen::Index>(i)).reshaped(motions.size(), 3);
  }
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(X.cols());
  for (unsigned int node = 0; node < space.n_nodes(); ++node) masses[node] = space.mass().local_element(3 * node);
  return {motions, X, masses, products};
}

mechanics::VibrationObservables observe_vibration(const BallBody& ball, const mechanics::Vibration& vibration,
                                                  const BallState& state,
                                                  const mechanics::ContinuumObservables& known) {
  const GhostValues of_q(state.q), of_v(state.v);
  const Eigen::Matrix3Xd x = at_nodes(state.q).colwise() - known.center;
  const Eigen::Matrix3Xd v = at_nodes(state.v).colwise() - known.velocity;
  const Eigen::VectorXd own = vibration.sums(x, v, known.Q, known.Qdot);
  Eigen::VectorXd sums(own.size());
  const auto size = static_cast<std::size_t>(own.size());
  dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(own.data(), size), ball.space().communicator(),
                              dealii::ArrayView<double>(sums.data(), size));
  return vibration.observables(sums, known.elastic);
}

}  // namespace pseudorigid::continuum
