#include "polynomial/body_gravity.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "polynomial/octant_quadrature.h"
#include "polynomial/scratch.h"

namespace pseudorigid::polynomial {
namespace {

using Vector3 = std::array<std::vector<double>, 3>;

/// Component c of w a × b at every point, with a weight w for each point.
std::vector<double> cross(const Vector3& a, const Vector3& b, int c, const std::vector<double>& w) {
  const int d = (c + 1) % 3, e = (c + 2) % 3;
  std::vector<double> product(w.size());
  for (std::size_t i = 0; i < w.size(); ++i) product[i] = w[i] * (a[d][i] * b[e][i] - a[e][i] * b[d][i]);
  return product;
}

/// The energy E_A = V_g(A S) (det A)^{1/3} of the affine part A (body_gravity.h), with its derivatives. V_g is the
/// energy of an ellipsoid.
struct AffineEnergy {
  const gravity::EllipsoidGravity& ellipsoid;
  Eigen::Matrix3d S;

  double energy(const Eigen::Matrix3d& A) const { return std::cbrt(A.determinant()) * ellipsoid.energy(A * S); }
  Eigen::Matrix3d gradient(const Eigen::Matrix3d& A) const {
    const Eigen::Matrix3d inverse_transposed = A.inverse().transpose();
    return std::cbrt(A.determinant()) *
           (ellipsoid.gradient(A * S) * S + ellipsoid.energy(A * S) / 3 * inverse_transposed);
  }
  Eigen::Matrix3d second_derivative(const Eigen::Matrix3d& A, const Eigen::Matrix3d& H) const {
    const Eigen::Matrix3d inverse = A.inverse(), K = inverse.transpose(), of_V = ellipsoid.gradient(A * S) * S;
    const double V = ellipsoid.energy(A * S), dilation = (inverse * H).trace() / 3;
    return std::cbrt(A.determinant()) * (dilation * (of_V + V / 3 * K) + ellipsoid.second_derivative(A * S, H * S) * S +
                                         of_V.cwiseProduct(H).sum() / 3 * K - V / 3 * K * H.transpose() * K);
  }
};

}  // namespace

BodyGravity::BodyGravity(double gravity_constant, std::shared_ptr<const PolynomialSpace> space,
                         std::optional<int> n_points)
    : constant_(gravity_constant),
      space_(std::move(space)),
      ellipsoid_{0.6 * gravity_constant * space_->volume() * space_->volume()},
      tables_(space_->surface_tables(n_points.value_or(usual_points(space_->degree())))),
      rest_volume_(0) {
  const int q = n_points.value_or(usual_points(space_->degree()));
  const std::vector<SurfacePoint> octant = octant_surface_points(q);
  for (int image = 0; image < space_->n_images(); ++image)
    for (std::size_t p = 0; p < octant.size(); ++p) {
      places_.push_back(static_cast<std::size_t>(image) * tables_.stride() + p);
      weights_.push_back(space_->orientation(image) * octant[p].weight);
    }
  Eigen::VectorXd at_rest = Eigen::VectorXd::Zero(space_->n_unknowns());
  space_->set_affine(Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), at_rest);
  rest_volume_ = enclosed_volume(points(jets(at_rest)));
  Eigen::VectorXd ball = at_rest, derivative = Eigen::VectorXd::Zero(space_->n_unknowns());
  space_->set_affine(space_->semi_axes().cwiseInverse().asDiagonal(), Eigen::Vector3d::Zero(), ball);
  add_surface_force(-1, ball, derivative);
  error_of_ball_.emplace(space_, derivative);
}

BodyGravity::SurfaceJets BodyGravity::jets(const Eigen::VectorXd& q) const {
  ScratchArray values(tables_.size(3));
  tables_.evaluate(space_->blocks(), 3, q.data(), values);
  SurfaceJets jets;
  for (int i = 0; i < 3; ++i)
    for (int field = 0; field < 3; ++field) {
      const double* row = values + static_cast<std::size_t>(3 * i + field) * tables_.n_points();
      for (const std::size_t place : places_) jets[field][i].push_back(row[place]);
    }
  return jets;
}

gravity::SurfacePoints BodyGravity::points(const SurfaceJets& x) const {
  gravity::SurfacePoints points{x[0], {}};
  for (int c = 0; c < 3; ++c) points.N[c] = cross(x[1], x[2], c, weights_);
  return points;
}

gravity::SurfacePoints BodyGravity::rates(const SurfaceJets& x, const SurfaceJets& u) const {
  gravity::SurfacePoints rates{u[0], {}};
  for (int c = 0; c < 3; ++c) {
    rates.N[c] = cross(u[1], x[2], c, weights_);
    std::ranges::transform(rates.N[c], cross(x[1], u[2], c, weights_), rates.N[c].begin(), std::plus());
  }
  return rates;
}

gravity::SurfacePoints BodyGravity::with_images(const gravity::SurfacePoints& points) const {
  gravity::SurfacePoints all = points;
  for (int c = 0; c < 3; ++c) {
    if (!space_->reflect()[c]) continue;
    const std::size_t n = all.size();
    for (std::size_t i = 0; i < n; ++i) {
      Eigen::Vector3d x = all.point(i), N = all.area(i);
      x[c] = -x[c];
      N[c] = -N[c];
      all.add(x, N);
    }
  }
  return all;
}

/// f ← f − factor · ∂E/∂q, for a function E of the points and area vectors. `derivative` has the derivatives of E with
/// respect to the points and area vectors. x has the positions and their derivatives for the coefficients q.
void BodyGravity::spread(double factor, const SurfaceJets& x, const gravity::SurfaceDerivative& derivative,
                         Eigen::VectorXd& f) const {
  const auto& [by_x, by_N] = derivative;
  ScratchArray values(tables_.size(3));
  std::fill_n(static_cast<double*>(values), tables_.size(3), 0.0);
  for (int i = 0; i < 3; ++i) {
    const std::array fields{by_x[i], cross(x[2], by_N, i, weights_), cross(by_N, x[1], i, weights_)};
    for (int field = 0; field < 3; ++field) {
      double* row = values + static_cast<std::size_t>(3 * i + field) * tables_.n_points();
      for (std::size_t p = 0; p < places_.size(); ++p) row[places_[p]] = -factor * fields[field][p];
    }
  }
  tables_.add_transposed(space_->blocks(), 3, values, f.data());
}

double BodyGravity::surface_energy(const Eigen::VectorXd& q) const {
  const gravity::SurfacePoints own = points(jets(q));
  return space_->n_mirrors() *
         gravity::surface_energy(totals(own, sum_own_pairs(own, space_->reflect())), constant_, rest_volume_);
}

double BodyGravity::add_surface_force(double sign, const Eigen::VectorXd& q, Eigen::VectorXd& f) const {
  const SurfaceJets at = jets(q);
  const gravity::SurfacePoints own = points(at);
  const gravity::PairSums sums = sum_own_pairs(own, space_->reflect());
  const gravity::SurfaceTotals of_all = totals(own, sums);
  spread(sign * space_->n_mirrors(), at, surface_derivative(own, sums, of_all, constant_, rest_volume_), f);
  return space_->n_mirrors() * gravity::surface_energy(of_all, constant_, rest_volume_);
}

void BodyGravity::add_surface_force_rate(double sign, const Eigen::VectorXd& q, const Eigen::VectorXd& u,
                                         Eigen::VectorXd& f) const {
  const double factor = sign * space_->n_mirrors();
  const SurfaceJets at = jets(q), rate = jets(u);
  const gravity::Moving own{points(at), rates(at, rate)};
  const auto sums = sum_pairs(own, gravity::Moving{with_images(own.at), with_images(own.rate)});
  const auto of_all = totals(own, sums);
  spread(factor, at, surface_derivative_rate(own, sums, of_all, constant_, rest_volume_), f);
  gravity::SurfaceDerivative of_areas = surface_derivative(own.at, sums.at, of_all.at, constant_, rest_volume_);
  for (auto& component : of_areas.by_point) std::ranges::fill(component, 0.0);
  spread(factor, rate, of_areas, f);  // adds the change of ∂N/∂q along u, because N is bilinear in ∂x/∂e_θ and ∂x/∂e_φ
}

Eigen::VectorXd BodyGravity::affine_coefficients(const Eigen::VectorXd& q) const {
  Eigen::VectorXd affine = Eigen::VectorXd::Zero(space_->n_unknowns());
  space_->set_affine(space_->affine_part(q), space_->mean(q), affine);
  return affine;
}

/// f ← f − ∂E/∂q for a function E of the affine part A of q. D is the derivative of E with respect to A.
void BodyGravity::add_affine_force(const Eigen::Matrix3d& D, Eigen::VectorXd& f) const {
  Eigen::VectorXd of_affine = Eigen::VectorXd::Zero(space_->n_unknowns());
  space_->set_affine(D * space_->inertia().cwiseInverse().asDiagonal(), Eigen::Vector3d::Zero(), of_affine);
  f.head(space_->n_unknowns()) -= of_affine;
}

double BodyGravity::energy(const Eigen::VectorXd& q) const {
  const Eigen::Matrix3d S = space_->semi_axes().asDiagonal();
  const double exact = AffineEnergy{ellipsoid_, S}.energy(space_->affine_part(q));
  if (is_affine()) return exact;
  return exact + surface_energy(q) - surface_energy(affine_coefficients(q)) - error_of_ball_->energy(q);
}

mechanics::Status BodyGravity::add_force(const Eigen::VectorXd& q, Eigen::VectorXd& f) const {
  const Eigen::Matrix3d S = space_->semi_axes().asDiagonal(), A = space_->affine_part(q);
  const AffineEnergy affine{ellipsoid_, S};
  add_affine_force(affine.gradient(A), f);
  if (is_affine()) return {};
  double energy = affine.energy(A) + add_surface_force(1, q, f);
  Eigen::VectorXd of_affine = Eigen::VectorXd::Zero(space_->n_unknowns());
  energy -= add_surface_force(-1, affine_coefficients(q), of_affine);
  f.head(space_->n_unknowns()) += affine_coefficients(of_affine);
  add_affine_force(-error_of_ball_->add_derivative(q, f), f);
  return gravity::judge_energy(energy, constant_, space_->n_mirrors() * rest_volume_);
}

void BodyGravity::add_force_rate(const Eigen::VectorXd& q, const Eigen::VectorXd& u, Eigen::VectorXd& f) const {
  const Eigen::Matrix3d S = space_->semi_axes().asDiagonal();
  add_affine_force(AffineEnergy{ellipsoid_, S}.second_derivative(space_->affine_part(q), space_->affine_part(u)), f);
  if (is_affine()) return;
  add_surface_force_rate(1, q, u, f);
  add_affine_force(-error_of_ball_->add_derivative_rate(q, u, f), f);
  const Eigen::VectorXd affine_rate = affine_coefficients(u);
  if (affine_rate.isZero(0)) return;
  Eigen::VectorXd of_affine = Eigen::VectorXd::Zero(space_->n_unknowns());
  add_surface_force_rate(-1, affine_coefficients(q), affine_rate, of_affine);
  f.head(space_->n_unknowns()) += affine_coefficients(of_affine);
}

std::vector<double> BodyGravity::potential(const Eigen::VectorXd& q, const std::vector<Eigen::Vector3d>& at) const {
  return gravity::potential_at(at, with_images(points(jets(q))), constant_);
}

}  // namespace pseudorigid::polynomial
