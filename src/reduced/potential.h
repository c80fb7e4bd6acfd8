#pragma once
/// The potential energy of the pseudo-rigid body (Oliva 5.7.8–5.7.9), a sum of the following terms:
///
///   V(Q) = Vol·W(Q) − k R_F(a₁², a₂², a₃²) + V_e(Q)
///          stored      self-gravity          of the loads, external_potential.h
///
/// with the stored energy W per reference volume Vol, Carlson's integral R_F, and k = (3/5) G M² for the gravitational
/// constant G and the mass M. The reference body is the image of the unit ball under the linear map S
/// (reference_body.h). The deformed body is then an ellipsoid, and its semi-axes a_i are the singular values of F = QS.
/// Self-gravity and loads that are 0 are not computed.
///
/// The functions `energy` and `stress` of a Tensor return V and ∂V/∂Q per reference volume, like a material law. With
/// the stress P = ∂W/∂Q of the law, and with the self-gravity V_g as a function of F, the derivative is
///
///   (1/Vol) ∂V/∂Q = P(Q) + (1/Vol) [(∂V_g/∂F) Sᵀ + ∂V_e/∂Q],   ∂V_g/∂F at F = QS

#include <Eigen/Dense>
#include <optional>
#include <string_view>
#include <variant>

#include "gravity/ellipsoid_gravity.h"
#include "loads/forcing.h"
#include "materials/eigen_tensor.h"
#include "materials/law_table.h"
#include "reduced/external_potential.h"
#include "reduced/reference_body.h"

namespace pseudorigid::reduced {

/// The terms of V(Q): stored energy, self-gravity, and energy of the loads.
struct PotentialEnergies {
  double elastic = 0, gravitational = 0, external = 0;
  double total() const { return elastic + gravitational + external; }
};

class Potential {
  using Tensor = materials::Tensor<double>;

 public:
  /// `forcing` may contain loads without a potential in Q. These loads are not used.
  Potential(const materials::AnyLaw& law, const ReferenceBody& body, const loads::Forcing& forcing = {})
      : law_(law),
        limited_(!materials::limit_of(law).empty()),
        body_(body),
        forcing_(forcing),
        external_(forcing),
        loaded_(forcing.gravity_constant != 0 || external_.present()),
        spherical_(body.shape.isIdentity(0)) {
    const double G = forcing.gravity_constant;
    if (G != 0) gravity_ = gravity::EllipsoidGravity{0.6 * G * body.mass * body.mass};
  }

  /// `admits` returns true if Q is within the limit of the material law. `limit` names this limit for messages, and is
  /// empty for a law without a limit (materials/law_limits.h).
  bool admits(const Tensor& Q) const { return !limited_ || materials::admits(law_, Q); }
  std::string_view limit() const { return materials::limit_of(law_); }

  /// The potential energy V and its derivative ∂V/∂Q, both per reference volume.
  double energy(const Tensor& Q) const { return energies(materials::to_matrix(Q)).total() / body_.volume; }
  Tensor stress(const Tensor& Q) const {
    Tensor P = std::visit([&](const auto& law) { return law.stress(Q); }, law_);
    if (loaded_)
      P = materials::entrywise([](double a, double b) { return a + b; }, P,
                               materials::to_tensor(loads(materials::to_matrix(Q)) / body_.volume));
    return P;
  }

  PotentialEnergies energies(const Eigen::Matrix3d& Q) const {
    const Tensor q = materials::to_tensor(Q);
    PotentialEnergies V{.elastic = body_.volume * std::visit([&](const auto& law) { return law.energy(q); }, law_)};
    if (gravity_) V.gravitational = gravity_->energy(Q * body_.shape);
    V.external = external_.energy(body_, Q);
    return V;
  }

  /// The potential energy V, its derivative ∂V/∂Q, and the derivative of ∂V/∂Q in the direction H, not divided by the
  /// volume.
  double energy(const Eigen::Matrix3d& Q) const { return energies(Q).total(); }
  Eigen::Matrix3d gradient(const Eigen::Matrix3d& Q) const {
    return body_.volume * materials::to_matrix(stress(materials::to_tensor(Q)));
  }
  Eigen::Matrix3d second_derivative(const Eigen::Matrix3d& Q, const Eigen::Matrix3d& H) const {
    const Tensor q = materials::to_tensor(Q), h = materials::to_tensor(H);
    Eigen::Matrix3d D =
        body_.volume * materials::to_matrix(std::visit([&](const auto& law) { return law.tangent(q, h); }, law_));
    if (gravity_) D += gravity_->second_derivative(Q * body_.shape, H * body_.shape) * body_.shape.transpose();
    external_.add_second_derivative(body_, Q, H, D);
    return D;
  }

  /// True if V can change under rotations of space because of a load (external_potential.h).
  bool depends_on_direction() const { return external_.depends_on_direction(); }

  const materials::AnyLaw& law() const { return law_; }
  const loads::Forcing& forcing() const { return forcing_; }

  /// First Piola–Kirchhoff stress of the material without loads.
  Eigen::Matrix3d material_stress(const Eigen::Matrix3d& Q) const {
    return materials::to_matrix(std::visit([&](const auto& law) { return law.stress(materials::to_tensor(Q)); }, law_));
  }

 private:
  /// Derivative of V − Vol·W with respect to Q, which is the force of the loads and of self-gravity with the opposite
  /// sign.
  Eigen::Matrix3d loads(const Eigen::Matrix3d& Q) const {
    Eigen::Matrix3d f = Eigen::Matrix3d::Zero();
    if (gravity_ && spherical_) f = gravity_->gradient(Q);
    if (gravity_ && !spherical_) f = gravity_->gradient(Q * body_.shape) * body_.shape.transpose();
    external_.add_gradient(body_, Q, f);
    return f;
  }

  materials::AnyLaw law_;
  bool limited_;
  ReferenceBody body_;
  loads::Forcing forcing_;
  std::optional<gravity::EllipsoidGravity> gravity_;
  ExternalPotential external_;
  bool loaded_;     // true if V has terms other than the stored energy
  bool spherical_;  // true if the body is the unit ball, S = Id
};

}  // namespace pseudorigid::reduced
