/// A ball that is released from a small affine stretch, against the exact response of the incompressible sphere in the
/// linear regime (PHYSICS section 3): Q_M = Id + ε h(τ) H. A shear front leaves the surface, so the error falls with a
/// power of the degree.

#include <gtest/gtest.h>

#include "polynomial/motions.h"
#include "support/order_fit.h"

namespace pseudorigid::testing {
namespace {

/// h at the times of PHYSICS section 3.
constexpr std::pair<double, double> exact_response[]{
    {0.5, 0.146358521}, {1, -0.766518214}, {2, 0.532318414}, {5, 0.621511672}};

/// (Q33 − 1)/ε at multiples of half a unit of time, released with Q33 = 1 + ε; what is not linear adds about ε.
std::vector<double> response(int degree) {
  constexpr double epsilon = 1e-6, end = 5;
  const auto body = elastic_body<IncompressibleBody>(all_planes, degree);
  std::vector<double> h;
  const Vector3d axes(std::exp(-epsilon / 2), std::exp(-epsilon / 2), std::exp(epsilon));
  const auto r =
      run<mechanics::Rattle4>(body, {0, body.affine(axes.asDiagonal()), body.make_vector()}, end, 10, 6 * degree);
  EXPECT_TRUE(r.finished()) << r.result.reason;
  for (const auto& s : r.states) h.push_back((body.space().affine_part(s.q)(2, 2) - 1) / epsilon);
  return h;
}

/// The root of the mean square over the times, of degrees 3 … 11.
TEST(SmallRelease, ErrorsOfTheResponseFallWithTheDegree) {
  std::vector<ErrorPoint> points;
  for (const int N : {3, 5, 7, 9, 11}) {
    const auto h = response(N);
    ASSERT_EQ(h.size(), 11u);
    double squares = 0;
    for (const auto& [time, exact] : exact_response)
      squares += std::pow(h[static_cast<std::size_t>(std::lround(2 * time))] - exact, 2);
    points.push_back({1.0 / N, std::sqrt(squares / std::size(exact_response))});
  }
  const double rate = std::log(points.front().error / points.back().error) / std::log(11.0 / 3);
  EXPECT_GT(rate, 2);
  EXPECT_LT(points.back().error, 2e-3);
}

/// cos √10τ: 1.5 away from the exact response within the time.
TEST(SmallRelease, DegreeOneIsThePseudoRigidBody) {
  const auto h = response(1);
  for (std::size_t k = 0; k < h.size(); ++k)
    EXPECT_NEAR(h[k], std::cos(std::sqrt(10.0) * 0.5 * static_cast<double>(k)), 1e-4);
}

}  // namespace
}  // namespace pseudorigid::testing
