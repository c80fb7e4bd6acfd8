#pragma once
/// The ball of one octant with its cells distributed over ranks. Fields of this ball are exchanged with fields of the
/// whole octant, which each rank has as vectors of Eigen. The entries of such a vector have the order of a space that
/// has all cells on one rank.

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <vector>

#include "continuum/body/ball_body.h"

namespace pseudorigid::continuum {

class SharedOctant {
 public:
  /// `shared` is the ball whose cells are distributed. `whole` is the space of the same ball with all cells on this
  /// rank. Collective, as are all functions.
  SharedOctant(std::shared_ptr<const BallBody> shared, const BallSpace& whole);

  const BallBody& body() const { return *body_; }
  /// The part of this rank of a nodal field, with its ghost nodes, and of a multiplier.
  Vector part_of_field(const Eigen::VectorXd& whole) const;
  Vector part_of_multiplier(const Eigen::VectorXd& whole) const;
  /// The whole nodal field and the whole multiplier, on every rank.
  Eigen::VectorXd whole_field(const Vector& part) const;
  Eigen::VectorXd whole_multiplier(const Vector& part) const;

 private:
  Eigen::VectorXd whole(const Vector& part, const std::vector<unsigned int>& entries, Eigen::Index n) const;

  std::shared_ptr<const BallBody> body_;
  Eigen::Index n_field_, n_multiplier_;                           ///< numbers of entries of the whole octant
  std::vector<unsigned int> field_entries_, multiplier_entries_;  ///< place of each own entry in the whole octant
};

}  // namespace pseudorigid::continuum
