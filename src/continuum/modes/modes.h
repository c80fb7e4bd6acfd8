#pragma once
/// The lowest eigenfrequencies of the ball at rest, from all eight parity sectors of one octant (parity_sector.h).
///
/// A mode of kind and degree n of the sphere comes 2n+1 times, spread over the sectors; on a mesh the copies differ by
/// the mesh's error. They are told apart by kind and degree of their surface (surface_harmonics.h), and the lowest 2n+1
/// of one class are its fundamental, the next its first overtone (mechanics/equilibria/mode_groups.h). Rigid motions
/// are left out.
///
/// A sector's list is complete up to the largest eigenvalue that the last run of the iteration found in the complement
/// of all that was known before: the search in the sectors continues until their lists are complete up to all wanted
/// frequencies.

#include <cstdint>
#include <functional>
#include <vector>

#include "continuum/kernels/cell_kernels.h"
#include "continuum/modes/parity_sector.h"
#include "continuum/modes/surface_harmonics.h"
#include "mechanics/core/status.h"

namespace pseudorigid::continuum {

/// One frequency with its 2n+1 modes. Internal units. For unstable motions ω is negative, and −ω is the growth rate.
struct BallFrequency {
  double omega;  ///< mean of the copies
  double least,
      largest;  ///< frequencies of the copies, which differ because the mesh breaks the symmetry of the sphere
  ModeKind kind;
  int degree;
  int overtone;      ///< 0: the fundamental
  int multiplicity;  ///< 2·degree + 1
  double share;      ///< least share of the class in a copy's surface displacement
  Parity parity;     ///< of the shape
  Vector shape;      ///< one of the modes, on the octant, with largest nodal displacement 1
};

struct ModesReport {
  long n_applications = 0;  ///< of the inverse operator
  int n_eigenpairs = 0;
};

/// The lowest n_frequencies, by rising omega. `give_up` is asked between Krylov runs; a failure if it says so.
mechanics::Status ball_modes(const RestProblem& problem, int n_frequencies, std::vector<BallFrequency>& frequencies,
                             ModesReport& report, const std::function<bool()>& give_up = {});

/// Displacements of the whole ball at the points of nodal_blocks(space), three a point.
std::vector<double> mode_displacement(const BallSpace& space, const Parity& parity, const Vector& shape);

}  // namespace pseudorigid::continuum
