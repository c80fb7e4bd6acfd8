#pragma once
/// The matrices of the linear equations for small displacements of the ball, cell by cell. parity_sector.h has the
/// equations and solves them in the parity sectors. K is the stiffness, M is the mass, and G is the derivative of the
/// constraint. With a shift s and a penalty γ, B = K + s M + γGᵀG.

#include <Eigen/Core>
#include <functional>
#include <numbers>
#include <vector>

#include "continuum/kernels/cell_kernels.h"
#include "continuum/mesh/ball_space.h"
#include "continuum/mesh/surface_faces.h"

namespace pseudorigid::continuum {

class ParitySector;

/// A function that returns the product of a symmetric operator with a vector u of the unknowns of a sector.
using SectorOperator = std::function<Eigen::VectorXd(const Eigen::VectorXd& u)>;

/// The operator E of the forces that couple more unknowns than the stiffness of the cells (parity_sector.h). It is a
/// function that returns the product E u, or a symmetric matrix of a few unknowns. All members are empty if there are
/// no such forces.
struct BeyondCells {
  SectorOperator product{};              ///< E u
  std::vector<Eigen::Index> unknowns{};  ///< ascending indices, in the vectors of the sector, of the rows of `matrix`
  Eigen::MatrixXd matrix{};              ///< E, which is then factorised together with B
};

/// Springs on a face of a cell, one for each row r of a matrix, with the energy ½(r·u)². The vector u has the
/// displacements of the nodes on the face. Its entries are the entries `places` of the displacements of all nodes of
/// the cell, which have the index 3·node + component.
struct FaceSprings {
  unsigned int cell;
  std::vector<Eigen::Index> places;
  Eigen::MatrixXd rows;
};

/// Returns a spring for each quadrature point of the free surface. It acts along the vector `along(point)`, and its
/// stiffness is the square of the length of this vector times the quadrature weight.
std::vector<FaceSprings> springs_at_surface(const BallSpace& space,
                                            const std::function<Eigen::Vector3d(const FacePoint& point)>& along);

/// The product ρg of density and gravity at the surface of the ball, g = (4/3)πGρr, in internal units with ρ = r = 1. G
/// is Newton's constant.
inline double weight_of_density(double G) { return 4 * std::numbers::pi / 3 * G; }

/// The data that all parity sectors use: the space, and the stiffness and the constraint of every cell.
struct LinearProblem {
  virtual ~LinearProblem() = default;
  /// The operator E in a sector. The result may refer to the sector, which must outlive it.
  virtual BeyondCells beyond_cells(const ParitySector&) const { return {}; }

  const BallSpace& space;
  bool incompressible;
  /// Shift s of an eigenvalue problem. It is 0 in a static problem, for a stable ball in a sector without rigid
  /// motions.
  double shift = 0;
  /// A stiffness per mass for each component, in addition to the stiffness of the cells. Its product with the mass is
  /// added to the diagonal of B.
  Eigen::Vector3d of_mass = Eigen::Vector3d::Zero();
  double penalty = 0;                         ///< penalty γ of the augmented Lagrangian; 0 for a compressible body
  std::vector<Eigen::MatrixXd> stiffness{};   ///< K of each cell
  std::vector<Eigen::MatrixXd> constraint{};  ///< G of each cell; empty for a compressible body
  std::vector<bool> is_shared{};  ///< nodes of several cells, and nodes of the free surface if E is a matrix

  /// Sets `shift` and `penalty`. Must be called before a sector of this problem is made. The penalty of an
  /// incompressible body is 10⁶ times its stiffness in an eigenvalue problem, which then needs no corrections of G u.
  /// In a static problem it is 10⁴ times the stiffness, because a larger penalty amplifies the round-off of responses
  /// and multipliers.
  void set_shift(double s) {
    shift = s;
    penalty = incompressible ? (s > 0 ? 1e6 : 1e4) * stiffness_of_body_ : 0;
  }

 protected:
  /// `space` must be that of an octant in one process. `stiffness_of_body` is the larger of the shear modulus and ρg in
  /// internal units.
  LinearProblem(const BallSpace& ball_space, bool is_incompressible, double of_shift, double stiffness_of_body)
      : space(ball_space), incompressible(is_incompressible), stiffness_of_body_(stiffness_of_body) {
    set_shift(of_shift);
  }
  LinearProblem(const LinearProblem&) = default;
  /// Sets `constraint` to G at the positions x.
  void set_constraint(const CellKernels& kernels, const Vector& x);
  /// Sets `stiffness` and `is_shared`. The function `of_cell` returns K of a cell.
  void set_stiffness(const std::function<Eigen::MatrixXd(unsigned int cell)>& of_cell);
  /// Adds springs to `stiffness`, which set_stiffness must have set.
  void add_springs(const std::vector<FaceSprings>& springs);
  /// Declares that E is a matrix of the unknowns of the free surface. Must be called after set_stiffness.
  void couple_surface();
  /// The indices, in the vectors of the sector, of the displacements of nodes on the free surface.
  std::vector<Eigen::Index> unknowns_at_surface(const ParitySector& sector) const;

 private:
  double stiffness_of_body_;
};

}  // namespace pseudorigid::continuum
