#pragma once
/// The free flight of a body until its first contact with a plane. A pilot run begins shortly before this contact,
/// because a short pilot run from the start of the run would not contain the contact. The body is shifted along the
/// path of its centre of mass under the uniform acceleration b of the loads. The shifted body has the deformation of
/// the start. A body in free flight would have another deformation, with stretches of the same size. If the plane
/// moves, the flight is relative to the plane, which is assumed to keep its present speed. The pilot run begins with
/// the present position of the plane.

#include <optional>

#include "loads/contact.h"
#include "loads/forcing.h"

namespace pseudorigid::app {

/// A free flight in internal units. `displacement` is the displacement of the body relative to the plane.
/// `velocity_change` is the change of the velocity of its centre of mass.
struct Flight {
  double duration;
  Eigen::Vector3d displacement, velocity_change;
};

/// The flight from the present state to a height of 0.01 radii above the nearest plane. `now` is the present contact,
/// `velocity` is the velocity of the centre of mass, and `loads` contains b. Empty if there is no plane, or if the body
/// is at most 0.01 radii above the nearest plane. Also empty if the path does not reach the plane, or if a quadratic
/// potential or a drag acts.
std::optional<Flight> flight_to_contact(const loads::Contact& now, const Eigen::Vector3d& velocity,
                                        const loads::Forcing& loads);

/// Estimate of the largest penetration δ of the unit ball in its first contact, in internal units. It is based on the
/// energy or the weight of a rigid ball. A ball with the closing speed v has δ³ = 2v²/k. The stiffness k is the upper
/// bound Planes::stiffness_of_all for all planes. A ball that rests under the acceleration b towards the plane has δ² =
/// 4b/(3k). The result is the larger δ, but at most half a radius.
double depth_of_contact(const loads::Contact& now, const Eigen::Vector3d& velocity, const loads::Forcing& loads);

}  // namespace pseudorigid::app
