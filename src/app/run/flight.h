#pragma once
/// Free flight of a body until its first contact with a plane. A pilot run, which looks for the step, begins shortly
/// before that contact: a shorter one would not see it. The body is moved along the path of its centre under the
/// uniform acceleration b; its deformation at the contact is another one, with stretches of the same size.

#include <cmath>
#include <optional>

#include "loads/contact.h"

namespace pseudorigid::app {

struct Flight {
  double duration;
  Eigen::Vector3d displacement, velocity_change;
};

/// Nothing if the body touches, does not approach a plane, or is moved by other loads than b.
inline std::optional<Flight> flight_to_contact(const loads::Contact& now, const Eigen::Vector3d& velocity,
                                               const loads::Forcing& loads) {
  constexpr double margin = 0.01;  // radii above the plane
  const double height = now.height - margin, v = now.normal.dot(velocity), b = now.normal.dot(loads.acceleration);
  if (!std::isfinite(now.height) || height <= 0 || !loads.quadratic.isZero(0) || loads.drag != 0) return {};
  // height + v t + b t²/2 = 0, in the form without cancellation for an approach
  const double root = v * v - 2 * b * height;
  if (root < 0) return {};
  const double divisor = -v + std::sqrt(root);
  if (!(divisor > 0)) return {};
  const double t = 2 * height / divisor;
  return Flight{t, t * (velocity + t / 2 * loads.acceleration), t * loads.acceleration};
}

}  // namespace pseudorigid::app
