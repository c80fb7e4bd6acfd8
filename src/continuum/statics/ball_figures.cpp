#include "continuum/statics/ball_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "continuum/mesh/nodes_by_place.h"
#include "materials/rest_moduli.h"

namespace pseudorigid::continuum {
namespace {

/// Smallest and largest relative tolerance of the linear equations of a step.
constexpr double least_tolerance = 1e-8, largest_tolerance = 1e-5;

constexpr std::array<bool, 3> octant{true, true, true};

loads::Loads acting_loads(const FigureSetup& setup) {
  if (setup.drive == Drive::loads) return setup.loads;
  return {setup.loads.get<loads::SelfGravity>(), setup.loads.get<loads::Pressure>()};
}

std::shared_ptr<const BallBody> make_body(const FigureSetup& setup, MPI_Comm communicator) {
  const Sector sector{octant};
  const loads::Loads loads = acting_loads(setup);
  if (setup.incompressible)
    return std::make_shared<ElasticBall>(sector, setup.degree, setup.n_refinements, setup.stored, loads, communicator);
  return std::make_shared<CompressibleBall>(sector, setup.degree, setup.n_refinements, setup.stored, loads,
                                            communicator);
}

loads::Forcing forcing_of(const FigureSetup& setup) {
  const loads::Loads loads = acting_loads(setup);
  return loads::constant_forcing(setup.incompressible ? loads::at_constant_volume(loads) : loads);
}

double largest(const Vector& v) { return v.size() == 0 ? 0 : v.linfty_norm(); }

/// The entries of a vector on this process, as a vector of Eigen.
Eigen::VectorXd entries(const Vector& v) {
  return Eigen::Map<const Eigen::VectorXd>(v.begin(), static_cast<Eigen::Index>(v.locally_owned_size()));
}

/// The vector with these entries and the shape of `shape`. If there are no entries, the result is `shape`.
Vector vector_of(const Eigen::VectorXd& entries, Vector shape) {
  std::ranges::copy(entries, shape.begin());
  return shape;
}

}  // namespace

BallFigures::BallFigures(const FigureSetup& setup, SectorRanks ranks)
    : stored_(setup.stored),
      incompressible_(setup.incompressible),
      kind_(setup.drive),
      n_refinements_(setup.n_refinements),
      watch_(setup.watch),
      ranks_(ranks),
      body_(make_body(setup, MPI_COMM_SELF)),
      forcing_(forcing_of(setup)) {
  const Vector rest = body_->make_vector(), none = multiplier(Eigen::VectorXd());
  if (ranks_.size() > 1 && !is_small(body_->space()) && uses_cycles(state(rest, none, 1)))
    shared_ = std::make_unique<SharedOctant>(make_body(setup, ranks_.communicator), body_->space());
  if (setup.figure == mechanics::Figure::spheroid) find_exchanged_nodes();
}

bool BallFigures::permits_rotation_of_space(int axis) const {
  return kind_ == Drive::rotation || loads::permits_rotation_of_space(forcing_, axis);
}

bool BallFigures::permits_rotation_of_ball(int axis) const {
  return kind_ == Drive::rotation || loads::permits_rotation_of_body(forcing_, axis);
}

bool BallFigures::is_symmetric_about(int axis, double drive) const {
  if (kind_ == Drive::rotation) return drive == 0 || (axis == 2 && !exchanged_.empty());
  return drive == 0 || loads::permits_joint_rotation(forcing_, axis);
}

void BallFigures::find_exchanged_nodes() {
  const BallSpace& space = body_->space();
  const NodesByPlace nodes(space);
  for (unsigned int node = 0; node < space.n_nodes(); ++node) {
    const Eigen::Vector3d X = reference_position(space, node);
    exchanged_.push_back(nodes.at({X[1], X[0], X[2]}));
  }
}

Vector BallFigures::exchanged(const Vector& u) const {
  Vector result = body_->make_vector();
  for (unsigned int node = 0; node < exchanged_.size(); ++node)
    for (unsigned int c = 0; c < 3; ++c)
      result.local_element(3 * node + c) = u.local_element(3 * exchanged_[node] + (c == 2 ? 2 : 1 - c));
  return result;
}

void BallFigures::symmetrize(Eigen::VectorXd& u) const {
  if (!is_symmetric_under_exchange()) return;
  const Vector image = exchanged(vector_of(u, body_->make_vector()));
  for (Eigen::Index i = 0; i < u.size(); ++i) u[i] = (u[i] + image.local_element(static_cast<unsigned int>(i))) / 2;
}

Vector BallFigures::positions(const Figure& figure) const { return vector_of(figure.x, body_->make_vector()); }

Vector BallFigures::multiplier(const Figure& figure) const {
  return vector_of(figure.lambda, body_->space().make_multiplier());
}

Vector BallFigures::field(const Eigen::VectorXd& x) const {
  return shared_ ? shared_->part_of_field(x) : vector_of(x, body_->make_vector());
}

Vector BallFigures::multiplier(const Eigen::VectorXd& lambda) const {
  if (shared_ && incompressible_) return shared_->part_of_multiplier(lambda);
  return vector_of(lambda, solved().space().make_multiplier());
}

BallFigures::Figure BallFigures::change(const Vector& u, const Vector& lambda) const {
  if (!shared_) return {entries(u), entries(lambda)};
  return {shared_->whole_field(u), incompressible_ ? shared_->whole_multiplier(lambda) : Eigen::VectorXd()};
}

BallFigures::Figure BallFigures::affine(const Eigen::Vector3d& a, double drive) const {
  const Eigen::VectorXd lambda = entries(body_->space().make_multiplier());
  return {entries(body_->affine_field(a.asDiagonal())), incompressible_ ? lambda : Eigen::VectorXd(), drive};
}

void BallFigures::share(Figure& figure) const {
  if (ranks_.size() == 1) return;
  const bool is_first = ranks_.is_first();
  std::vector<double> values;
  if (is_first) {
    values.assign(figure.x.begin(), figure.x.end());
    values.insert(values.end(), figure.lambda.begin(), figure.lambda.end());
    values.insert(values.end(), {figure.drive, figure.residual});
  }
  values = ranks_.of_owner(is_first, values);
  std::copy_n(values.begin(), figure.x.size(), figure.x.begin());
  std::copy_n(values.begin() + figure.x.size(), figure.lambda.size(), figure.lambda.begin());
  figure.drive = values[values.size() - 2];
  figure.residual = values.back();
}

bool BallFigures::is_admissible(const Eigen::VectorXd& x) const {
  const bool here = solves_here() && is_admissible_here(x);
  return ranks_.size() == 1 ? here : ranks_.of_owner(ranks_.is_first(), {here ? 1.0 : 0.0})[0] == 1;
}

bool BallFigures::is_admissible_here(const Eigen::VectorXd& x) const {
  if (!x.allFinite()) return false;
  const Vector at = field(x);
  return solved().least_jacobian(at).value > 0 && solved().least_reserve(at).value > 0;
}

Vector BallFigures::Terms::residual(double nu) const {
  Vector r = force;
  r.add(nu, drive);
  r += reaction;
  return r;
}

mechanics::Status BallFigures::terms(const Figure& figure, Terms& terms) const {
  const BallSpace& space = solved().space();
  const Vector x = field(figure.x), rest = solved().make_vector();
  terms.force = terms.drive = terms.reaction = rest;
  if (auto status = solved().judge(solved().kernels().force(x, terms.force), x); !status) return status;
  if (solved().gravity())
    if (auto status = solved().gravity()->add(x, terms.force); !status) return status;
  if (kind_ == Drive::loads) {
    solved().loads().add(0, x, rest, terms.drive);
  } else {
    solved().loads().add(0, x, rest, terms.force);
    for (unsigned int i = 0; i < 3 * space.n_nodes(); ++i)
      if (i % 3 != 2) terms.drive.local_element(i) = space.mass().local_element(i) * x.local_element(i);
  }
  if (incompressible_) {
    solved().kernels().add_reaction(x, multiplier(figure.lambda), terms.reaction);
    terms.constraint = space.make_multiplier();
    if (auto status = solved().judge(solved().kernels().constraint(x, terms.constraint), x); !status) return status;
  }
  for (Vector* f : {&terms.force, &terms.drive, &terms.reaction}) space.clear_fixed(*f);
  return {};
}

double BallFigures::scale_of(const Figure& figure, const Terms& terms) const {
  const double mu = materials::moduli_at_rest(stored_.law, incompressible_).shear;
  const double of_elasticity =
      mu * std::pow(solved().space().n_global_nodes(), -2.0 / 3);  // stress times the area of a node
  return std::max(
      {of_elasticity, largest(terms.force), std::abs(figure.drive) * largest(terms.drive), largest(terms.reaction)});
}

HeldDirection BallFigures::axis_direction(const Condition& condition) const {
  const BallSpace& space = solved().space();
  const auto k = static_cast<unsigned int>(mechanics::other_axis(condition.parameter));
  const int n_images = space.mesh().sector().n_images();
  HeldDirection held{solved().make_vector(), 0};
  double squares = 0;  // w·M⁻¹w
  for (unsigned int i = 0; i < 3 * space.n_nodes(); ++i) {
    if (i % 3 != 0 && i % 3 != k) continue;
    const double factor = n_images * (i % 3 == k ? 1 : -std::exp(condition.value)) / solved().E0()(i % 3, i % 3);
    const double X = space.reference_positions().local_element(i), mass = space.mass().local_element(i);
    held.w.local_element(i) = factor * mass * X;
    squares += factor * factor * mass * X * X;
  }
  held.stiffness = typical_stiffness() / sum_over_ranks(squares, space.communicator());
  return held;
}

struct BallFigures::Factors {
  Factors(const BallFigures& figures, const Figure& figure, const HeldDirection* held)
      : x(figures.field(figure.x)),
        lambda(figures.multiplier(figure.lambda)),
        solver(make_tangent_solver(figures.state_of(figures.solved(), x, lambda, figure.drive), held,
                                   figures.n_refinements_)) {}

  Vector x, lambda;
  std::unique_ptr<TangentSolver> solver;
};

BallFigures::~BallFigures() = default;

mechanics::Status BallFigures::solve_linear(const Figure& figure, const HeldDirection* held, double tolerance,
                                            const std::vector<std::pair<Vector, Vector>>& right_sides,
                                            std::vector<Figure>& changes) const {
  std::unique_ptr<Factors> of_held;
  std::unique_ptr<Factors>& factors = held ? of_held : factors_;
  if (held || !reuses_factors_ || !factors) {
    factors = std::make_unique<Factors>(*this, figure, held);
    ++counts_.factorizations;
    if (auto status = factors->solver->factorize(); !status) {
      factors.reset();
      return status;
    }
  }
  changes.clear();
  for (const auto& [f, h] : right_sides) {
    Vector u = solved().make_vector(), of_lambda = h;
    const auto report = factors->solver->solve(f, h, tolerance, u, of_lambda);
    if (!report.status) return report.status;
    counts_.linear_products += report.iterations;
    changes.push_back(change(u, of_lambda));
    symmetrize(changes.back().x);
  }
  return {};
}

mechanics::Status BallFigures::solve_with_condition(const Condition& condition, const Figure& figure, const Vector& f,
                                                    const Vector& minus_g, const Vector& drive, double c,
                                                    double tolerance, Figure& change) const {
  const HeldDirection held = axis_direction(condition);
  const Vector no_constraint = incompressible_ ? solved().space().make_multiplier() : Vector();
  Vector of_held = f;
  of_held.add(held.stiffness * c, held.w);
  std::vector<Figure> found;
  if (auto status = solve_linear(figure, &held, tolerance, {{of_held, minus_g}, {drive, no_constraint}}, found);
      !status)
    return status;
  change = found[0];
  found[1].drive = 1;
  mechanics::add((c - held.w * field(found[0].x)) / (held.w * field(found[1].x)), found[1], change);
  return {};
}

mechanics::Status BallFigures::step(const Condition& condition, const Figure& figure, const Terms& now,
                                    double tolerance, Figure& step) const {
  Vector r = now.residual(figure.drive), minus_g = now.constraint;
  if (incompressible_) minus_g *= -1;
  if (condition.parameter != mechanics::FigureParameter::drive) {
    const double excess = axis_direction(condition).w * field(figure.x);
    return solve_with_condition(condition, figure, r, minus_g, now.drive, -excess, tolerance, step);
  }
  const double change = condition.value - figure.drive;
  r.add(change, now.drive);
  std::vector<Figure> found;
  if (auto status = solve_linear(figure, nullptr, tolerance, {{r, minus_g}}, found); !status) return status;
  step = found[0];
  step.drive = change;
  return {};
}

double BallFigures::accepted_residual() const {
  // At γ = 1000 the residual does not fall below about 1.5e-11, and at λ/μ = 1000 not below 5e-11.
  const auto moduli = materials::moduli_at_rest(stored_.law, incompressible_);
  const double gamma = weight_of_density(forcing_.gravity_constant) / moduli.shear;
  return 1e-11 * (std::min(10.0, 1 + gamma) + (incompressible_ ? 0 : moduli.lame / moduli.shear / 100));
}

mechanics::Status BallFigures::newton_here(const Condition& condition, Figure& figure) const {
  constexpr int max_iterations = 60, max_halvings = 12;
  constexpr double slow = 0.2;  // a slower decrease of the residual needs a new tangent
  constexpr double round_off = 1e-14, quadratic = 1e-7, fast = 0.1;  // see the head of ball_figures.h
  const double accepted = accepted_residual();
  Figure kept = figure;
  double best = std::numeric_limits<double>::infinity();
  const bool can_reuse = condition.parameter == mechanics::FigureParameter::drive;
  bool reused = false;  // true if the last step had the factors of an earlier tangent
  long n_products = counts_.linear_products;
  reuses_factors_ = can_reuse && factors_;
  for (int i = 0; i < max_iterations; ++i) {
    Terms now;
    const mechanics::Status computed = terms(figure, now);
    double size = std::numeric_limits<double>::quiet_NaN();
    if (computed) {
      size = std::max(largest(now.residual(figure.drive)) / scale_of(figure, now), largest(now.constraint));
      size = std::max(size, can_reuse ? std::abs(figure.drive - condition.value)
                                      : std::abs(axis_direction(condition).w * field(figure.x)));
    }
    if (watch_ && ranks_.is_first()) watch_({i, figure.drive, size, counts_.linear_products - n_products});
    n_products = counts_.linear_products;
    if (size >= 0.5 * best && best <= accepted) break;  // a small residual that does not halve is round-off
    if (reused && !(size < best)) {                     // the old tangent misleads
      figure = kept;
      reused = reuses_factors_ = false;
      continue;
    }
    if (!computed) return computed;
    if (!std::isfinite(size)) break;
    const bool ends = size <= round_off || (!reused && best <= quadratic && size <= std::min(accepted, fast * best));
    if (i > 0) reuses_factors_ = can_reuse && size < slow * best && factors_ && !factors_->solver->factors_are_cheap();
    if (size < best) best = size, kept = figure;
    if (ends) break;
    Figure full;
    ++counts_.newton;
    reused = reuses_factors_;
    const double tolerance = std::clamp(std::max(size, 0.01 * round_off / size), least_tolerance, largest_tolerance);
    const mechanics::Status solved = step(condition, figure, now, tolerance, full);
    if (!solved || !full.x.allFinite()) {
      if (std::exchange(reused, false)) continue;  // `figure` is `kept`, so the next step has a new tangent
      if (best <= accepted || solved) break;
      return solved;
    }
    double factor = 1;
    for (int k = 0; k < max_halvings && !is_admissible_here(figure.x + factor * full.x); ++k) factor /= 2;
    mechanics::add(factor, full, figure);
  }
  reuses_factors_ = false;
  figure = kept;
  if (best <= accepted) return {};
  return mechanics::Status::failure(
      "Newton's iteration finds no figure of equilibrium here; it ends with a residual of " +
      mechanics::six_digits(best) + " of the terms");
}

BallFigures::Figure BallFigures::tangent_here(const Condition& condition, const Figure& figure,
                                              double tolerance) const {
  const auto nan = std::numeric_limits<double>::quiet_NaN();
  const Figure none{Eigen::VectorXd::Constant(figure.x.size(), nan),
                    Eigen::VectorXd::Constant(figure.lambda.size(), nan), nan};
  reuses_factors_ = false;
  Terms now;
  if (!terms(figure, now)) return none;
  const Vector no_constraint = incompressible_ ? solved().space().make_multiplier() : Vector();
  if (condition.parameter == mechanics::FigureParameter::drive) {
    std::vector<Figure> found;
    if (!solve_linear(figure, nullptr, tolerance, {{now.drive, no_constraint}}, found)) return none;
    found[0].drive = 1;
    return found[0];
  }
  // The derivative of the condition a_k − exp(v) a₁ = 0 with respect to its value v is w·u = exp(v) a₁. Here u is the
  // derivative of x.
  const double c = std::exp(condition.value) * solved().mass_moment(field(figure.x))(0, 0);
  Figure along;
  if (!solve_with_condition(condition, figure, solved().make_vector(), no_constraint, now.drive, c, tolerance, along))
    return none;
  return along;
}

mechanics::Status BallFigures::complete_here(Figure& figure) const {
  Terms now;
  if (auto status = terms(figure, now); !status) return status;
  figure.residual = largest(now.residual(figure.drive)) / scale_of(figure, now);
  return {};
}

}  // namespace pseudorigid::continuum
