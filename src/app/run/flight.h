#pragma once
/// The free flight of a body until its first contact with a plane. A pilot run begins shortly before this contact,
/// because a short pilot run from the start would not contain the contact. The body is shifted along the path of its
/// centre of mass under the uniform acceleration b. The shifted body has the deformation of the start. A body in free
/// flight would have another deformation, with stretches of the same size.

#include <cmath>
#include <optional>

#include "loads/contact.h"

namespace pseudorigid::app {

struct Flight {
  double duration;
  Eigen::Vector3d displacement, velocity_change;
};

/// Empty if there is no plane, or if the body is less than 0.01 radii above the nearest plane. Also empty if its path
/// does not reach the plane, or if a quadratic potential or a drag acts.
inline std::optional<Flight> flight_to_contact(const loads::Contact& now, const Eigen::Vector3d& velocity,
                                               const loads::Forcing& loads) {
  constexpr double margin = 0.01;  // radii above the plane at the end of the flight
  const double height = now.height - margin, v = now.normal.dot(velocity), b = now.normal.dot(loads.acceleration);
  if (!std::isfinite(now.height) || height <= 0 || !loads.quadratic.isZero(0) || loads.drag != 0) return {};
  // Solves height + v t + b t²/2 = 0 by the formula that has no cancellation for v < 0, the velocity of an approach.
  const double root = v * v - 2 * b * height;
  if (root < 0) return {};
  const double divisor = -v + std::sqrt(root);
  if (!(divisor > 0)) return {};
  const double t = 2 * height / divisor;
  return Flight{t, t * (velocity + t / 2 * loads.acceleration), t * loads.acceleration};
}

}  // namespace pseudorigid::app
