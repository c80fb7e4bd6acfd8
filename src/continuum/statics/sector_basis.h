#pragma once
/// A basis of displacements of one parity, for the projection of the equations of small motions about a figure of
/// equilibrium (figure_stability.h).

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "continuum/modes/parity_sector.h"
#include "continuum/parallel/sector_ranks.h"
#include "continuum/statics/tangent_problem.h"

namespace pseudorigid::continuum {

/// A basis of displacements u of one parity. The vectors of the basis satisfy G u = 0, and are orthonormal in the inner
/// product of the mass. They span eigenvectors, responses and other displacements, which are added in this order.
/// A rank that does not own the sector (SectorRanks) receives the vectors from the owner.
class SectorBasis {
 public:
  /// A vector is not added to a basis if the part of the vector that is orthogonal to the basis is shorter than this
  /// fraction of the vector.
  static constexpr double dependent = 1e-8;

  /// `number` is the argument of parity_of_sector. `is_mine` is true if this rank owns the sector. Only the owner adds
  /// vectors.
  SectorBasis(const TangentProblem& problem, int number, const SectorRanks& ranks, bool is_mine)
      : sector_(problem, parity_of_sector(number)), ranks_(ranks), is_mine_(is_mine) {}

  bool is_mine() const { return is_mine_; }
  /// Adds the eigenvectors of K for the n lowest eigenvalues, without uniform translations and without the eigenvector
  /// `known` if it is not null. Must be called before add_responses and add_projected, because this function factorises
  /// the operator of the sector.
  mechanics::Status add_eigenvectors(int n, const Vector* known);
  std::size_t n_eigenvectors() const { return eigenvectors_.size(); }
  Vector eigenvector(std::size_t i) const { return sector_.field_of(eigenvectors_[i]); }
  /// Adds the static responses to the forces, one for each eigenvector of the other basis of the class.
  mechanics::Status add_responses(const std::vector<Vector>& forces);
  /// Adds a displacement near u that satisfies G u = 0.
  void add_projected(const Vector& u) { others_.push_back(sector_.without_volume(sector_.entries_of(u))); }
  /// Sends the eigenvectors, or all other added vectors, to the other ranks. Collective.
  void share_eigenvectors() { ranks_.share(is_mine_, sector_.mass().size(), eigenvectors_); }
  void share_others();
  /// Makes the basis of the first n eigenvectors, the first n responses and all other displacements.
  void span(std::size_t n);

  /// Makes the basis of the images of the vectors of another basis, under a symmetry `image` of the figure and the mesh
  /// that maps the other parity to this one. No other vectors need to be added.
  template <class Image>
  void span_images(const SectorBasis& other, const Image& image) {
    basis_.clear();
    for (Eigen::Index i = 0; i < other.size(); ++i) basis_.push_back(sector_.entries_of(image(other.field(i))));
  }

  const ParitySector& sector() const { return sector_; }
  Eigen::Index size() const { return static_cast<Eigen::Index>(basis_.size()); }
  const Eigen::VectorXd& operator[](Eigen::Index i) const { return basis_[static_cast<std::size_t>(i)]; }
  Vector field(Eigen::Index i) const { return sector_.field_of((*this)[i]); }
  /// The sum of the vectors of the basis with the coefficients z.
  Vector combination(const Eigen::VectorXd& z) const;
  /// The coordinates uᵀM b of a field u in the basis, for each vector b of the basis.
  Eigen::VectorXd coordinates(const Vector& u) const;
  /// The matrix with the entries bᵀK b' for the vectors b and b' of the basis. `shift` is the shift s of the problem.
  /// The operator of the sector is K + s M, so the function subtracts s from the diagonal. Collective.
  Eigen::MatrixXd stiffness(double shift) const;

 private:
  /// The uniform translation u in the sector, or else `known`, as the vector M^½ u of length 1, which is an argument of
  /// ParitySector::apply. The result has no column if there is neither.
  Eigen::MatrixXd left_out(const Vector* known) const;
  /// Appends the part of u that is orthogonal to the basis, divided by its length. Omits this part if it is short
  /// (`dependent`).
  void append(Eigen::VectorXd u);

  ParitySector sector_;
  const SectorRanks& ranks_;
  bool is_mine_;
  std::vector<Eigen::VectorXd> eigenvectors_, responses_, others_;
  std::vector<Eigen::VectorXd> basis_;
};

}  // namespace pseudorigid::continuum
