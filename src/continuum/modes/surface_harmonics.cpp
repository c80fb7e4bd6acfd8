#include "continuum/modes/surface_harmonics.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace pseudorigid::continuum {
namespace {

constexpr double n_octants = 8;

/// The value and the gradient on the unit sphere of a real spherical harmonic Y_nm at a point. The Y_nm are orthonormal
/// and have a factor cos(mφ) or sin(mφ).
struct Harmonic {
  double value;
  Eigen::Vector3d gradient;
};

/// Y_nm at the point e of the unit sphere, with the factor sin(mφ) if `sine` is true, and otherwise cos(mφ). The point
/// must not be a pole, because the formulas divide by sin θ.
Harmonic harmonic(int n, int m, bool sine, const Eigen::Vector3d& e) {
  const double theta = std::acos(e[2]), phi = std::atan2(e[1], e[0]);
  const double s = std::sin(theta), c = e[2], scale = m == 0 ? 1 : std::sqrt(2.0);
  const auto legendre = [&](int degree) {
    return degree < m ? 0.0 : scale * std::sph_legendre(static_cast<unsigned>(degree), static_cast<unsigned>(m), theta);
  };
  const double P = legendre(n);
  // For the normalised Legendre functions, sin θ dP_n/dθ = n cos θ P_n − √((2n+1)/(2n−1) (n² − m²)) P_{n−1}.
  const double below =
      n == 0 ? 0 : std::sqrt((2.0 * n + 1) / (2.0 * n - 1) * (1.0 * n * n - 1.0 * m * m)) * legendre(n - 1);
  const double dP = (n * c * P - below) / s;
  const double angle = sine ? std::sin(m * phi) : std::cos(m * phi);
  const double d_angle = sine ? m * std::cos(m * phi) : -m * std::sin(m * phi);
  const Eigen::Vector3d e_theta(c * std::cos(phi), c * std::sin(phi), -s), e_phi(-std::sin(phi), std::cos(phi), 0);
  return {P * angle, dP * angle * e_theta + P * d_angle / s * e_phi};
}

/// The parity of Y_nm: its signs under the reflections of x, y and z. `sine` selects the factor sin(mφ).
Parity parity_of_harmonic(int n, int m, bool sine) {
  const int even_m = m % 2 == 0 ? 1 : -1;
  return {{sine ? -even_m : even_m, sine ? -1 : 1, (n + m) % 2 == 0 ? 1 : -1}};
}

/// True if every sign of a is `sign` times the corresponding sign of b.
bool same(const Parity& a, const Parity& b, int sign) {
  for (int j = 0; j < 3; ++j)
    if (a.sign[j] != sign * b.sign[j]) return false;
  return true;
}

}  // namespace

int largest_resolved_degree(const BallSpace& space) {
  constexpr int n_edges = 2, most = 64;  // edges of the unrefined mesh on a quarter of a great circle
  const auto n_levels = space.mesh().triangulation().n_global_levels();
  return std::min(2 * n_edges * static_cast<int>(space.degree() << (n_levels - 1)), most);
}

std::vector<FacePoint> harmonic_quadrature(const BallSpace& space, const CellFace& face) {
  return quadrature_on(space, face, space.reference_cell().n + 3);
}

SurfaceHarmonics::SurfaceHarmonics(const BallSpace& space, const Parity& parity, int max_degree)
    : space_(space), max_degree_(max_degree) {
  find_points();
  for (int n = 0; n <= max_degree; ++n)
    for (int m = 0; m <= n; ++m)
      for (const bool sine : {false, true})
        if (m > 0 || !sine) add_harmonic(n, m, sine, parity);
}

void SurfaceHarmonics::find_points() {
  for (const CellFace& face : free_surface(space_))
    for (FacePoint& point : harmonic_quadrature(space_, face)) {
      const FacePoint::Jet X = point.jet(space_.reference_positions());
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
  const bool spheroidal = same(own, parity, 1), toroidal = same(own, parity, -1);  // e×∇Y has the opposite signs
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

std::vector<std::size_t> SurfaceHarmonics::radial_fields(int n) const {
  std::vector<std::size_t> found;
  for (std::size_t r = 0; r + 1 < rows_.size(); ++r)
    if (rows_[r].kind == ModeKind::spheroidal && rows_[r].degree == n) found.push_back(r++);
  return found;
}

double SurfaceHarmonics::integral(std::size_t field, const Vector& u) const {
  double sum = 0;
  for (std::size_t p = 0; p < points_.size(); ++p)
    sum += fields_[field].col(static_cast<Eigen::Index>(p)).dot(points_[p].on_face.value(u));
  return sum;
}

Vector SurfaceHarmonics::force(std::size_t field) const {
  Vector f = space_.make_vector();
  for (std::size_t p = 0; p < points_.size(); ++p)
    for (const FacePoint::Node& node : points_[p].on_face.nodes)
      for (unsigned int c = 0; c < 3; ++c)
        f.local_element(3 * node.node + c) += node.value * fields_[field](c, static_cast<Eigen::Index>(p)) / n_octants;
  return f;
}

}  // namespace pseudorigid::continuum
