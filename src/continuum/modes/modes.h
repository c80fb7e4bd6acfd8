#pragma once
/// The lowest eigenfrequencies of the ball at rest, from the eight parity sectors of one octant (parity_sector.h). If
/// the nodes are symmetric under the cyclic permutation of the axes, only four sectors are computed. Each of the other
/// sectors has the same frequencies as one of the computed sectors.
///
/// A sphere has 2n + 1 modes for each frequency of a kind (spheroidal or toroidal) and a degree n. These modes are
/// distributed over the sectors. On a mesh, their computed frequencies differ by the error of the mesh. The modes are
/// classified by the kind and degree of their surface displacement (surface_harmonics.h). The lowest 2n + 1 modes of
/// one kind and degree are its fundamental, and the next 2n + 1 modes are its first overtone
/// (mechanics/equilibria/mode_groups.h). Rigid motions are omitted.
///
/// The eigenpairs of a sector are computed by several runs of an iteration, from the lowest frequency. Each run
/// searches the orthogonal complement of all eigenvectors found before. All modes of the sector below the lowest
/// frequency that the last run has found are therefore known. The search continues until the modes of every sector are
/// complete up to the requested frequencies.

#include <cstdint>
#include <functional>
#include <vector>

#include "continuum/kernels/cell_kernels.h"
#include "continuum/modes/rest_problem.h"
#include "continuum/modes/surface_harmonics.h"
#include "continuum/parallel/sector_ranks.h"
#include "mechanics/core/status.h"

namespace pseudorigid::continuum {

/// A frequency of the ball in internal units. A frequency of degree n has 2n + 1 modes. An unstable motion has ω < 0
/// and grows at the rate −ω.
struct BallFrequency {
  double omega;  ///< mean over the 2n + 1 modes
  /// Least and largest ω of the modes. The two values differ, because the mesh breaks the symmetry of the sphere.
  double least, largest;
  ModeKind kind;
  int degree;
  int overtone;      ///< 0 for the fundamental
  int multiplicity;  ///< number of modes, 2·degree + 1
  double share;  ///< share of kind and degree in the squared surface displacement (ModeClass); the least over the modes
  Parity parity;  ///< parity of the shape
  Vector shape;   ///< displacement of one of the modes on the octant; the largest nodal displacement is 1
};

struct ModesReport {
  long n_applications = 0;  ///< number of applications of the inverse operator
  int n_eigenpairs = 0;     ///< number of eigenpairs found, including rigid motions
};

/// Computes the lowest n_frequencies frequencies in ascending order, and adds its counts to `report`. The function
/// `give_up` may be empty. `ball_modes` calls `give_up` before each factorisation and each run of the iteration. Fails
/// if `give_up` returns true, if the ball at rest is not stable under the law, or if an iteration does not converge.
/// Also fails if the mesh is too coarse for so many frequencies. With several `ranks`, each rank solves some of the
/// sectors, and the function is collective.
mechanics::Status ball_modes(const RestProblem& problem, int n_frequencies, std::vector<BallFrequency>& frequencies,
                             ModesReport& report, const std::function<bool()>& give_up = {},
                             const SectorRanks& ranks = {});

/// Returns the displacements of a mode on the whole ball, at the points of nodal_blocks(space), with three numbers for
/// each point. `shape` has the displacements on the octant, and `parity` their parity.
std::vector<double> mode_displacement(const BallSpace& space, const Parity& parity, const Vector& shape);

}  // namespace pseudorigid::continuum
