#pragma once
/// A heavy particle on a sphere, in both forms of the generalized Newton law.

#include <Eigen/Dense>

#include "mechanics/core/conservative_system.h"
#include "systems/surfaces.h"

namespace pseudorigid::testing {

/// m q̈ = −m g e₃ + λ q/R²,  ½(|q|²/R² − 1) = 0,  with the linear drag −C q̇.
class SphereParticle {
 public:
  using Vector = Eigen::Vector3d;
  using Multiplier = double;
  struct Workspace {};
  static constexpr int n_constraints = 1;

  double m = 1.5, R = 2, gravity = 0.7;
  Eigen::Matrix3d C = Eigen::Matrix3d::Zero();

  mechanics::Status force(double, const Vector&, const Vector& v, Workspace&, Vector& f) const {
    f = Eigen::Vector3d(0, 0, -m * gravity) - C * v;
    return {};
  }
  void apply_inverse_mass(const Vector& f, Vector& a) const { a = f / m; }
  void apply_mass(const Vector& v, Vector& p) const { p = m * v; }
  mechanics::Status constraint(const Vector& q, Multiplier& g) const {
    g = 0.5 * (q.squaredNorm() / (R * R) - 1);
    return {};
  }
  void constraint_rate(const Vector& q, const Vector& v, Multiplier& r) const { r = q.dot(v) / (R * R); }
  void constraint_curvature(const Vector&, const Vector& v, Multiplier& r) const { r = v.squaredNorm() / (R * R); }
  void add_reaction(const Vector& q, const Multiplier& lambda, Vector& f) const { f += lambda / (R * R) * q; }
  void add_reaction_rate(const Vector&, const Vector& v, const Multiplier& lambda, Vector& f) const {
    f += lambda / (R * R) * v;
  }
  mechanics::SolveReport solve_gram(const Vector& q1, const Vector& q0, const Multiplier& r, Workspace&,
                                    Multiplier& lambda) const {
    lambda = r * m * R * R * R * R / q1.dot(q0);
    return {};
  }
  double constraint_tolerance() const { return 4e-16; }
  Vector make_vector() const { return Vector::Zero(); }
  Multiplier make_multiplier() const { return 0; }
  Workspace make_workspace() const { return {}; }

  bool velocity_dependent() const { return !C.isZero(0); }
  bool dissipative() const { return velocity_dependent(); }
  double kinetic_energy(const Vector& v) const { return 0.5 * m * v.squaredNorm(); }
  double potential_energy(const Vector& q) const { return m * gravity * q.z(); }
  int n_symmetries() const { return 1; }
  void symmetry(int, const Vector& q, const Vector& v, Vector& dq, Vector& dv) const {
    dq = Eigen::Vector3d::UnitZ().cross(q);
    dv = Eigen::Vector3d::UnitZ().cross(v);
  }
};

/// The same particle in spherical coordinates (θ, φ).
struct SphereParticleChart : systems::Sphere {
  double m = 1.5, gravity = 0.7;

  explicit SphereParticleChart(const SphereParticle& p) : systems::Sphere{p.R}, m(p.m), gravity(p.gravity) {}

  template <class T>
  systems::SurfaceMetric<T> metric(const systems::SurfacePoint<T>& q) const {
    systems::SurfaceMetric<T> g = systems::Sphere::metric(q);
    for (int i = 0; i < 2; ++i) g(i, i) *= m;
    return g;
  }
  template <class T>
  T potential(const systems::SurfacePoint<T>& q) const {
    return m * gravity * embedding(q)[2];
  }
};

}  // namespace pseudorigid::testing
