#pragma once
/// Search of the nodes of a mesh by their reference positions X.

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

#include "continuum/mesh/ball_space.h"

namespace pseudorigid::continuum {

/// The reference position of a node that this rank owns.
inline Eigen::Vector3d reference_position(const BallSpace& space, unsigned int node) {
  const Vector& X = space.reference_positions();
  return {X.local_element(3 * node), X.local_element(3 * node + 1), X.local_element(3 * node + 2)};
}

class NodesByPlace {
 public:
  /// The nodes of the mesh that this rank owns.
  explicit NodesByPlace(const BallSpace& space) {
    for (unsigned int node = 0; node < space.n_nodes(); ++node)
      node_at_[rounded(reference_position(space, node))] = node;
  }
  /// Local number of the node at X, up to 1e-9 in each coordinate. Throws std::logic_error if this rank does not own
  /// such a node.
  unsigned int at(const Eigen::Vector3d& X) const {
    const std::array<long, 3> place = rounded(X);
    // The rounded coordinates of the node may differ by one unit in each direction.
    for (auto near = node_at_.lower_bound({place[0] - 1, 0, 0});
         near != node_at_.end() && near->first[0] <= place[0] + 1; ++near)
      if (std::abs(near->first[1] - place[1]) <= 1 && std::abs(near->first[2] - place[2]) <= 1) return near->second;
    throw std::logic_error("the mesh does not have a node at a required place");
  }

 private:
  static std::array<long, 3> rounded(const Eigen::Vector3d& X) {
    return {std::lround(1e9 * X[0]), std::lround(1e9 * X[1]), std::lround(1e9 * X[2])};
  }
  std::map<std::array<long, 3>, unsigned int> node_at_;
};

}  // namespace pseudorigid::continuum
