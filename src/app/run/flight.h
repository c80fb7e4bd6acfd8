#pragma once
/// The free flight of a body until its first contact with a plane. A pilot run begins shortly before this contact,
/// because a short pilot run from the start would not contain the contact. The body is shifted along the path of its
/// centre of mass under the uniform acceleration b. The shifted body has the deformation of the start. A body in free
/// flight would have another deformation, with stretches of the same size. If the plane moves, the flight is relative
/// to the plane, which is taken to keep its present speed. The pilot run begins with the present position of the plane.

#include <algorithm>
#include <cmath>
#include <optional>

#include "loads/contact.h"

namespace pseudorigid::app {

/// A free flight in internal units. `displacement` is relative to the plane.
struct Flight {
  double duration;
  Eigen::Vector3d displacement, velocity_change;
};

/// The flight from the present state to a height of 0.01 radii above the nearest plane. `velocity` is the velocity of
/// the centre of mass. Empty if there is no plane, or if the body is at most 0.01 radii above the nearest plane. Also
/// empty if its path does not reach the plane, or if a quadratic potential or a drag acts.
inline std::optional<Flight> flight_to_contact(const loads::Contact& now, const Eigen::Vector3d& velocity,
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

/// Estimate of the largest penetration δ of the unit ball in its first contact, from the energy of a rigid ball, in
/// internal units. A ball with the closing speed v has δ³ = 2v²/k, with the stiffness k of all planes. A ball that
/// rests under the acceleration b towards the plane has δ² = 4b/(3k). The estimate is the larger one, but at most half
/// a radius.
inline double depth_of_contact(const loads::Contact& now, const Eigen::Vector3d& velocity,
                               const loads::Forcing& loads) {
  const double k = loads.planes.stiffness_of_all(), v = std::max(0.0, now.speed - now.normal.dot(velocity));
  const double b = std::max(0.0, -now.normal.dot(loads.acceleration));
  return std::min(0.5, std::max(std::cbrt(2 * v * v / k), std::sqrt(4 * b / (3 * k))));
}

}  // namespace pseudorigid::app
