#pragma once
/// Common parts of the compressible and the incompressible finite-element ball: space, kernels, forces, mass and
/// the moments of nodal fields.
///
///   M ẍ = −∫P:∇φ + loads   [+ Gᵀλ,   elastic_ball.h]                       (generalized Newton law, Oliva 5.3–5.4)
///
/// x_h ∈ (Q_k)³ with a lumped mass. With dissipation, or with loads that depend on time, there is one node more
/// (BallSpace::account), whose coordinates s and s' obey
///
///   s̈ = power that dissipation takes,   s̈' = power that a change of the loads gives:
///
/// their velocities are the energies taken and given, and every method integrates them with its own order. All in
/// internal units; the system is the computed sector, observables are of the whole ball.

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "continuum/body/ball_loads.h"
#include "continuum/body/contact_forces.h"
#include "continuum/body/surface_gravity_forces.h"
#include "continuum/kernels/cell_kernels.h"
#include "continuum/mesh/ball_space.h"
#include "mechanics/core/axial_vectors.h"
#include "mechanics/core/constrained_system.h"

namespace pseudorigid::continuum {

/// "det F = 0.61 at X/r = (0.000, 0.000, 0.930)", for messages.
std::string in_words(const LeastPlace& jacobian);

class BallBody {
 public:
  using Vector = continuum::Vector;

  /// The sector of the unit ball with degree k = 1 … 8 (with the constraint from 2 on) after n_refinements uniform
  /// refinements of the octant's 4 cells, over the ranks of a communicator.
  BallBody(const Sector& sector, int degree, int n_refinements, const StoredEnergy& stored,
           const loads::Loads& loads = {}, MPI_Comm communicator = MPI_COMM_SELF);
  /// The same for the body of a mesh file. `n_gravity_points`: see body/surface_gravity_forces.h; `n_contact_points`:
  /// see body/contact_forces.h.
  BallBody(BallMesh mesh, int degree, const StoredEnergy& stored, const loads::Loads& loads = {},
           std::optional<int> n_gravity_points = std::nullopt, std::optional<int> n_contact_points = std::nullopt);
  BallBody(const BallBody&) = delete;  // its parts refer to one another
  BallBody& operator=(const BallBody&) = delete;

  void apply_inverse_mass(const Vector& f, Vector& a) const;
  void apply_mass(const Vector& v, Vector& f) const;
  /// f ← f + the viscous force and the drag, linear in v (mechanics/core/linear_damping.h).
  void add_damping(const Vector& x, const Vector& v, Vector& f) const {
    loads_.add_dissipation(x, v, f);
    if (contact_) contact_->add_damping(x, v, f);
  }
  bool time_dependent() const { return loads_.time_dependent(); }
  bool velocity_dependent() const { return loads_.dissipative(); }
  bool dissipative() const { return loads_.dissipative(); }

  Vector make_vector() const { return space_.make_vector(); }

  /// x = A X at every node: positions for A = Q₀, velocities for A = Q̇₀. With c: x = c + A X.
  Vector affine_field(const Eigen::Matrix3d& A, const Eigen::Vector3d& c = Eigen::Vector3d::Zero()) const;
  /// Q_M = (∫ρ x Xᵀ dV) E₀⁻¹ of a field x (its rate from a velocity).
  Eigen::Matrix3d mass_moment(const Vector& x) const;
  /// Mass-weighted mean of a field; components across a symmetry plane cancel.
  Eigen::Vector3d mean(const Vector& x) const;
  /// `energy` over the sector.
  void add_taken(double energy, Vector& v) const;
  /// The energy that dissipation has taken, and that loads which depend on time have given, from the velocity.
  double dissipated(const Vector& v) const;
  double given(const Vector& v) const;

  /// Contact with rigid planes at x; none without planes. Collective.
  loads::Contact contact(const Vector& x) const { return contact_ ? contact_->contact(x) : loads::Contact{}; }

  /// Inertia, volume and mass of the mesh, whole ball: E₀,h = Σ m_n X_n X_nᵀ.
  const Eigen::Matrix3d& E0() const { return E0_; }
  double volume() const { return volume_; }
  double mass() const;
  const BallSpace& space() const { return space_; }
  const CellKernels& kernels() const { return *kernels_; }
  const LoadForces& loads() const { return loads_; }
  /// Null without self-gravity.
  const SurfaceGravityForces* gravity() const { return gravity_ ? &*gravity_ : nullptr; }

  /// A 3×3 integral over the whole ball from that over the sector: its (i, j) entry is odd under a reflection of
  /// exactly one of x_i and x_j, and then cancels.
  Eigen::Matrix3d whole_ball(const Eigen::Matrix3d& sector_integral) const;
  /// Least det F over the quadrature points of all ranks, with its place.
  LeastPlace least_jacobian(const Vector& x) const;
  /// The least value of a function of F, with its place.
  LeastPlace least(const Vector& x, const std::function<double(const Eigen::Matrix3d& F)>& value) const;
  /// The least reserve of the law, with its place (materials/law_limits.h).
  LeastPlace least_reserve(const Vector& x) const;
  /// Integrals over the sector, of all ranks.
  CellIntegrals integrals(const Vector& x, const Vector& v) const;
  /// Fails if `least`, of J and the reserve of the law over the points of this rank, is not positive. Collective.
  mechanics::Status judge(double least, const Vector& x) const;
  /// Fixed numbers in (−1, 1) without pattern, the same on any number of ranks.
  void fill_irregular(Vector& x) const;
  /// Σ_n m_n a_n b_nᵀ over the whole ball.
  Eigen::Matrix3d nodal_moment(const Vector& a, const Vector& b) const;

 protected:
  /// f of all but reactions. `held_at`: in place of contact, every point of the surface is held at this position by the
  /// stiffness of the planes, as a bound for the stiffness; or null.
  mechanics::Status applied_force(double t, const Vector& x, const Vector& v, const Vector* held_at, Vector& f) const;
  /// Adds loads, gravity and contact to the force of the stress; fails if `least`, which its kernel returned, is not
  /// positive.
  mechanics::Status complete_force(double t, const Vector& x, const Vector& v, double least, const Vector* held_at,
                                   Vector& f) const;

 private:
  double account_entry(const Vector& v, unsigned int component) const;
  LeastPlace of_all_ranks(LeastPlace of_this_one) const;

  BallSpace space_;
  std::string_view limit_;  ///< the limit of the law, as materials::limit_of defines it
  bool is_fluid_;
  std::unique_ptr<CellKernels> kernels_;
  LoadForces loads_;
  std::optional<SurfaceGravityForces> gravity_;
  std::optional<ContactForces> contact_;  ///< empty without planes
  Eigen::Matrix3d E0_;
  double volume_;
};

}  // namespace pseudorigid::continuum
