#pragma once
/// The parity of a motion u of the whole ball. With the reflection R_i of the coordinate i, bit i of the parity is set
/// if the motion is odd: u(R_i X) = −R_i u(X). The bit is not set if u(R_i X) = R_i u(X). The component u_j of a motion
/// therefore has the parity of the motion with bit j changed. A constraint acts only on motions with the parity of its
/// pressure function, because the divergence of a motion has the parity of the motion. At a state with the symmetry of
/// an octant, the stiffness maps motions of each of the eight parities to motions of the same parity. The spaces in
/// this file must not have symmetry planes.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "polynomial/polynomial_space.h"

namespace pseudorigid::polynomial {

inline constexpr int n_parities = 8;

/// For each parity, the indices of the coefficients of all motions with this parity.
inline std::array<std::vector<int>, n_parities> unknowns_by_parity(const PolynomialSpace& space) {
  std::array<std::vector<int>, n_parities> places;
  for (const Block& block : space.blocks())
    for (int a = 0; a < block.n(); ++a) places[block.parity ^ 1U << block.component].push_back(block.offset + a);
  return places;
}
/// For each parity, the indices of the coefficients of all pressures with this parity.
inline std::array<std::vector<int>, n_parities> pressures_by_parity(const PolynomialSpace& space) {
  std::array<std::vector<int>, n_parities> places;
  for (const Block& block : space.pressure_blocks())
    for (int b = 0; b < block.n(); ++b) places[block.parity].push_back(block.offset + b);
  return places;
}

/// The matrix K with K u = −force_rate(u) on the whole ball, symmetrised. The function calls force_rate for a sum of
/// motions, one of each parity. The part of the result that belongs to a parity is due to the motion of this parity.
/// One call therefore gives a column of K for each parity.
template <class ForceRate>
Eigen::MatrixXd stiffness_by_parity(const PolynomialSpace& space, const ForceRate& force_rate) {
  const auto places = unknowns_by_parity(space);
  std::size_t n_calls = 0;
  for (const auto& of_parity : places) n_calls = std::max(n_calls, of_parity.size());
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(space.n_unknowns(), space.n_unknowns());
  for (std::size_t call = 0; call < n_calls; ++call) {
    Eigen::VectorXd u = Eigen::VectorXd::Zero(space.n_unknowns());
    for (const auto& of_parity : places)
      if (call < of_parity.size()) u[of_parity[call]] = 1;
    const Eigen::VectorXd image = force_rate(u);
    for (const auto& of_parity : places)
      if (call < of_parity.size())
        for (const int i : of_parity) K(i, of_parity[call]) = -image[i];
  }
  return 0.5 * (K + K.transpose());
}

}  // namespace pseudorigid::polynomial
