#include "polynomial/body_figures.h"

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

/// The matrix U (body_figures.h). Its columns are an orthonormal basis of the permitted positions up to `degree`.
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

/// The matrix V (body_figures.h). Its columns are the permitted pressure functions up to `degree`, or none if
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

BodySetup acting_setup(const FigureSetup& setup) {
  BodySetup acting = setup.body;
  const loads::Loads& all = setup.body.loads;
  acting.loads = loads::Loads(all.get<loads::SelfGravity>(), all.get<loads::Pressure>());
  if (setup.drive == Drive::loads) {
    acting.loads.get<loads::Tide>() = all.get<loads::Tide>();
    acting.loads.get<loads::Traction>() = all.get<loads::Traction>();
  }
  if (setup.incompressible) acting.loads = loads::at_constant_volume(acting.loads);
  return acting;
}

Eigen::VectorXd across_axis_3(const PolynomialSpace& space, Eigen::VectorXd x) {
  for (int a = 0; a < space.n_functions(); ++a)
    if (const int at = space.place(2, a); at >= 0) x[at] = 0;
  return x;
}

FigureForces::FigureForces(const FigureSetup& setup, const std::array<bool, 3>& reflect) : drive_(setup.drive) {
  BodySetup body = acting_setup(setup);
  body.reflect = reflect;
  if (drive_ == Drive::loads) {
    BodySetup only_loads = body;
    only_loads.law = materials::Fluid{};
    only_loads.volumetric_stiffness = 0;
    only_loads.loads.get<loads::SelfGravity>() = {};
    load_body_ = std::make_shared<CompressibleBody>(only_loads);
    body.loads = loads::Loads(body.loads.get<loads::SelfGravity>());
  }
  body_ = std::make_shared<CompressibleBody>(body);
}

mechanics::Status FigureForces::evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& force,
                                         Eigen::VectorXd& load) const {
  const Eigen::VectorXd at_rest = body_->make_vector();
  force = load = at_rest;
  CompressibleBody::Workspace none;
  if (auto status = body_->force(0, x, at_rest, none, force); !status) return status;
  if (load_body_) return load_body_->force(0, x, at_rest, none, load);
  load = across_axis_3(body_->space(), x);
  return {};
}

Eigen::VectorXd FigureForces::rate(const Eigen::VectorXd& x, double nu, const Eigen::VectorXd& u) const {
  Eigen::VectorXd of_load = load_body_ ? body_->make_vector() : across_axis_3(body_->space(), u);
  if (load_body_) load_body_->add_force_rate(x, u, of_load);
  Eigen::VectorXd rate = nu * of_load;
  body_->add_force_rate(x, u, rate);
  return rate;
}

BodyFigures::BodyFigures(const FigureSetup& setup)
    : incompressible_(setup.incompressible),
      is_fluid_(std::holds_alternative<materials::Fluid>(setup.body.law)),
      error_of_drive_(1e-12 * (1 + setup.body.loads.get<loads::SelfGravity>().constant)),
      forces_(setup, octant) {
  U_ = figure_fields(space(), setup.figure, is_fluid_ ? 1 : space().degree());
  V_ = figure_pressures(space(), setup.figure, !incompressible_ ? -1 : is_fluid_ ? 0 : space().degree());
}

EquilibriumFigure BodyFigures::affine(const Eigen::Vector3d& a, double drive) const {
  return {body().affine(a.asDiagonal()), Eigen::VectorXd::Zero(space().n_pressures()), drive};
}

Eigen::VectorXd BodyFigures::Terms::residual(double nu) const { return force + nu * load + reaction; }
double BodyFigures::Terms::scale(double nu) const {
  return std::max({largest(force), std::abs(nu) * largest(load), largest(reaction)});
}

mechanics::Status BodyFigures::terms(const EquilibriumFigure& figure, Terms& terms) const {
  if (auto status = forces_.evaluate(figure.x, terms.force, terms.load); !status) return status;
  terms.reaction = body().make_vector();
  if (incompressible_) add_reaction(space(), figure.x, figure.lambda, terms.reaction);
  return {};
}

/// Derivatives of the residual r (body_figures.h) along the columns of U, one in each column.
Eigen::MatrixXd BodyFigures::tangent_matrix(const EquilibriumFigure& figure) const {
  Eigen::MatrixXd D(U_.rows(), U_.cols());
  for (Eigen::Index j = 0; j < U_.cols(); ++j) {
    Eigen::VectorXd column = forces_.rate(figure.x, figure.drive, U_.col(j));
    if (incompressible_) add_reaction_rate(space(), figure.x, U_.col(j), figure.lambda, column);
    D.col(j) = column;
  }
  return D;
}

mechanics::Status BodyFigures::equations(const FigureCondition& condition, const EquilibriumFigure& figure,
                                         Equations& result) const {
  Terms now;
  if (auto status = terms(figure, now); !status) return status;
  const Eigen::Index n = U_.cols(), m = V_.cols();
  result.scale = 1 + now.scale(figure.drive);
  result.values = Eigen::VectorXd::Zero(n + m + 1);
  result.derivative = Eigen::MatrixXd::Zero(n + m + 1, n + m + 1);
  result.values.head(n) = U_.transpose() * now.residual(figure.drive);
  result.derivative.topLeftCorner(n, n) = U_.transpose() * tangent_matrix(figure);
  result.derivative.topRightCorner(n, 1) = U_.transpose() * now.load;
  if (m > 0) {
    Eigen::VectorXd g = Eigen::VectorXd::Zero(space().n_pressures());
    (void)constraint(space(), figure.x,
                     g);  // the evaluation of the force has shown that the body is admissible
    const Eigen::MatrixXd G = V_.transpose() * constraint_matrix(space(), figure.x) * U_;
    result.values.segment(n, m) = V_.transpose() * g;
    result.derivative.block(n, 0, m, n) = G;
    result.derivative.block(0, n, n, m) = G.transpose();
  }
  add_condition(condition, figure, result);
  return {};
}

/// Sets the last equation and its derivative. This equation is the condition with the value v. For the drive ν,
/// the equation is ν − v = 0. For the logarithm of a ratio of axes, it is a_k − exp(v) a₁ = 0 with the diagonal
/// entries a of the affine part of x.
void BodyFigures::add_condition(const FigureCondition& condition, const EquilibriumFigure& figure,
                                Equations& result) const {
  const Eigen::Index last = result.values.size() - 1;
  if (condition.parameter == FigureParameter::drive) {
    result.values[last] = figure.drive - condition.value;
    result.derivative(last, last) = 1;
    return;
  }
  const int k = mechanics::other_axis(condition.parameter);
  const double ratio = std::exp(condition.value);
  const auto difference = [&](const Eigen::VectorXd& x) {
    const Eigen::Matrix3d A = space().affine_part(x);
    return A(k, k) - ratio * A(0, 0);
  };
  result.values[last] = difference(figure.x);
  for (Eigen::Index j = 0; j < U_.cols(); ++j) result.derivative(last, j) = difference(U_.col(j));
}

EquilibriumFigure BodyFigures::change(const Eigen::VectorXd& step) const {
  const Eigen::Index n = U_.cols(), m = V_.cols();
  EquilibriumFigure change{U_ * step.head(n), Eigen::VectorXd::Zero(space().n_pressures()), step[n + m]};
  if (m > 0) change.lambda = V_ * step.segment(n, m);
  return change;
}

mechanics::Status BodyFigures::newton(const FigureCondition& condition, EquilibriumFigure& figure) const {
  constexpr int max_iterations = 40, max_halvings = 12;
  constexpr double accepted = 1e-11;
  EquilibriumFigure kept = figure;
  double best = std::numeric_limits<double>::infinity(), scale = 1;
  for (int i = 0; i < max_iterations; ++i) {
    Equations e;
    if (auto status = equations(condition, figure, e); !status) return status;
    const double size = largest(e.values);
    if (!std::isfinite(size) || !e.derivative.allFinite()) break;
    if (size >= 0.5 * best && best <= accepted * scale) break;  // a small residual that does not halve is round-off
    if (size < best) best = size, scale = e.scale, kept = figure;
    if (size == 0) break;
    const Eigen::VectorXd step = mechanics::solve(e.derivative, -e.values);
    if (!step.allFinite()) break;
    const EquilibriumFigure full = change(step);
    double factor = 1;
    for (int k = 0; k < max_halvings && !is_admissible(figure.x + factor * full.x); ++k) factor /= 2;
    mechanics::add(factor, full, figure);
  }
  figure = kept;
  if (best <= accepted * scale) return {};
  return mechanics::Status::failure(
      "Newton's iteration finds no figure of equilibrium here; it ends with a residual of " +
      mechanics::six_digits(best / scale) + " of the terms");
}

/// Sets the multiplier λ of an incompressible fluid, and the residual of the equations relative to their largest term.
/// Fails if the force cannot be computed.
mechanics::Status BodyFigures::complete(EquilibriumFigure& figure) const {
  Terms now;
  if (is_fluid_ && incompressible_) {
    if (auto status = terms(figure, now); !status) return status;
    const Eigen::MatrixXd G = constraint_matrix(space(), figure.x);
    figure.lambda = mechanics::solve(G * G.transpose(), -G * (now.force + figure.drive * now.load));
  }
  if (auto status = terms(figure, now); !status) return status;
  const double scale = now.scale(figure.drive);
  constexpr double round_off = 1e-13;  // if no term is larger than this bound, the residual counts as 0
  figure.residual = scale > round_off ? largest(now.residual(figure.drive)) / scale : 0;
  return {};
}

EquilibriumFigure BodyFigures::tangent(const FigureCondition& condition, const EquilibriumFigure& figure,
                                       double /*tolerance*/) const {
  Equations e;
  if (!equations(condition, figure, e))
    return change(Eigen::VectorXd::Constant(U_.cols() + V_.cols() + 1, std::numeric_limits<double>::quiet_NaN()));
  Eigen::VectorXd by_parameter = Eigen::VectorXd::Zero(e.values.size());
  by_parameter[e.values.size() - 1] = condition.parameter == FigureParameter::drive
                                          ? 1
                                          : std::exp(condition.value) * space().affine_part(figure.x)(0, 0);
  return change(mechanics::solve(e.derivative, by_parameter));
}

}  // namespace pseudorigid::polynomial
