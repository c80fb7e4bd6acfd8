#pragma once
/// Parameters of a pseudo-rigid body as plain numbers, for the kernels of gauss_body_kernels.h. These kernels evaluate
/// the body at the eight stages of a Gauss step at once. Matrices are stored by columns, as in Eigen. E₀ is the inertia
/// of the reference body (reference_body.h).

#include <array>
#include <cstddef>

#include "loads/forcing.h"
#include "loads/list.h"
#include "materials/law_table.h"
#include "mechanics/core/gauss_stages.h"
#include "reduced/dissipation.h"
#include "reduced/reference_body.h"

namespace pseudorigid::reduced {

using Numbers9 = std::array<double, 9>;

/// The body and its loads that do not depend on time, in internal units.
struct BodyOfStages {
  materials::AnyLaw law{materials::Fluid{}};
  bool incompressible = true;
  bool isotropic = true;                 ///< true if E₀ is a multiple of Id
  double volume = 1, inverse_m_bar = 1;  ///< volume Vol, and 1/m̄ with m̄ = ⅓ tr E₀
  Numbers9 E0{}, E0_inverse{};

  bool loaded = false;          ///< true if self-gravity, quadratic potential, traction or pressure is not 0
  double gravity_strength = 0;  ///< (3/5) G M², with the gravitational constant G and the mass M
  Numbers9 shape{};             ///< matrix S of the shape (reference_body.h)
  Numbers9 quadratic{};         ///< quadratic potential T per mass (external_potential.h)
  Numbers9 nominal_traction{};  ///< nominal traction P̄ (external_potential.h)
  double pressure = 0;
};

/// Further parameters of a body that dissipates energy or has loads that depend on time (dissipative_body.h).
struct AccountsOfStages {
  double viscosity = 0, drag = 0;
  bool driven = false;  ///< true if a load depends on time
  /// The matrices T and P̄ and the pressure of the loads that depend on time, at the eight stages. `driving_rate` has
  /// the derivatives of these quantities with respect to time.
  struct Driving {
    std::array<mechanics::OfStages, 9> quadratic{}, nominal_traction{};
    mechanics::OfStages pressure{};
  } driving, driving_rate;
};

/// The coordinates of the body in a Gauss step. They are the entries of Q (`matrix`), the diagonal of Q (`diagonal`),
/// or the entries of Q and (s, s', 0) (`with_accounts`). The velocities of s and s' are the dissipated energy and the
/// energy that the loads have given (dissipative_body.h).
enum class BodyEntries { matrix, diagonal, with_accounts };

/// Solves for the stages of a Gauss step of the body, and sets stages.converged. `accounts` is required for
/// BodyEntries::with_accounts, and otherwise may be null. Throws NoKernels if no build of the kernels can be chosen
/// (mechanics/core/kernel_builds.h).
void solve_stages_of_body(const BodyOfStages& body, BodyEntries entries, const AccountsOfStages* accounts,
                          mechanics::GaussStages& stages);

/// Cost of an iteration on the eight stages in units of one force evaluation (mechanics/core/stage_by_stage.h).
double cost_of_iteration(const BodyOfStages& body, BodyEntries entries);

/// True if the body has no self-gravity, or if the kernels can compute the self-gravity accurately for the deformation
/// Q. For very flat or long bodies, only the computation in principal axes is accurate.
bool takes_gravity_in_lanes(const BodyOfStages& body, const Eigen::Matrix3d& Q);

/// The entries of the matrix M by columns.
Numbers9 numbers(const Eigen::Matrix3d& M);
/// Returns the parameters of a body as numbers. `isotropic` is true if E₀ ∝ Id.
BodyOfStages body_of_stages(const materials::AnyLaw& law, const ReferenceBody& body, bool incompressible,
                            bool isotropic, const loads::Forcing& forcing = {});
/// Returns the parameters of the dissipation, and those of the loads that depend on time at the times of the stages.
AccountsOfStages accounts_of_stages(const Dissipation& dissipation, const loads::Loads& driving,
                                    const mechanics::GaussStages& stages);

}  // namespace pseudorigid::reduced
