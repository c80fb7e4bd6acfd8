#pragma once
/// Samples for the tests of polynomial bodies, the same for the same generator: setups with every load of the list,
/// random states, and a state of a sector as one of the whole ball.

#include <Eigen/Dense>
#include <random>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "polynomial/compressible_body.h"
#include "polynomial/incompressible_body.h"
#include "support/runs.h"

namespace pseudorigid::testing {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using mechanics::State;
using polynomial::BodySetup;
using polynomial::CompressibleBody;
using polynomial::IncompressibleBody;
using Planes = std::array<bool, 3>;

inline constexpr Planes no_planes{false, false, false}, all_planes{true, true, true};
inline std::vector<Planes> all_sectors() {
  std::vector<Planes> sectors;
  for (int k = 0; k < 8; ++k) sectors.push_back({(k & 1) != 0, (k & 2) != 0, (k & 4) != 0});
  return sectors;
}

/// The entries of M that the symmetry planes admit.
inline Matrix3d admitted(const Planes& planes, Matrix3d M) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (i != j && (planes[i] || planes[j])) M(i, j) = 0;
  return M;
}

/// μ = 1 as everywhere in internal units; a Lamé λ, a Mooney fraction that are not special.
inline materials::AnyLaw generic(const materials::NamedLaw& law, bool incompressible) {
  return law.make({.shear_modulus = 1, .lame_lambda = 3, .mooney_fraction = 0.3}, incompressible);
}
template <class Body>
inline constexpr bool incompressible = std::is_same_v<Body, IncompressibleBody>;

/// Gives every entry of a load a value, as much of it as the planes admit. Rigid planes, of which there are none by
/// default, stay absent: their forces have kinks (contact_test.cpp).
struct SetEntries {
  Planes planes = no_planes;
  void operator()(double& x, const auto&, const auto&) const { x = 0.3; }
  void operator()(std::vector<double>& b, const auto&, const auto&) const {
    const Vector3d of_no_symmetry(0.2, -0.1, 0.15);
    for (std::size_t i = 0; i < b.size(); ++i) b[i] = planes[i] ? 0 : of_no_symmetry[static_cast<Eigen::Index>(i)];
  }
  void operator()(bool&, const auto&, const auto&) const {}
  void operator()(std::optional<double>& x, const auto&, const auto&) const { x = 0.3; }
  void operator()(scene::Matrix3& T, const auto&, const auto&) const {
    Matrix3d of_no_symmetry;
    of_no_symmetry << 0.3, 0.1, -0.05, 0.1, 0.2, 0.15, -0.05, 0.15, -0.1;
    const Matrix3d M = admitted(planes, of_no_symmetry);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) T[i][j] = M(i, j);
  }
};
template <class Load>
Load with_entries(const Planes& planes) {
  Load load;
  const SetEntries set{planes};
  Load::visit_entries(load, set);
  return load;
}

struct NamedLoads {
  std::string name;
  loads::Loads loads;
};
/// No load, and each of the list by itself. Self-gravity needs a uniform density.
inline std::vector<NamedLoads> single_loads(bool incompressible, const Planes& planes = no_planes) {
  std::vector<NamedLoads> result{{"no load", {}}};
  loads::Loads{}.for_each([&]<class L>(const L&) {
    if (!incompressible && std::is_same_v<L, loads::SelfGravity>) return;
    const L load = with_entries<L>(planes);
    const std::string number = std::to_string(result.size());
    if (largest_forcing(load).present()) result.push_back({"load " + number, loads::Loads(load)});
  });
  return result;
}
/// Several loads that rise together.
inline NamedLoads rising_loads(const Planes& planes) {
  return {"loads that rise",
          {loads::Rise{2}, with_entries<loads::Tide>(planes), with_entries<loads::PeriodicTide>(planes),
           with_entries<loads::Acceleration>(planes), with_entries<loads::Traction>(planes),
           with_entries<loads::Pressure>(planes)}};
}

inline VectorXd random_vector(Eigen::Index n, std::mt19937& generator) {
  std::uniform_real_distribution<double> entry(-1, 1);
  return VectorXd::NullaryExpr(n, [&] { return entry(generator); });
}
inline Matrix3d random_matrix(std::mt19937& generator) {
  std::uniform_real_distribution<double> entry(-1, 1);
  return Matrix3d::NullaryExpr([&] { return entry(generator); });
}

/// An affine map of det > 0 with a random field of norm 0.02, which changes its gradient by some tenths.
template <class Body>
VectorXd random_position(const Body& body, std::mt19937& generator) {
  const Matrix3d A = Matrix3d::Identity() + 0.2 * random_matrix(generator);
  VectorXd q = body.affine(A, 0.3 * Vector3d(random_matrix(generator).col(0)));
  q += 0.02 * random_vector(q.size(), generator).normalized();
  EXPECT_TRUE(body.admissible(q));
  return q;
}
/// Of norm 1.
template <class Body>
VectorXd random_direction(const Body& body, std::mt19937& generator) {
  return random_vector(body.make_vector().size(), generator).normalized();
}

/// Calls visitor(place in the sector, place in the whole ball) for every coefficient of a sector.
template <class Visitor>
void for_each_coefficient(const polynomial::PolynomialSpace& sector, const polynomial::PolynomialSpace& ball,
                          Visitor&& visitor) {
  for (int i = 0; i < 3; ++i)
    for (int a = 0; a < sector.n_functions(); ++a)
      if (sector.place(i, a) >= 0) visitor(sector.place(i, a), ball.place(i, a));
}
/// The same motion of the whole ball.
template <class Body>
VectorXd in_whole_ball(const Body& sector, const Body& ball, const VectorXd& q) {
  VectorXd whole = ball.make_vector();
  for_each_coefficient(sector.space(), ball.space(), [&](int from, int to) { whole[to] = q[from]; });
  return whole;
}

}  // namespace pseudorigid::testing
