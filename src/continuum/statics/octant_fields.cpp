#include "continuum/statics/octant_fields.h"

#include <cmath>

#include "continuum/mesh/nodes_by_place.h"

namespace pseudorigid::continuum {
OctantContinuation::OctantContinuation(const BallSpace& octant, const BallSpace& sector) {
  const NodesByPlace nodes(octant);
  for (unsigned int node = 0; node < sector.n_nodes(); ++node) {
    const Eigen::Vector3d X = reference_position(sector, node);
    unsigned int reflected = 0;
    for (unsigned int j = 0; j < 3; ++j)
      if (X[j] < 0) reflected |= 1U << j;
    images_.push_back({nodes.at(X.cwiseAbs()), reflected});
  }
}

void OctantContinuation::add(double factor, const Parity& parity, const Vector& u, Vector& field) const {
  for (unsigned int node = 0; node < images_.size(); ++node) {
    int sign = 1;
    for (unsigned int j = 0; j < 3; ++j)
      if (images_[node].reflected >> j & 1) sign *= parity.sign[j];
    for (unsigned int c = 0; c < 3; ++c) {
      const int of_component = images_[node].reflected >> c & 1 ? -sign : sign;
      field.local_element(3 * node + c) += factor * of_component * u.local_element(3 * images_[node].node + c);
    }
  }
}

double mean_square(const BallSpace& octant, const SmallMotionOfBall& motion) {
  double sum = 0, mass = 0;
  for (unsigned int i = 0; i < 3 * octant.n_nodes(); ++i) {
    const double m = octant.mass().local_element(i);
    mass += m / 3;
    for (const auto& part : motion.parts)
      sum += m * (std::pow(part.real.local_element(i), 2) + std::pow(part.imaginary.local_element(i), 2));
  }
  return sum / mass;
}

mechanics::PhaseDisplacements at_phase_points(const BallSpace& octant, const SmallMotionOfBall& motion) {
  const NodesByPlace nodes(octant);
  mechanics::PhaseDisplacements u = mechanics::PhaseDisplacements::Zero();
  Eigen::Index k = 0;
  for (const Eigen::Vector3d& X : mechanics::phase_points()) {
    const unsigned int node = nodes.at(X);
    for (unsigned int c = 0; c < 3; ++c)
      for (const auto& part : motion.parts)
        u(c, k) +=
            std::complex<double>(part.real.local_element(3 * node + c), part.imaginary.local_element(3 * node + c));
    ++k;
  }
  return u;
}

}  // namespace pseudorigid::continuum
