#pragma once
/// The potential landscape (landscape.h) of a system in constrained form (constrained_system.h). The gradient ∇V is the
/// negative force at rest, and differences of the force give ∇²V. Differences of the force with respect to the velocity
/// give the damping C. All forces are evaluated at the time 0. The Hessian of V − λᵀg is ∇²V − Σ λ_k D²g_k. The product
/// of Σ λ_k D²g_k and a vector v is the rate of G(q)ᵀλ along v, which the system computes (add_reaction_rate).

#include <algorithm>

#include "mechanics/core/central_difference.h"
#include "mechanics/core/conservative_system.h"
#include "mechanics/core/second_order_field.h"
#include "mechanics/equilibria/landscape.h"

namespace pseudorigid::mechanics {

template <ConservativeSystem S>
class ConstrainedLandscape {
 public:
  using Vector = Eigen::VectorXd;
  using Matrix = Eigen::MatrixXd;

  /// The system must exist as long as its landscape.
  explicit ConstrainedLandscape(const S& system) : system_(system), workspace_(system.make_workspace()) {}

  int n_coordinates() const { return static_cast<int>(system_.make_vector().size()); }
  int n_constraints() const {
    auto multiplier = system_.make_multiplier();
    return static_cast<int>(local_values(multiplier).size());
  }
  Vector periods() const { return Vector::Zero(n_coordinates()); }

  double potential(const Vector& q) const { return system_.potential_energy(position(q)); }
  Status gradient(const Vector& q, Vector& dV) const {
    if (Status status = force(position(q), system_.make_vector(), dV); !status) return status;
    dV = -dV;
    return {};
  }
  Status constraint(const Vector& q, Vector& g) const {
    auto residual = system_.make_multiplier();
    if (Status status = system_.constraint(position(q), residual); !status) return status;
    g = flat(residual);
    return {};
  }
  void constraint_gradient(const Vector& q, Matrix& G) const {
    G.resize(n_constraints(), n_coordinates());
    for (int k = 0; k < G.rows(); ++k) {
      auto row = system_.make_vector();
      system_.add_reaction(position(q), multiplier(Vector::Unit(G.rows(), k)), row);
      G.row(k) = flat(row).transpose();
    }
  }
  Status hessian(const Vector& q, const Vector& lambda, Matrix& H) const {
    H.resize(q.size(), q.size());
    const double h = 0.01 * std::max(1.0, q.lpNorm<Eigen::Infinity>());
    for (Eigen::Index j = 0; j < q.size(); ++j) {
      const Vector e_j = Vector::Unit(q.size(), j);
      Vector column = Vector::Zero(q.size());
      const auto dV = [&](double s, Vector& value) { return gradient(q + s * e_j, value); };
      if (Status status = central_difference(dV, h, column); !status) return status;
      auto rate = system_.make_vector();
      system_.add_reaction_rate(position(q), position(e_j), multiplier(lambda), rate);
      H.col(j) = column - flat(rate);
    }
    H = (0.5 * (H + H.transpose())).eval();
    return {};
  }
  void mass(const Vector& q, Matrix& M) const {
    M.resize(q.size(), q.size());
    for (Eigen::Index j = 0; j < q.size(); ++j) {
      auto p = system_.make_vector();
      system_.apply_mass(position(Vector::Unit(q.size(), j)), p);
      M.col(j) = flat(p);
    }
  }
  Status damping(const Vector& q, Matrix& C) const {
    C.setZero(q.size(), q.size());
    if (!velocity_dependent(system_)) return {};
    constexpr double h = 0.01;
    for (Eigen::Index j = 0; j < q.size(); ++j) {
      Vector rate = Vector::Zero(q.size());
      const auto f = [&](double s, Vector& value) {
        return force(position(q), position(s * Vector::Unit(q.size(), j)), value);
      };
      if (Status status = central_difference(f, h, rate); !status) return status;
      C.col(j) = -rate;
    }
    return {};
  }

 private:
  /// Sets f to the force at (q, v) and at the time 0. Fails if the force fails or is not finite.
  Status force(const typename S::Vector& q, const typename S::Vector& v, Vector& f) const {
    auto value = system_.make_vector();
    auto workspace = workspace_;
    if (Status status = system_.force(0, q, v, workspace, value); !status) return status;
    f = flat(value);
    return f.allFinite() ? Status() : Status::failure("the force is not finite");
  }
  /// Conversions between a vector or multiplier x of the system and an Eigen vector of its entries. `flat` returns the
  /// entries of x, and `filled` returns x with the given entries.
  static Vector flat(auto& x) {
    const auto values = local_values(x);
    Vector entries(static_cast<Eigen::Index>(values.size()));
    std::copy(values.begin(), values.end(), entries.begin());
    return entries;
  }
  static auto filled(auto x, const Vector& entries) {
    std::copy(entries.begin(), entries.end(), local_values(x).begin());
    return x;
  }
  auto position(const Vector& q) const { return filled(system_.make_vector(), q); }
  auto multiplier(const Vector& lambda) const { return filled(system_.make_multiplier(), lambda); }

  const S& system_;
  typename S::Workspace workspace_;
};

}  // namespace pseudorigid::mechanics
