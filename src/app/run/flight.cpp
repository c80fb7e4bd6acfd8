#include "app/run/flight.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "loads/contact.h"

namespace pseudorigid::app {

std::optional<Flight> flight_to_contact(const loads::Contact& now, const Eigen::Vector3d& velocity,
                                        const loads::Forcing& loads) {
  constexpr double margin = 0.01;  // radii above the plane at the end of the flight
  const double height = now.height - margin, v = now.normal.dot(velocity) - now.speed,
               b = now.normal.dot(loads.acceleration);
  if (!std::isfinite(now.height) || height <= 0 || !loads.quadratic.isZero(0) || loads.drag != 0) return {};
  // Solves height + v t + b t²/2 = 0. This form of the solution has no cancellation if v < 0, as in an approach.
  const double root = v * v - 2 * b * height;
  if (root < 0) return {};
  const double divisor = -v + std::sqrt(root);
  if (!(divisor > 0)) return {};
  const double t = 2 * height / divisor;
  return Flight{t, t * (velocity + t / 2 * loads.acceleration) - t * now.speed * now.normal, t * loads.acceleration};
}

double depth_of_contact(const loads::Contact& now, const Eigen::Vector3d& velocity, const loads::Forcing& loads) {
  const double k = loads.planes.stiffness_of_all(), v = std::max(0.0, now.speed - now.normal.dot(velocity));
  const double b = std::max(0.0, -now.normal.dot(loads.acceleration));
  return std::min(0.5, std::max(std::cbrt(2 * v * v / k), std::sqrt(4 * b / (3 * k))));
}

}  // namespace pseudorigid::app
