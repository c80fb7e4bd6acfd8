#pragma once
/// A pseudo-rigid body as plain numbers, for the kernels that evaluate its field at the eight stages of a Gauss step at
/// once (gauss_body_kernels.h). Matrices are in the order of Eigen's: column by column.

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

struct BodyOfStages {
  materials::AnyLaw law{materials::Fluid{}};
  bool incompressible = true;
  bool isotropic = true;  ///< E₀ ∝ Id
  double volume = 1, inverse_m_bar = 1;
  Numbers9 E0{}, E0_inverse{};

  bool loaded = false;          ///< any of the following
  double gravity_strength = 0;  ///< k = (3/5) G M²
  Numbers9 shape{};             ///< S
  Numbers9 quadratic{};         ///< T
  Numbers9 nominal_traction{};  ///< P̄
  double pressure = 0;
};

/// Further parameters of a dissipative body.
struct AccountsOfStages {
  double viscosity = 0, drag = 0;
  bool driven = false;
  /// Loads that depend on time at the stages: T, P̄ and p; `driving_rate` are their rates.
  struct Driving {
    std::array<mechanics::OfStages, 9> quadratic{}, nominal_traction{};
    mechanics::OfStages pressure{};
  } driving, driving_rate;
};

/// The entries of a stage: Q, the diagonal of Q, or Q with the energies that were taken and given.
enum class BodyEntries { matrix, diagonal, with_accounts };

/// Solves the stages of a Gauss step of the body. `accounts` is needed if the entries contain energies.
void solve_stages_of_body(const BodyOfStages& body, BodyEntries entries, const AccountsOfStages* accounts,
                          mechanics::GaussStages& stages);

/// As of mechanics/core/stage_by_stage.h.
double cost_of_iteration(const BodyOfStages& body, BodyEntries entries);

/// Whether the gravity of the body at q is to be computed in lanes: not of bodies so flat or long that only principal
/// axes keep its accuracy.
bool takes_gravity_in_lanes(const BodyOfStages& body, const Eigen::Matrix3d& Q);

Numbers9 numbers(const Eigen::Matrix3d& M);
BodyOfStages body_of_stages(const materials::AnyLaw& law, const ReferenceBody& body, bool incompressible,
                            bool isotropic, const loads::Forcing& forcing = {});
AccountsOfStages accounts_of_stages(const Dissipation& dissipation, const loads::Loads& driving,
                                    const mechanics::GaussStages& stages);

}  // namespace pseudorigid::reduced
