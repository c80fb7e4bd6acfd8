#pragma once
/// The energy of loads on the motions x = QX, without self-gravity. The loads have the quadratic potential T per mass,
/// the nominal traction P̄ and the pressure p (loads/forcing.h). With the inertia E₀ and the volume Vol of the
/// reference body, the energy and its derivative are
///
///   V(Q) = ½ tr(T Q E₀ Qᵀ) − Vol P̄:Q + p Vol det Q
///
///   ∂V/∂Q = T Q E₀ − Vol P̄ + p Vol cof Q      (∮P̄N·QX dA = Vol P̄:Q by the divergence theorem, with the normal N)
///
/// Loads that are 0 are not computed.

#include <Eigen/Dense>
#include <optional>

#include "loads/forcing.h"
#include "materials/eigen_tensor.h"
#include "reduced/reference_body.h"

namespace pseudorigid::reduced {

class ExternalPotential {
 public:
  explicit ExternalPotential(const loads::Forcing& forcing) : pressure_(forcing.pressure) {
    if (!forcing.quadratic.isZero(0)) quadratic_ = forcing.quadratic;
    if (!forcing.nominal_traction.isZero(0)) nominal_traction_ = forcing.nominal_traction;
  }

  bool present() const { return depends_on_direction() || pressure_ != 0; }
  /// True if V can change under rotations of the body: T or P̄ is not 0.
  bool depends_on_direction() const { return quadratic_ || nominal_traction_; }

  double energy(const ReferenceBody& body, const Eigen::Matrix3d& Q) const {
    double V = 0;
    if (quadratic_) V = 0.5 * quadratic_->cwiseProduct(Q * body.E0 * Q.transpose()).sum();
    if (nominal_traction_) V -= body.volume * nominal_traction_->cwiseProduct(Q).sum();
    if (pressure_ != 0) V += pressure_ * body.volume * Q.determinant();
    return V;
  }

  /// Adds the derivative ∂V/∂Q at Q to f.
  void add_gradient(const ReferenceBody& body, const Eigen::Matrix3d& Q, Eigen::Matrix3d& f) const {
    if (quadratic_) f += *quadratic_ * Q * body.E0;
    if (nominal_traction_) f -= body.volume * *nominal_traction_;
    if (pressure_ != 0)
      f += pressure_ * body.volume * materials::to_matrix(materials::cofactor(materials::to_tensor(Q)));
  }

  /// Adds the derivative of ∂V/∂Q at Q in the direction H to D.
  void add_second_derivative(const ReferenceBody& body, const Eigen::Matrix3d& Q, const Eigen::Matrix3d& H,
                             Eigen::Matrix3d& D) const {
    if (quadratic_) D += *quadratic_ * H * body.E0;
    if (pressure_ == 0) return;
    // cof is quadratic. Its derivative is therefore D cof(Q)[H] = cof(Q + H) − cof Q − cof H. The code computes only
    // the products that do not cancel in this difference.
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
        D(i, j) += pressure_ * body.volume *
                   (H(i1, j1) * Q(i2, j2) + Q(i1, j1) * H(i2, j2) - H(i1, j2) * Q(i2, j1) - Q(i1, j2) * H(i2, j1));
      }
  }

 private:
  std::optional<Eigen::Matrix3d> quadratic_, nominal_traction_;
  double pressure_;
};

}  // namespace pseudorigid::reduced
