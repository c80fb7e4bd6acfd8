#include "continuum/modes/surface_harmonics.h"

#include <Eigen/Dense>
#include <cmath>
#include <map>
#include <utility>

namespace pseudorigid::continuum {
namespace {

/// Y_nm with cos(mφ) or sin(mφ), orthonormal on the sphere, and its gradient there.
struct Harmonic {
  double value;
  Eigen::Vector3d gradient;
};

Harmonic harmonic(int n, int m, bool sine, const Eigen::Vector3d& e) {
  const double theta = std::acos(e[2]), phi = std::atan2(e[1], e[0]);
  const double s = std::sin(theta), c = e[2], scale = m == 0 ? 1 : std::sqrt(2.0);
  const auto legendre = [&](int degree) {
    return degree < m ? 0.0 : scale * std::sph_legendre(static_cast<unsigned>(degree), static_cast<unsigned>(m), theta);
  };
  const double P = legendre(n);
  // sin θ dP_n/dθ = n cos θ P_n − √((2n+1)/(2n−1) (n² − m²)) P_{n−1}
  const double below =
      n == 0 ? 0 : std::sqrt((2.0 * n + 1) / (2.0 * n - 1) * (1.0 * n * n - 1.0 * m * m)) * legendre(n - 1);
  const double dP = (n * c * P - below) / s;
  const double angle = sine ? std::sin(m * phi) : std::cos(m * phi);
  const double d_angle = sine ? m * std::cos(m * phi) : -m * std::sin(m * phi);
  const Eigen::Vector3d e_theta(c * std::cos(phi), c * std::sin(phi), -s), e_phi(-std::sin(phi), std::cos(phi), 0);
  return {P * angle, dP * angle * e_theta + P * d_angle / s * e_phi};
}

/// Sign of Y_nm under the reflections of x, y, z.
Parity parity_of_harmonic(int n, int m, bool sine) {
  const int even_m = m % 2 == 0 ? 1 : -1;
  return {{sine ? -even_m : even_m, sine ? -1 : 1, (n + m) % 2 == 0 ? 1 : -1}};
}

bool same(const Parity& a, const Parity& b, int sign) {
  for (int j = 0; j < 3; ++j)
    if (a.sign[j] != sign * b.sign[j]) return false;
  return true;
}

}  // namespace

SurfaceHarmonics::SurfaceHarmonics(const BallSpace& space, const Parity& parity, int max_degree) {
  find_points(space);
  for (int n = 0; n <= max_degree; ++n)
    for (int m = 0; m <= n; ++m)
      for (const bool sine : {false, true})
        if (m > 0 || !sine) add_harmonic(n, m, sine, parity);
}

void SurfaceHarmonics::find_points(const BallSpace& space) {
  constexpr double n_octants = 8;
  for (const CellFace& face : free_surface(space))
    for (FacePoint& point : quadrature_on(space, face, space.reference_cell().n)) {
      const FacePoint::Jet X = point.jet(space.reference_positions());
      const double area = n_octants * point.weight * X.by_p.cross(X.by_q).norm();
      points_.push_back({std::move(point), X.u.normalized(), area});
    }
}

void SurfaceHarmonics::add_row(ModeKind kind, int degree, const Eigen::Matrix3Xd& field) {
  rows_.push_back({kind, degree});
  fields_.push_back(field);
  for (std::size_t p = 0; p < points_.size(); ++p) fields_.back().col(static_cast<Eigen::Index>(p)) *= points_[p].area;
}

void SurfaceHarmonics::add_harmonic(int n, int m, bool sine, const Parity& parity) {
  const Parity own = parity_of_harmonic(n, m, sine);
  const bool spheroidal = same(own, parity, 1), toroidal = same(own, parity, -1);  // e×∇ changes the signs
  if (!spheroidal && !toroidal) return;
  const auto n_points = static_cast<Eigen::Index>(points_.size());
  Eigen::Matrix3Xd radial(3, n_points), tangential(3, n_points);
  for (Eigen::Index p = 0; p < n_points; ++p) {
    const Eigen::Vector3d& e = points_[static_cast<std::size_t>(p)].e;
    const Harmonic Y = harmonic(n, m, sine, e);
    radial.col(p) = Y.value * e;
    const Eigen::Vector3d gradient = n == 0 ? Eigen::Vector3d::Zero() : (Y.gradient / std::sqrt(n * (n + 1.0))).eval();
    tangential.col(p) = spheroidal ? gradient : e.cross(gradient);
  }
  if (spheroidal) add_row(ModeKind::spheroidal, n, radial);
  if (n > 0) add_row(spheroidal ? ModeKind::spheroidal : ModeKind::toroidal, n, tangential);
}

ModeClass SurfaceHarmonics::classify(const Vector& u) const {
  Eigen::Matrix3Xd field(3, static_cast<Eigen::Index>(points_.size()));
  double whole = 0;
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const Eigen::Vector3d value = points_[p].on_face.value(u);
    field.col(static_cast<Eigen::Index>(p)) = value;
    whole += points_[p].area * value.squaredNorm();
  }
  std::map<std::pair<int, int>, double> shares;
  for (std::size_t r = 0; r < rows_.size(); ++r)
    shares[{static_cast<int>(rows_[r].kind), rows_[r].degree}] += std::pow(field.cwiseProduct(fields_[r]).sum(), 2);
  ModeClass best;
  for (const auto& [key, square] : shares)
    if (square > best.share * whole) best = {static_cast<ModeKind>(key.first), key.second, square / whole};
  return best;
}

}  // namespace pseudorigid::continuum
