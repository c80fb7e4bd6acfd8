#include "polynomial/steady_rotation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "materials/fluid.h"
#include "mechanics/core/dense_algebra.h"
#include "polynomial/constraint.h"
#include "polynomial/gram_solver.h"

namespace pseudorigid::polynomial {
namespace {

constexpr std::array<bool, 3> octant{true, true, true};

/// Index of φ_nlm in `functions`.
int number_of(const std::vector<BallPolynomial>& functions, int n, int l, int m) {
  const auto found =
      std::ranges::find_if(functions, [&](const BallPolynomial& f) { return f.n == n && f.l == l && f.m == m; });
  return static_cast<int>(found - functions.begin());
}

/// The matrix U (steady_rotation.h). Its columns are an orthonormal basis of the permitted positions up to `degree`.
Eigen::MatrixXd figure_fields(const PolynomialSpace& space, Figure figure, int degree) {
  const std::vector<BallPolynomial> functions = ball_polynomials(space.degree());
  std::vector<Eigen::VectorXd> fields;
  const auto add_field = [&](std::initializer_list<int> places) {
    fields.emplace_back(Eigen::VectorXd::Zero(space.n_unknowns()));
    for (const int at : places) fields.back()[at] = 1 / std::sqrt(static_cast<double>(places.size()));
  };
  for (std::size_t a = 0; a < functions.size(); ++a) {
    const auto& [n, l, m] = functions[a];
    if (n > degree) continue;
    const int function = static_cast<int>(a);
    if (figure == Figure::ellipsoid) {
      for (int i = 0; i < 3; ++i)
        if (space.place(i, function) >= 0) add_field({space.place(i, function)});
    } else if (m == 0 && space.place(2, function) >= 0) {
      add_field({space.place(2, function)});
    } else if (m == 1 && space.place(0, function) >= 0) {
      add_field({space.place(0, function), space.place(1, number_of(functions, n, l, -1))});
    }
  }
  Eigen::MatrixXd U(space.n_unknowns(), static_cast<Eigen::Index>(fields.size()));
  for (std::size_t k = 0; k < fields.size(); ++k) U.col(static_cast<Eigen::Index>(k)) = fields[k];
  return U;
}

/// The matrix V (steady_rotation.h). Its columns are the permitted pressure functions up to `degree`, or none if
/// `degree` is −1.
Eigen::MatrixXd figure_pressures(const PolynomialSpace& space, Figure figure, int degree) {
  const std::vector<BallPolynomial> functions = ball_polynomials(space.degree());
  std::vector<int> places;
  for (std::size_t b = 0; b < functions.size(); ++b)
    if (const int at = space.pressure_place(static_cast<int>(b));
        at >= 0 && functions[b].n <= degree && (figure == Figure::ellipsoid || functions[b].m == 0))
      places.push_back(at);
  Eigen::MatrixXd V = Eigen::MatrixXd::Zero(space.n_pressures(), static_cast<Eigen::Index>(places.size()));
  for (std::size_t k = 0; k < places.size(); ++k) V(places[k], static_cast<Eigen::Index>(k)) = 1;
  return V;
}

double largest(const Eigen::VectorXd& x) { return x.size() == 0 ? 0 : x.lpNorm<Eigen::Infinity>(); }

}  // namespace

BodySetup conservative_setup(BodySetup setup, bool incompressible) {
  setup.loads = loads::Loads(setup.loads.get<loads::SelfGravity>(), setup.loads.get<loads::Pressure>());
  if (incompressible) setup.loads = loads::at_constant_volume(setup.loads);
  return setup;
}

Eigen::VectorXd across_axis_3(const PolynomialSpace& space, Eigen::VectorXd x) {
  for (int a = 0; a < space.n_functions(); ++a)
    if (const int at = space.place(2, a); at >= 0) x[at] = 0;
  return x;
}

SteadyRotations::SteadyRotations(const BodySetup& setup, bool incompressible, Figure figure)
    : incompressible_(incompressible), is_fluid_(std::holds_alternative<materials::Fluid>(setup.law)) {
  BodySetup in_octant = conservative_setup(setup, incompressible);
  in_octant.reflect = octant;
  body_ = std::make_shared<CompressibleBody>(in_octant);
  const PolynomialSpace& space = body_->space();
  U_ = figure_fields(space, figure, is_fluid_ ? 1 : space.degree());
  V_ = figure_pressures(space, figure, !incompressible ? -1 : is_fluid_ ? 0 : space.degree());
}

EquilibriumFigure SteadyRotations::affine(const Eigen::Vector3d& a, double spin_squared) const {
  return {body_->affine(a.asDiagonal()), Eigen::VectorXd::Zero(body_->space().n_pressures()), spin_squared};
}

mechanics::Status SteadyRotations::terms(const EquilibriumFigure& rotation, Eigen::VectorXd& f,
                                         Eigen::VectorXd& centrifugal, Eigen::VectorXd& reaction) const {
  f = reaction = body_->make_vector();
  CompressibleBody::Workspace none;
  if (auto status = body_->force(0, rotation.x, body_->make_vector(), none, f); !status) return status;
  centrifugal = rotation.drive * across_axis_3(body_->space(), rotation.x);
  if (incompressible_) add_reaction(body_->space(), rotation.x, rotation.lambda, reaction);
  return {};
}

/// Derivatives of the residual r = f + Ω²Px + Gᵀλ (steady_rotation.h) along the columns of U, one in each column.
Eigen::MatrixXd SteadyRotations::tangent_matrix(const EquilibriumFigure& rotation) const {
  Eigen::MatrixXd D(U_.rows(), U_.cols());
  for (Eigen::Index j = 0; j < U_.cols(); ++j) {
    const Eigen::VectorXd u = U_.col(j);
    Eigen::VectorXd column = rotation.drive * across_axis_3(body_->space(), u);
    body_->add_force_rate(rotation.x, u, column);
    if (incompressible_) add_reaction_rate(body_->space(), rotation.x, u, rotation.lambda, column);
    D.col(j) = column;
  }
  return D;
}

mechanics::Status SteadyRotations::equations(const FigureCondition& condition, const EquilibriumFigure& rotation,
                                             Equations& result) const {
  Eigen::VectorXd f, centrifugal, reaction;
  if (auto status = terms(rotation, f, centrifugal, reaction); !status) return status;
  const Eigen::Index n = U_.cols(), m = V_.cols();
  result.scale = 1 + std::max({largest(f), largest(centrifugal), largest(reaction)});
  result.values = Eigen::VectorXd::Zero(n + m + 1);
  result.derivative = Eigen::MatrixXd::Zero(n + m + 1, n + m + 1);
  result.values.head(n) = U_.transpose() * (f + centrifugal + reaction);
  result.derivative.topLeftCorner(n, n) = U_.transpose() * tangent_matrix(rotation);
  result.derivative.topRightCorner(n, 1) = U_.transpose() * across_axis_3(body_->space(), rotation.x);
  if (m > 0) {
    Eigen::VectorXd g = Eigen::VectorXd::Zero(body_->space().n_pressures());
    (void)constraint(body_->space(), rotation.x,
                     g);  // the evaluation of the force has shown that the body is admissible
    const Eigen::MatrixXd G = V_.transpose() * constraint_matrix(body_->space(), rotation.x) * U_;
    result.values.segment(n, m) = V_.transpose() * g;
    result.derivative.block(n, 0, m, n) = G;
    result.derivative.block(0, n, n, m) = G.transpose();
  }
  add_condition(condition, rotation, result);
  return {};
}

/// Sets the last equation and its derivative. This equation is the condition with the value v. For the parameter Ω²,
/// the equation is Ω² − v = 0. For the logarithm of a ratio of axes, it is a_k − exp(v) a₁ = 0 with the diagonal
/// entries a of the affine part of x.
void SteadyRotations::add_condition(const FigureCondition& condition, const EquilibriumFigure& rotation,
                                    Equations& result) const {
  const Eigen::Index last = result.values.size() - 1;
  if (condition.parameter == FigureParameter::drive) {
    result.values[last] = rotation.drive - condition.value;
    result.derivative(last, last) = 1;
    return;
  }
  const int k = mechanics::other_axis(condition.parameter);
  const double ratio = std::exp(condition.value);
  const auto difference = [&](const Eigen::VectorXd& x) {
    const Eigen::Matrix3d A = body_->space().affine_part(x);
    return A(k, k) - ratio * A(0, 0);
  };
  result.values[last] = difference(rotation.x);
  for (Eigen::Index j = 0; j < U_.cols(); ++j) result.derivative(last, j) = difference(U_.col(j));
}

EquilibriumFigure SteadyRotations::change(const Eigen::VectorXd& step) const {
  const Eigen::Index n = U_.cols(), m = V_.cols();
  EquilibriumFigure change{U_ * step.head(n), Eigen::VectorXd::Zero(body_->space().n_pressures()), step[n + m]};
  if (m > 0) change.lambda = V_ * step.segment(n, m);
  return change;
}

mechanics::Status SteadyRotations::newton(const FigureCondition& condition, EquilibriumFigure& rotation) const {
  constexpr int max_iterations = 40, max_halvings = 12;
  constexpr double accepted = 1e-11;
  EquilibriumFigure kept = rotation;
  double best = std::numeric_limits<double>::infinity(), scale = 1;
  for (int i = 0; i < max_iterations; ++i) {
    Equations e;
    if (auto status = equations(condition, rotation, e); !status) return status;
    const double size = largest(e.values);
    if (!std::isfinite(size) || !e.derivative.allFinite()) break;
    if (size >= 0.5 * best && best <= accepted * scale) break;  // a small residual that does not halve is round-off
    if (size < best) best = size, scale = e.scale, kept = rotation;
    if (size == 0) break;
    const Eigen::VectorXd step = mechanics::solve(e.derivative, -e.values);
    if (!step.allFinite()) break;
    const EquilibriumFigure full = change(step);
    double factor = 1;
    for (int k = 0; k < max_halvings && !body_->admissible(rotation.x + factor * full.x); ++k) factor /= 2;
    mechanics::add(factor, full, rotation);
  }
  rotation = kept;
  if (best <= accepted * scale) return {};
  return mechanics::Status::failure(
      "Newton's iteration finds no figure that turns steadily here; it ends with a residual of " +
      mechanics::six_digits(best / scale) + " of the terms");
}

/// Sets the multiplier λ of an incompressible fluid, and the residual of the equations relative to their largest term.
/// Fails if the force cannot be computed.
mechanics::Status SteadyRotations::complete(EquilibriumFigure& rotation) const {
  Eigen::VectorXd f, centrifugal, reaction;
  if (is_fluid_ && incompressible_) {
    if (auto status = terms(rotation, f, centrifugal, reaction); !status) return status;
    const Eigen::MatrixXd G = constraint_matrix(body_->space(), rotation.x);
    rotation.lambda = mechanics::solve(G * G.transpose(), -G * (f + centrifugal));
  }
  if (auto status = terms(rotation, f, centrifugal, reaction); !status) return status;
  const double scale = std::max({largest(f), largest(centrifugal), largest(reaction)});
  constexpr double round_off = 1e-13;  // if no term is larger than this bound, the residual counts as 0
  rotation.residual = scale > round_off ? largest(f + centrifugal + reaction) / scale : 0;
  return {};
}

EquilibriumFigure SteadyRotations::tangent(const FigureCondition& condition, const EquilibriumFigure& rotation) const {
  Equations e;
  if (!equations(condition, rotation, e))
    return change(Eigen::VectorXd::Constant(U_.cols() + V_.cols() + 1, std::numeric_limits<double>::quiet_NaN()));
  Eigen::VectorXd by_parameter = Eigen::VectorXd::Zero(e.values.size());
  by_parameter[e.values.size() - 1] = condition.parameter == FigureParameter::drive
                                          ? 1
                                          : std::exp(condition.value) * body_->space().affine_part(rotation.x)(0, 0);
  return change(mechanics::solve(e.derivative, by_parameter));
}

}  // namespace pseudorigid::polynomial
