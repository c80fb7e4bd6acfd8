#pragma once
/// An isochoric motion x(X, t) with a pressure λ(X, t), and the load that makes it the exact motion of a ball:
///
///   load(φ) = ∫ρ ẍ·φ dX + ∫(P(F) − λF⁻ᵀ):∇φ dX   =   ∫ρ b·φ dX + ∮ t·φ dA,
///   ρ b = ρ ẍ − Div(P − λF⁻ᵀ),   t = (P − λF⁻ᵀ) N,
///
/// a body force and a traction on the free surface, in the weak form in which the elements take them. The motion is
/// composed of three shears and stretches whose gradients are triangular up to the order of coordinates:
///
///   (X, Y, Z) → (X e^{g(Z)}, Y e^{−g(Z)}, Z),   and cyclically,   g(Z) = a(t) cos Z,   a(t) = A (1 − cos ωt),
///
/// so det F = 1 everywhere, the coordinate planes stay planes (an octant is enough), and the motion starts from rest.

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "continuum/balls.h"
#include "continuum/kernels/node_gradients.h"
#include "continuum/parallel/ghost_values.h"
#include "materials/eigen_tensor.h"
#include "mechanics/core/automatic_differentiation.h"

namespace pseudorigid::testing {

struct ManufacturedMotion {
  double amplitude = 0.25, omega = 6;

  template <class T>
  T a(T t) const {
    using std::cos;
    return T(amplitude * (1.0 - cos(omega * t)));
  }
  template <class T>
  Eigen::Matrix<T, 3, 1> position(Eigen::Matrix<T, 3, 1> x, const T& a) const {
    using std::cos, std::exp;
    for (int axis = 2; axis >= 0; --axis) {
      const T g = a * cos(x[axis]), stretch = exp(g);
      x[(axis + 1) % 3] = T(x[(axis + 1) % 3] * stretch);
      x[(axis + 2) % 3] = T(x[(axis + 2) % 3] / stretch);
    }
    return x;
  }
  Vector3d position(const Vector3d& X, double t) const { return position<double>(X, a(t)); }

  Vector3d acceleration(const Vector3d& X, double t) const {
    using Inner = mechanics::Dual<double, 1>;
    using Outer = mechanics::Dual<Inner, 1>;
    Outer time;
    time.value().value() = t;
    time.value().derivatives()[0] = 1;
    time.derivatives()[0].value() = 1;
    time.derivatives()[0].derivatives()[0] = 0;
    Eigen::Matrix<Outer, 3, 1> X_constant;
    for (int c = 0; c < 3; ++c) {
      X_constant[c].value().value() = X[c];
      X_constant[c].value().derivatives()[0] = 0;
      X_constant[c].derivatives()[0] = Inner(0);
    }
    const auto x = position<Outer>(X_constant, a(time));
    return {x[0].derivatives()[0].derivatives()[0], x[1].derivatives()[0].derivatives()[0],
            x[2].derivatives()[0].derivatives()[0]};
  }
  Matrix3d deformation_gradient(const Vector3d& X, double t) const {
    using Number = mechanics::Dual<double, 3>;
    const auto x = position<Number>(mechanics::independent<double, 3>(X), Number(a(t)));
    Matrix3d F;
    for (int i = 0; i < 3; ++i) F.row(i) = x[i].derivatives().transpose();
    return F;
  }
  double multiplier(const Vector3d& X, double t) const {
    return 0.3 + std::sin(4 * t) * std::cos(X[0]) * std::cos(X[1]) * std::cos(2 * X[2]);
  }
};

/// A ball under the load of a manufactured motion.
class ManufacturedBall {
 public:
  using Vector = ElasticBall::Vector;
  using Multiplier = ElasticBall::Multiplier;
  using Workspace = ElasticBall::Workspace;
  static constexpr int n_constraints = ElasticBall::n_constraints;

  ManufacturedBall(const Sector& sector, int degree, int n_refinements)
      : ball_(sector, degree, n_refinements, neo_hookean) {
    const auto& ref = ball_.space().reference_cell();
    const int n = ref.n, n_points = n * n * n;
    values_.resize(n_points, n_points);
    for (auto& table : derivatives_) table.resize(n_points, n_points);
    const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> I(
        ref.interpolate.data(), n, n),
        D_at_points(ref.differentiate.data(), n, n);
    const Eigen::MatrixXd D = D_at_points * I;
    for (int q = 0; q < n_points; ++q)
      for (int i = 0; i < n_points; ++i) {
        const int point[] = {q % n, q / n % n, q / n / n}, node[] = {i % n, i / n % n, i / n / n};
        const auto product = [&](int derivative) {
          double p = 1;
          for (int d = 0; d < 3; ++d) p *= (d == derivative ? D : I)(point[d], node[d]);
          return p;
        };
        values_(q, i) = product(3);
        for (int d = 0; d < 3; ++d) derivatives_[d](q, i) = product(d);
      }
    for (int q = 0; q < n_points; ++q)
      weights_.push_back(ref.point_weights[q % n] * ref.point_weights[q / n % n] * ref.point_weights[q / n / n]);
  }

  bool time_dependent() const { return true; }
  mechanics::Status force(double t, const Vector& x, const Vector& v, Workspace& w, Vector& f) const {
    if (auto status = ball_.force(t, x, v, w, f); !status) return status;
    add_load(t, f);
    return {};
  }
  void apply_inverse_mass(const Vector& f, Vector& a) const { ball_.apply_inverse_mass(f, a); }
  mechanics::Status constraint(const Vector& x, Multiplier& g) const { return ball_.constraint(x, g); }
  void constraint_rate(const Vector& x, const Vector& v, Multiplier& r) const { ball_.constraint_rate(x, v, r); }
  void constraint_curvature(const Vector& x, const Vector& v, Multiplier& r) const {
    ball_.constraint_curvature(x, v, r);
  }
  void add_reaction(const Vector& x, const Multiplier& lambda, Vector& f) const { ball_.add_reaction(x, lambda, f); }
  mechanics::SolveReport solve_gram(const Vector& x1, const Vector& x0, const Multiplier& r, Workspace& w,
                                    Multiplier& lambda) const {
    return ball_.solve_gram(x1, x0, r, w, lambda);
  }
  double constraint_tolerance() const { return ball_.constraint_tolerance(); }
  Vector make_vector() const { return ball_.make_vector(); }
  Multiplier make_multiplier() const { return ball_.make_multiplier(); }
  Workspace make_workspace() const { return ball_.make_workspace(); }

  State<ManufacturedBall> initial() const { return {0, ball_.affine_field(Matrix3d::Identity()), ball_.make_vector()}; }
  const ElasticBall& ball() const { return ball_; }

  /// |x_h − x|, |λ_h − λ| in L²(X) at the state's time.
  struct Errors {
    double position = 0, multiplier = 0;
  };
  Errors errors(const State<ManufacturedBall>& state, const Multiplier& lambda) const {
    Errors squares;
    std::vector<double> at_nodes(values_.rows());
    for (unsigned int cell = 0; cell < ball_.space().n_cells(); ++cell) {
      const Eigen::Matrix3Xd x = continuum::nodal_values(ball_.space(), state.q, cell) * values_.transpose();
      ball_.kernels().multiplier_at_nodes(lambda, cell, at_nodes);
      const Eigen::VectorXd lambda_h = values_ * Eigen::Map<const Eigen::VectorXd>(at_nodes.data(), values_.rows());
      for_each_point(cell, [&](int q, const Vector3d& X, const Matrix3d&, double weight) {
        squares.position += weight * (x.col(q) - motion_.position(X, state.t)).squaredNorm();
        squares.multiplier += weight * std::pow(lambda_h[q] - motion_.multiplier(X, state.t), 2);
      });
    }
    return {std::sqrt(squares.position), std::sqrt(squares.multiplier)};
  }

 private:
  /// `use(point, X, (∂X/∂ξ)⁻¹, weight)`
  template <class Use>
  void for_each_point(unsigned int cell, Use&& use) const {
    const Eigen::Matrix3Xd nodes = continuum::nodal_values(ball_.space(), ball_.space().reference_positions(), cell);
    const Eigen::Matrix3Xd X = nodes * values_.transpose();
    Eigen::Matrix3Xd columns[3];
    for (int d = 0; d < 3; ++d) columns[d] = nodes * derivatives_[d].transpose();
    for (int q = 0; q < X.cols(); ++q) {
      Matrix3d jacobian;
      jacobian << columns[0].col(q), columns[1].col(q), columns[2].col(q);
      use(q, X.col(q), jacobian.inverse(), weights_[q] * jacobian.determinant());
    }
  }

  void add_load(double t, Vector& f) const {
    const auto n_points = values_.rows();
    Eigen::Matrix3Xd body(3, n_points), stress[3];
    for (auto& s : stress) s.resize(3, n_points);
    for (unsigned int cell = 0; cell < ball_.space().n_cells(); ++cell) {
      for_each_point(cell, [&](int q, const Vector3d& X, const Matrix3d& inverse_jacobian, double weight) {
        const Matrix3d F = motion_.deformation_gradient(X, t);
        const Matrix3d P = materials::to_matrix(neo_hookean.stress(materials::to_tensor(F))) -
                           motion_.multiplier(X, t) * F.inverse().transpose();
        const Matrix3d pulled_back = weight * P * inverse_jacobian.transpose();
        for (int d = 0; d < 3; ++d) stress[d].col(q) = pulled_back.col(d);
        body.col(q) = weight * motion_.acceleration(X, t);
      });
      Eigen::Matrix3Xd load = body * values_;
      for (int d = 0; d < 3; ++d) load += stress[d] * derivatives_[d];
      const auto& nodes = ball_.space().cell_nodes(cell);
      for (std::size_t i = 0; i < nodes.size(); ++i)
        for (int c = 0; c < 3; ++c) f.local_element(3 * nodes[i] + c) += load(c, static_cast<Eigen::Index>(i));
    }
  }

  ElasticBall ball_;
  ManufacturedMotion motion_;
  Eigen::MatrixXd values_, derivatives_[3];  ///< shape functions at the Gauss points: [point, node]
  std::vector<double> weights_;
};

}  // namespace pseudorigid::testing
