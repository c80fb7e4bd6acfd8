#pragma once
/// Transfer between two levels of the multigrid preconditioner (multigrid.h). Both levels have the cells of one mesh
/// and different degrees, or each cell of the coarser level consists of eight cells of the finer one. A cell of the
/// finer level with the coordinates ξ is then the part (b + ξ)/2 of its coarser cell, with b_d = 0 or 1 in each
/// direction.
///
/// The ranks of the finer level share its cells. Either they share the cells of the coarser level in the same way, or
/// each of them has all cells of the coarser level. All functions are collective.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "continuum/mesh/ball_space.h"
#include "continuum/modes/cell_stiffness.h"

namespace pseudorigid::continuum {

/// The numbers c of all cells.
using StiffnessCoefficients = std::vector<PointCoefficients>;

class MultigridTransfer {
 public:
  /// Both spaces must exist as long as the object.
  MultigridTransfer(const BallSpace& finer, const BallSpace& coarser);

  /// f = Pᵀ r for a force r on the finer level, with the interpolation P of displacements. Components that a plane of
  /// the octant fixes are 0.
  void restrict_to_coarser(const Vector& r, Vector& f) const;
  /// result ← result + P u for a displacement u on the coarser level.
  void add_interpolated(const Vector& u, Vector& result) const;
  /// The values of a field of the finer level at the nodes of the coarser one.
  Vector at_coarser_nodes(const Vector& x) const;
  /// The numbers c of the coarser level from those of the finer one. Each number per volume is interpolated.
  StiffnessCoefficients at_coarser_points(const StiffnessCoefficients& c) const;

 private:
  /// The coarser cell of a cell of the finer level, and b; b is 0 if the cells are equal.
  struct Part {
    unsigned int cell;
    std::array<std::size_t, 3> b;
  };
  /// The Lagrange polynomials of a finer cell with given b at points of the coarser cell, in one direction. Only the
  /// rows of points that the finer cell contains are used: those with half[point] = b.
  struct Evaluation {
    std::array<Eigen::MatrixXd, 2> table;  ///< [b](point, polynomial)
    std::vector<std::size_t> half;
  };
  Evaluation evaluation(const std::vector<double>& nodes, const std::vector<double>& points) const;
  /// Calls use(q, value) for each point q of the coarser cell in the finer cell `part`, with the value of the function
  /// of the finer cell.
  template <class Use>
  static void evaluate(const Evaluation& at, const Part& part, const Eigen::VectorXd& of_finer, const Use& use);

  /// Completes sums at the nodes of the coarser level, to which the cells of each rank have contributed.
  void complete_sums(Vector& f) const;

  const BallSpace &finer_, &coarser_;
  bool halves_;   ///< true if the cells of the finer level are parts of those of the coarser level
  bool gathers_;  ///< true if the ranks share the finer level, and each has the whole coarser level
  std::vector<Part> parts_;
  std::array<Eigen::MatrixXd, 2> interpolation_;  ///< Lagrange polynomials of the coarser cell: [b](finer node, node)
  std::vector<double> share_;  ///< of each finer node, with the ghost nodes, 1 over the number of its cells
};

}  // namespace pseudorigid::continuum
