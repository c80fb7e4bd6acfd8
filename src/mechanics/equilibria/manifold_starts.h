#pragma once
/// Initial states of motions on the unstable and the stable manifold of a critical point q*. The states are q = q* + x,
/// q̇ = y with a small displacement (x, y) in a sum of eigenspaces of the linearised field. The eigenspace for a rate z
/// with the direction δ is spanned by the pairs (Re δ, Re zδ) and (Im δ, Im zδ). Up to terms of second order in (x, y),
/// the states are on the manifold (Oliva, Geometric Mechanics, 5.8.3).
///
/// If a point has several unstable directions, displacements of equal initial size in all of them would grow into
/// motions along the fastest direction only. The slowest direction has the rate z_min and the initial size ε. The
/// initial size in a direction with the rate z is therefore ε^{Re z/Re z_min}. The displacements in all directions then
/// reach order 1 at the same time.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <vector>

#include "mechanics/equilibria/critical_point.h"

namespace pseudorigid::mechanics {

/// A displacement of a state. `q` is the displacement x of the position, and `v` is the displacement y of the velocity.
struct PhaseVector {
  Eigen::VectorXd q, v;
  double rate = 0;  ///< growth or decay rate |Re z|; for a sum of directions, the slowest of their rates
};

/// Returns a basis of the tangent space of the unstable manifold at p, or of the stable manifold if `unstable` is
/// false. Vectors with the fastest rates come first. The basis is empty if the manifold consists of p alone.
inline std::vector<PhaseVector> manifold_basis(const CriticalPoint& p, bool unstable) {
  constexpr double zero_rate = 1e-6;  // the value of zero_rate in critical_point.cpp
  const double zero = zero_rate * (p.rates.size() > 0 ? p.rates.cwiseAbs().maxCoeff() : 0);
  std::vector<Eigen::Index> order;
  for (Eigen::Index i = 0; i < p.rates.size(); ++i)
    if ((unstable ? 1 : -1) * p.rates[i].real() > zero && p.rates[i].imag() >= 0) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](Eigen::Index i, Eigen::Index j) {
    return std::abs(p.rates[i].real()) > std::abs(p.rates[j].real());
  });
  std::vector<PhaseVector> basis;
  for (const Eigen::Index i : order) {
    Eigen::VectorXcd delta = p.directions.col(i);
    Eigen::Index largest;
    delta.cwiseAbs().maxCoeff(&largest);
    delta *= std::conj(delta[largest]) / std::abs(delta[largest]);  // fixes the arbitrary phase
    const Eigen::VectorXcd velocity = p.rates[i] * delta;
    const double rate = std::abs(p.rates[i].real());
    basis.push_back({delta.real(), velocity.real(), rate});
    if (p.rates[i].imag() > 0) basis.push_back({delta.imag(), velocity.imag(), rate});
  }
  return basis;
}

/// Returns the displacements (x, y) that are ε and −ε times each vector of the basis.
inline std::vector<PhaseVector> both_ways(const std::vector<PhaseVector>& basis, double epsilon) {
  std::vector<PhaseVector> starts;
  for (const PhaseVector& e : basis)
    for (const double part : {epsilon, -epsilon}) starts.push_back({part * e.q, part * e.v, e.rate});
  return starts;
}

/// Returns n displacements (x, y) = Σ c_i s_i e_i, with the basis vectors e_i and a unit vector c. The size s_i is the
/// initial size defined at the top of this file, or 1e-12 if this is larger. If the basis has two vectors, the unit
/// vectors c are at equal angles. Otherwise they are random with a fixed seed. The basis must not be empty.
inline std::vector<PhaseVector> all_around(const std::vector<PhaseVector>& basis, int n, double epsilon) {
  constexpr double least = 1e-12;  // least size for a fast direction, above the round-off of q*
  std::vector<double> sizes;
  for (const PhaseVector& e : basis) sizes.push_back(std::max(least, std::pow(epsilon, e.rate / basis.back().rate)));
  std::mt19937_64 generator(1);
  std::normal_distribution<double> normal;
  std::vector<PhaseVector> starts;
  for (int k = 0; k < n; ++k) {
    Eigen::VectorXd part(static_cast<Eigen::Index>(basis.size()));
    if (basis.size() == 2) {
      // If the angle of c is a multiple of π/2, c has the entries 0 and ±1 without round-off.
      const double quarters = 4.0 * k / n, whole = std::round(quarters),
                   angle = (quarters - whole) * std::numbers::pi / 2;
      const double c = std::cos(angle), s = std::sin(angle);
      const Eigen::Vector2d turned[] = {{c, s}, {-s, c}, {-c, -s}, {s, -c}};
      part = turned[static_cast<int>(whole) % 4];
    } else {
      for (double& x : part) x = normal(generator);
      part.normalize();
    }
    PhaseVector start{0 * basis[0].q, 0 * basis[0].v, basis.back().rate};
    for (std::size_t i = 0; i < basis.size(); ++i) {
      start.q += part[static_cast<Eigen::Index>(i)] * sizes[i] * basis[i].q;
      start.v += part[static_cast<Eigen::Index>(i)] * sizes[i] * basis[i].v;
    }
    starts.push_back(start);
  }
  return starts;
}

}  // namespace pseudorigid::mechanics
