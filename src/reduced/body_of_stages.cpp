#include "reduced/body_of_stages.h"

#include <algorithm>

#include "reduced/motion_kernels.h"

namespace pseudorigid::reduced {

void solve_stages_of_body(const BodyOfStages& body, BodyEntries entries, const AccountsOfStages* accounts,
                          mechanics::GaussStages& stages) {
  motion_kernels().solve_stages(body, entries, accounts, stages);
}

double cost_of_iteration(const BodyOfStages& body, BodyEntries entries) {
  // The costs are approximately measured quotients: the time of an iteration divided by the time of a stage of the
  // method rattle-8, both in nanoseconds. On SL(3) the quotients are 142/250, with gravity 490/565, and with loads or
  // another inertia 220/285. For the diagonal form they are 143/182, and with gravity 436/289. On GL⁺(3) they are
  // 94/62, and with gravity 401/367. With dissipation, the quotient 297/1774 has the time of a stage of the method
  // rattle. There is no measurement for the two costs 2.
  const bool heavy = body.gravity_strength != 0, general = body.loaded || !body.isotropic;
  if (entries == BodyEntries::with_accounts) return 0.2;
  if (entries == BodyEntries::diagonal) return heavy ? 1.5 : body.incompressible ? 0.8 : 2;
  if (heavy) return body.incompressible ? 0.9 : 1.1;
  if (body.incompressible) return general ? 0.8 : 0.57;
  return general ? 2 : 1.5;
}

bool takes_gravity_in_lanes(const BodyOfStages& body, const Eigen::Matrix3d& Q) {
  // Bound of |F||F⁻¹|, which is 3 for a ball. Below this bound, the force has 14 correct digits
  // (tests/gravity/ellipsoid_in_lanes_test.cpp).
  constexpr double most = 12;
  if (body.gravity_strength == 0) return true;
  const Eigen::Matrix3d F = Q * Eigen::Map<const Eigen::Matrix3d>(body.shape.data());
  return F.norm() * F.inverse().norm() < most;
}

Numbers9 numbers(const Eigen::Matrix3d& M) {
  Numbers9 x;
  std::copy_n(M.data(), x.size(), x.begin());
  return x;
}

BodyOfStages body_of_stages(const materials::AnyLaw& law, const ReferenceBody& body, bool incompressible,
                            bool isotropic, const loads::Forcing& forcing) {
  return {.law = law,
          .incompressible = incompressible,
          .isotropic = isotropic,
          .volume = body.volume,
          .inverse_m_bar = 3 / body.E0.trace(),
          .E0 = numbers(body.E0),
          .E0_inverse = numbers(body.E0.inverse()),
          .loaded = forcing.gravity_constant != 0 || !forcing.quadratic.isZero(0) ||
                    !forcing.nominal_traction.isZero(0) || forcing.pressure != 0,
          .gravity_strength = 0.6 * forcing.gravity_constant * body.mass * body.mass,
          .shape = numbers(body.shape),
          .quadratic = numbers(forcing.quadratic),
          .nominal_traction = numbers(forcing.nominal_traction),
          .pressure = forcing.pressure};
}

AccountsOfStages accounts_of_stages(const Dissipation& dissipation, const loads::Loads& driving,
                                    const mechanics::GaussStages& stages) {
  AccountsOfStages accounts;
  accounts.viscosity = dissipation.viscosity;
  accounts.drag = dissipation.drag;
  accounts.driven = loads::depend_on_time(driving);
  if (!accounts.driven) return accounts;
  const auto take = [](const loads::Forcing& forcing, std::size_t stage, AccountsOfStages::Driving& at) {
    for (std::size_t k = 0; k < 9; ++k) {
      at.quadratic[k][stage] = forcing.quadratic.data()[k];
      at.nominal_traction[k][stage] = forcing.nominal_traction.data()[k];
    }
    at.pressure[stage] = forcing.pressure;
  };
  for (std::size_t i = 0; i < mechanics::gauss::n_stages; ++i) {
    const double t = stages.t + stages.tables->c[i];
    take(loads::driving(driving, t), i, accounts.driving);
    take(loads::driving_rate(driving, t), i, accounts.driving_rate);
  }
  return accounts;
}

}  // namespace pseudorigid::reduced
