#include "polynomial/polynomial_body.h"

#include <cmath>
#include <cstdio>
#include <limits>

#include "materials/eigen_tensor.h"
#include "polynomial/constraint.h"
#include "polynomial/dense_kernels.h"
#include "polynomial/scratch.h"

namespace pseudorigid::polynomial {
namespace {

/// The matrix of a tensor field with n points, such as F = ∂x/∂X, at point p.
Eigen::Matrix3d tensor_at(const double* field, int n, int p) {
  Eigen::Matrix3d F;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) F(i, k) = field[static_cast<std::ptrdiff_t>(3 * i + k) * n + p];
  return F;
}

double sum_of_products(const std::vector<double>& w, const double* y, int n) {
  double sum = 0;
  for (int p = 0; p < n; ++p) sum += w[p] * y[p];
  return sum;
}

}  // namespace

PolynomialBody::PolynomialBody(const BodySetup& s)
    : space_(std::make_shared<PolynomialSpace>(s.degree, s.reflect, s.semi_axes, s.n_points)),
      law_(s.law),
      volumetric_stiffness_(s.volumetric_stiffness),
      projected_bulk_(s.projected_bulk),
      loads_(s.loads),
      constant_(loads::constant_forcing(s.loads)),
      driven_(loads::depend_on_time(s.loads)) {
  if (!driven_) free_ = loads::free_motions(constant_, s.reflect);
  if (const double G = constant_.gravity_constant; G > 0)
    gravity_ = std::make_shared<BodyGravity>(G, space_, s.n_gravity_points);
  if (!constant_.planes.empty())
    contact_ =
        std::make_shared<BodyContact>(constant_.planes, space_, s.n_contact_points.value_or(BodyContact::usual_points));
  if (!constant_.companions.empty())
    orbit_ = mechanics::Orbit(constant_.companions, constant_.gravity_constant, space_->volume());
}

PolynomialBody::Vector PolynomialBody::affine(const Eigen::Matrix3d& A, const Eigen::Vector3d& c) const {
  Vector x = make_vector();
  space_->set_affine(A, c, x.head(space_->n_unknowns()));
  return x;
}

void PolynomialBody::transform(const Eigen::Matrix3d& D, Vector& x) const {
  for (int a = 0; a < space_->n_functions(); ++a) {
    Eigen::Vector3d of_function = Eigen::Vector3d::Zero();
    for (int i = 0; i < 3; ++i)
      if (const int at = space_->place(i, a); at >= 0) of_function[i] = x[at];
    of_function = D * of_function;
    for (int i = 0; i < 3; ++i)
      if (const int at = space_->place(i, a); at >= 0) x[at] = of_function[i];
  }
}

mechanics::Status PolynomialBody::applied_force(double t, const Vector& q, const Vector& v, const Vector* held_at,
                                                Vector& f) const {
  const int n = space_->n_points();
  ScratchArray F(space_->gradients().size(3)), T(space_->gradients().size(3));
  space_->gradients().evaluate(space_->blocks(), 3, q.data(), F);
  const double least = dense().stress(law_, volumetric_stiffness_, n, space_->weights().data(), F, T);
  if (!(least > 0 && std::isfinite(least))) return inadmissible(q);
  if (relaxes())
    dense().add_branch_stress(constant_.branches.list, n, space_->weights().data(), q.data() + first_metric(), F, T);
  const loads::Forcing now = driven_ ? loads::driving(loads_, t) : loads::Forcing{};
  if (const double p = constant_.pressure + now.pressure; p != 0) {
    ScratchArray A(space_->gradients().size(3)), wJ(n);
    dense().inverse_transposed(n, F, A);
    dense().jacobian(n, F, wJ);
    for (int i = 0; i < n; ++i) wJ[i] *= p * space_->weights()[i];
    dense().add_multiple(n, wJ, A, T);
  }
  double taken = constant_.viscosity != 0 ? add_dissipation(v, F, T) : 0;
  double given = driven_ ? external_energy(loads::driving_rate(loads_, t), q, F) : 0;
  f.setZero();
  space_->gradients().add_transposed(space_->blocks(), 3, T, f.data());
  f = -f;
  add_loads(constant_, q, f);
  if (driven_) add_loads(now, q, f);
  if (gravity_)
    if (auto status = gravity_->add_force(q, f); !status) return status;
  if (contact_ && held_at) contact_->add_holding_force(q - *held_at, f);
  if (contact_ && !held_at) {
    given += contact_->add_force(t, q, f);
    const loads::ContactPower power = contact_->add_dissipation(t, q, v, f);
    taken += power.taken;
    given += power.given;
  }
  if (orbit_.n() > 0) add_companions(q, f);
  if (n_accounts() == 0) return {};
  const int n_unknowns = space_->n_unknowns();
  f.head(n_unknowns) -= constant_.drag * v.head(n_unknowns);
  f[n_unknowns] = taken + constant_.drag * v.head(n_unknowns).squaredNorm();
  f[n_unknowns + 1] = given;
  return {};
}

/// Adds the forces of the nominal traction, the acceleration and the quadratic potential to f.
void PolynomialBody::add_loads(const loads::Forcing& forcing, const Vector& q, Vector& f) const {
  const auto& space = *space_;
  if (!forcing.nominal_traction.isZero(0))
    space.add_uniform_stress(forcing.nominal_traction, f.head(space.n_unknowns()));
  if (!forcing.acceleration.isZero(0))
    for (int i = 0; i < 3; ++i)
      if (const int at = space.place(i, 0); at >= 0) f[at] += forcing.acceleration[i] * std::sqrt(space.volume());
  if (forcing.quadratic.isZero(0)) return;
  const int n_functions = space.n_functions();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      if (forcing.quadratic(i, j) == 0) continue;
      for (int a = 0; a < n_functions; ++a)
        if (const int at_i = space.place(i, a), at_j = space.place(j, a); at_i >= 0 && at_j >= 0)
          f[at_i] -= forcing.quadratic(i, j) * q[at_j];
    }
}

Eigen::Matrix3d PolynomialBody::second_moment(const Vector& q) const {
  const auto x = q.head(space_->n_unknowns());
  const Eigen::Vector3d center = space_->mean(x);
  return space_->moment(x, x) - space_->volume() * center * center.transpose();
}

/// Adds the forces of the companions to the forces on the body, and sets the forces on the companions. The forces on
/// the body have no resultant.
void PolynomialBody::add_companions(const Vector& q, Vector& f) const {
  const mechanics::Orbit::Columns s = companions(q);
  loads::Forcing tide;
  tide.quadratic = orbit_.tide(s);
  Vector about_center = q;
  for (int i = 0; i < 3; ++i)
    if (const int at = space_->place(i, 0); at >= 0) about_center[at] = 0;
  add_loads(tide, about_center, f);
  set_companions(orbit_.force(second_moment(q), s), f);
}

double PolynomialBody::external_energy(const loads::Forcing& forcing, const Vector& q, const double* F) const {
  if (!forcing.present()) return 0;
  const auto& space = *space_;
  const auto x = q.head(space.n_unknowns());
  Vector of_traction = Vector::Zero(space.n_unknowns());
  space.add_uniform_stress(forcing.nominal_traction, of_traction);
  double energy = 0.5 * forcing.quadratic.cwiseProduct(space.moment(x, x)).sum() -
                  space.volume() * forcing.acceleration.dot(space.mean(x)) - of_traction.dot(x);
  if (forcing.pressure == 0) return energy;
  ScratchArray J(space.n_points());
  dense().jacobian(space.n_points(), F, J);
  return energy + forcing.pressure * sum_of_products(space.weights(), J, space.n_points());
}

void PolynomialBody::relax(double h, const Vector& before, Vector& q, Vector& v) const {
  const std::size_t size = space_->gradients().size(3);
  ScratchArray F0(size), F1(size);
  space_->gradients().evaluate(space_->blocks(), 3, before.data(), F0);
  space_->gradients().evaluate(space_->blocks(), 3, q.data(), F1);
  const materials::BranchEnergies lost = dense().relax_branches(
      constant_.branches.list, h, space_->n_points(), space_->weights().data(), F0, F1, q.data() + first_metric());
  for (std::size_t b = 0; b < constant_.branches.list.size(); ++b) {
    add_taken(lost[b], v);
    v[first_branch_account() + static_cast<int>(b)] += lost[b];
  }
}

void PolynomialBody::start_branches(bool relaxed, Vector& q) const {
  const int n = space_->n_points();
  ScratchArray F(space_->gradients().size(3));
  space_->gradients().evaluate(space_->blocks(), 3, q.data(), F);
  double* at = q.data() + first_metric();
  for (std::size_t b = 0; b < constant_.branches.list.size(); ++b, at += 6 * n)
    for (int p = 0; p < n; ++p) {
      const auto metric =
          relaxed ? materials::isochoric_strain(materials::to_tensor(tensor_at(F, n, p))) : materials::identity_metric;
      for (int k = 0; k < 6; ++k) at[k * n + p] = metric.a[k];
    }
}

materials::BranchesAtPoint PolynomialBody::branches_at(const Vector& q, int point) const {
  const int n = space_->n_points();
  materials::BranchesAtPoint result{.sum_of_moduli = materials::sum_of_moduli(constant_.branches.list)};
  const double* at = q.data() + first_metric() + point;
  for (const materials::MaxwellBranch& branch : constant_.branches.list) {
    materials::Symmetric<double> metric;
    for (int k = 0; k < 6; ++k, at += n) metric.a[k] = *at;
    materials::add_branch(branch.modulus, metric, result.inverse_sum);
  }
  return result;
}

mechanics::VectorState<PolynomialBody::Vector> PolynomialBody::with_points_of_body(
    mechanics::VectorState<Vector> state) const {
  const Vector zero = make_vector();
  if (state.q.size() == zero.size()) return state;
  for (Vector* x : {&state.q, &state.v}) {
    Vector resized = zero;
    resized.head(first_metric()) = x->head(first_metric());
    *x = resized;
  }
  start_branches(constant_.branches.relaxed, state.q);
  return state;
}

double PolynomialBody::add_dissipation(const Vector& v, const double* F, double* T) const {
  const int n = space_->n_points();
  ScratchArray A(space_->gradients().size(3)), B(space_->gradients().size(3));
  dense().inverse_transposed(n, F, A);
  space_->gradients().evaluate(space_->blocks(), 3, v.data(), B);
  return dense().add_viscous_stress(n, space_->weights().data(), constant_.viscosity, F, A, B, T);
}

void PolynomialBody::add_damping(const mechanics::VectorState<Vector>& state, const Vector& u,
                                 mechanics::Linearization kind, Vector& f) const {
  const int n_unknowns = space_->n_unknowns();
  if (constant_.viscosity != 0) {
    ScratchArray F(space_->gradients().size(3)), T(space_->gradients().size(3));
    space_->gradients().evaluate(space_->blocks(), 3, state.q.data(), F);
    std::fill_n(static_cast<double*>(T), space_->gradients().size(3), 0.0);
    add_dissipation(u, F, T);
    Vector taken = Vector::Zero(f.size());
    space_->gradients().add_transposed(space_->blocks(), 3, T, taken.data());
    f -= taken;
  }
  if (contact_) contact_->add_damping(state.t, state.q, state.v, u, kind, f);
  f.head(n_unknowns) -= constant_.drag * u.head(n_unknowns);
}

PotentialEnergies PolynomialBody::potential_energies(double t, const Vector& q) const {
  const int n = space_->n_points();
  ScratchArray F(space_->gradients().size(3));
  space_->gradients().evaluate(space_->blocks(), 3, q.data(), F);
  const EnergySums stored = dense().energy(law_, volumetric_stiffness_, n, space_->weights().data(), F);
  PotentialEnergies V{.elastic = stored.elastic + stored.volumetric, .volumetric = stored.volumetric};
  if (projected_bulk_ > 0) {
    Vector g = Vector::Zero(space_->n_pressures()), b = g;
    constraint(*space_, q, g);
    V.elastic += bulk(*space_, projected_bulk_, g, b);
  }
  if (relaxes())
    V.elastic += V.viscoelastic =
        dense().branch_energy(constant_.branches.list, n, space_->weights().data(), q.data() + first_metric(), F);
  if (gravity_) V.gravitational = gravity_->energy(q);
  V.external = external_energy(constant_, q, F);
  if (driven_) V.external += external_energy(loads::driving(loads_, t), q, F);
  if (contact_) V.contact = contact_->energy(t, q);
  if (orbit_.n() > 0) V.interaction = orbit_.energy(second_moment(q), companions(q));
  return V;
}

double PolynomialBody::potential_energy(const Vector& q) const {
  if (!admissible(q)) return std::numeric_limits<double>::infinity();
  return potential_energies(0, q).total();
}

void PolynomialBody::add_force_rate(const Vector& q, const Vector& u, Vector& f) const {
  const int n = space_->n_points();
  const std::size_t size = space_->gradients().size(3);
  ScratchArray F(size), H(size), T(size);
  space_->gradients().evaluate(space_->blocks(), 3, q.data(), F);
  space_->gradients().evaluate(space_->blocks(), 3, u.data(), H);
  dense().stress_rate(law_, volumetric_stiffness_, n, space_->weights().data(), F, H, T);
  if (const double p = constant_.pressure; p != 0) {  // D(J F⁻ᵀ)[H] = J (F⁻ᵀ:H) F⁻ᵀ − J F⁻ᵀHᵀF⁻ᵀ
    ScratchArray A(size), wJ(n), y(n);
    dense().inverse_transposed(n, F, A);
    dense().jacobian(n, F, wJ);
    for (int i = 0; i < n; ++i) wJ[i] *= p * space_->weights()[i];
    dense().weighted_product(n, wJ, A, H, y);
    dense().add_multiple(n, y, A, T);
    dense().add_rate_of_inverse(n, wJ, A, H, T);
  }
  Vector rate = Vector::Zero(f.size());
  space_->gradients().add_transposed(space_->blocks(), 3, T, rate.data());
  f -= rate;
  loads::Forcing linear;
  linear.quadratic = constant_.quadratic;
  add_loads(linear, u, f);
  if (gravity_) gravity_->add_force_rate(q, u, f);
  if (contact_) contact_->add_force_rate(0, q, u, f);
}

void PolynomialBody::symmetry(int i, const Vector& q, const Vector& v, Vector& dq, Vector& dv) const {
  dq.setZero();
  dv.setZero();
  const int n_turns = static_cast<int>(free_.turns.size());
  if (i >= n_turns) {
    space_->set_affine(Eigen::Matrix3d::Zero(), Eigen::Vector3d::Unit(free_.translations[i - n_turns]), dq);
    return;
  }
  const int axis = free_.turns[i], j = (axis + 1) % 3, k = (axis + 2) % 3;  // (ê×x)_j = −x_k, (ê×x)_k = x_j
  const Vector about_centre = q - affine(Eigen::Matrix3d::Zero(), space_->mean(q)),
               rate = v - affine(Eigen::Matrix3d::Zero(), space_->mean(v));
  for (int a = 0; a < space_->n_functions(); ++a) {
    const int at_j = space_->place(j, a), at_k = space_->place(k, a);
    if (at_j < 0 || at_k < 0) continue;
    dq[at_j] = -about_centre[at_k];
    dq[at_k] = about_centre[at_j];
    dv[at_j] = -rate[at_k];
    dv[at_k] = rate[at_j];
  }
}

mechanics::Status PolynomialBody::admissible(const Vector& q) const {
  const int n = space_->n_points();
  ScratchArray F(space_->gradients().size(3)), T(space_->gradients().size(3));
  space_->gradients().evaluate(space_->blocks(), 3, q.data(), F);
  const double least = dense().stress(law_, 0, n, space_->weights().data(), F, T);
  return least > 0 && std::isfinite(least) ? mechanics::Status() : inadmissible(q);
}

mechanics::Status PolynomialBody::inadmissible(const Vector& q) const {
  if (const auto limit = materials::limit_of(law_);
      !limit.empty() && least(q, [](const Eigen::Matrix3d& F) { return F.determinant(); }) > 0)
    return mechanics::Status::failure(materials::beyond_limit(limit));
  return mechanics::Status::failure("the body is turned inside out or is not finite: " + least_jacobian_in_words(q));
}

std::string PolynomialBody::least_jacobian_in_words(const Vector& q) const {
  const int n = space_->n_points();
  ScratchArray F(space_->gradients().size(3)), J(n);
  space_->gradients().evaluate(space_->blocks(), 3, q.data(), F);
  dense().jacobian(n, F, J);
  int place = 0;
  for (int p = 1; p < n; ++p)
    if (J[p] < J[place] || std::isnan(J[p])) place = p;
  const auto& xi = space_->points()[place];
  const auto& s = space_->semi_axes();
  char text[120];
  std::snprintf(text, sizeof text, "det F = %.3g at X/r = (%.3f, %.3f, %.3f)", J[place], s[0] * xi[0], s[1] * xi[1],
                s[2] * xi[2]);
  return text;
}

double PolynomialBody::least(const Vector& q, const std::function<double(const Eigen::Matrix3d& F)>& value) const {
  const int n = space_->n_points();
  ScratchArray F(space_->gradients().size(3));
  space_->gradients().evaluate(space_->blocks(), 3, q.data(), F);
  double least = std::numeric_limits<double>::infinity();
  for (int p = 0; p < n; ++p) {
    const double at_point = value(tensor_at(F, n, p));
    if (at_point < least || std::isnan(at_point)) least = at_point;
  }
  return least;
}

}  // namespace pseudorigid::polynomial
