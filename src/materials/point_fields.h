#pragma once
/// Fields of a body that depend on the material: the Cauchy stress σ = (P Fᵀ − p Id)/det F and the energy density W.
/// The first Piola–Kirchhoff stress P and W are the sums of the contributions of the law and of the viscoelastic
/// branches. The number p is the Kirchhoff pressure of an incompressible body, which is the reaction of the constraint
/// det F = 1.

#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <variant>

#include "materials/eigen_tensor.h"
#include "materials/law_table.h"
#include "materials/maxwell_branch.h"
#include "mechanics/core/body_fields.h"
#include "mechanics/core/status.h"

namespace pseudorigid::materials {

/// Sets `stress` to σ without the pressure, P Fᵀ/det F, at a point with the reference position X. Fails if det F is not
/// positive and finite.
inline mechanics::Status cauchy_stress(const AnyLaw& law, const Eigen::Vector3d& X, const Eigen::Matrix3d& F,
                                       const BranchesAtPoint& branches, Eigen::Matrix3d& stress) {
  const double J = F.determinant();
  if (!(J > 0 && std::isfinite(J))) {
    char text[160];
    std::snprintf(text, sizeof text, "no stress: det F = %.3g at X/r = (%.3f, %.3f, %.3f)", J, X[0], X[1], X[2]);
    return mechanics::Status::failure(text);
  }
  const Tensor<double> f = to_tensor(F);
  const Eigen::Matrix3d P = to_matrix(std::visit([&](const auto& l) { return l.stress(f); }, law)) +
                            to_matrix(stress_of_branches(f, branches.inverse_sum));
  stress = P * F.transpose() / J;
  return {};
}

/// Appends X, x, v, F, σ and W of a material point to the fields. The point has the reference position X, the position
/// x, the velocity v and the deformation gradient F. `pressure` is p, or 0 for a compressible body. Fails as
/// cauchy_stress does, and then appends nothing.
inline mechanics::Status add_point(const AnyLaw& law, const Eigen::Vector3d& X, const Eigen::Vector3d& x,
                                   const Eigen::Vector3d& v, const Eigen::Matrix3d& F, double pressure,
                                   const BranchesAtPoint& branches, mechanics::BodyFields& fields) {
  Eigen::Matrix3d stress;
  if (auto status = cauchy_stress(law, X, F, branches, stress); !status) return status;
  const Tensor<double> f = to_tensor(F);
  const double energy = std::visit([&](const auto& l) { return l.energy(f); }, law) +
                        energy_of_branches(f, branches.inverse_sum, branches.sum_of_moduli);
  fields.add(X, x, v, F, stress - pressure / F.determinant() * Eigen::Matrix3d::Identity(), energy);
  return {};
}

}  // namespace pseudorigid::materials
