#pragma once
/// The common part of the compressible and the incompressible finite-element ball: space, kernels, forces, mass, and
/// moments of nodal fields.
///
///   M ẍ = −∫P:∇φ + loads   [+ Gᵀλ,   elastic_ball.h]                       (generalized Newton law, Oliva 5.3–5.4)
///
/// with the first Piola–Kirchhoff stress P and the basis functions φ of the displacements in (Q_k)³. P contains the
/// volumetric stabilisation (kernels/stored_energy.h) and the stresses of viscoelastic branches
/// (kernels/cell_branches.h). The mass M is lumped. If there is dissipation, if a load depends on time, or if a plane
/// moves, the ball has one or two additional nodes (BallSpace::account). Their first two coordinates s and s' obey
///
///   s̈ = dissipated power,   s̈' = power that loads give by their change in time, and planes by their motion.
///
/// Therefore ṡ is the dissipated energy, ṡ' is the given energy, and every method integrates these energies with its
/// own order. The powers do not contain the dissipation of branches; `relax` adds their dissipated energy to ṡ. The
/// energy that each branch has dissipated is the velocity of a further coordinate. Companions in orbit
/// (mechanics/core/orbit.h) are further nodes. Their tide has the potential ½(x − x_c)ᵀT(x − x_c) per mass, with the
/// centre of mass x_c. Node n with the mass m_n and the position x_n then has the force −m_n T (x_n − x_c). As an
/// option, the forces without expansion (companion_sums.h) replace this force. All quantities are in internal units. If
/// symmetry planes bound a sector, the equations are those of the sector. Functions state whether their results are for
/// the sector or for the whole ball.

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
#include "mechanics/core/orbit.h"

namespace pseudorigid::continuum {

/// Returns the least det F and its place as a text for messages, such as "det F = 0.61 at X/r = (0.000, 0.000, 0.930)".
std::string in_words(const LeastPlace& jacobian);

class BallBody {
 public:
  using Vector = continuum::Vector;

  /// The body of a sector of the unit ball. `degree` is k, from 1 to 8, or from 2 to 8 if the body is incompressible.
  /// An octant has 4 coarse cells. Each coarse cell is refined uniformly n_refinements times. The ranks of the
  /// communicator share the cells. Both constructors throw the exceptions of make_cell_kernels.
  BallBody(const Sector& sector, int degree, int n_refinements, const StoredEnergy& stored,
           const loads::Loads& loads = {}, MPI_Comm communicator = MPI_COMM_SELF);
  /// The body of a mesh. `n_gravity_points` and `n_contact_points` are the numbers of quadrature points in each
  /// direction of a face, for self-gravity and for contact. Without a number, the function n_gravity_points(space,
  /// is_fluid) or n_contact_points(space) chooses it.
  BallBody(BallMesh mesh, int degree, const StoredEnergy& stored, const loads::Loads& loads = {},
           std::optional<int> n_gravity_points = std::nullopt, std::optional<int> n_contact_points = std::nullopt);
  BallBody(const BallBody&) = delete;  // because some members refer to other members
  BallBody& operator=(const BallBody&) = delete;

  /// a = M⁻¹f, with 0 for components that a symmetry plane fixes and for unused coordinates of additional nodes. f and
  /// a may be the same vector.
  void apply_inverse_mass(const Vector& f, Vector& a) const;
  /// f = M v, with the mass 1 for the coordinates of the energies and of the companions. For components that are fixed
  /// or not used, f is 0. Their inverse mass is 0.
  void apply_mass(const Vector& v, Vector& f) const;
  /// f ← f − C u for viscosity, drag, and the damping and friction of contacts. C is the linearisation `kind` of the
  /// damping force at `state` (mechanics/core/damping.h). Collective.
  void add_damping(const mechanics::VectorState<Vector>& state, const Vector& u, mechanics::Linearization kind,
                   Vector& f) const {
    loads_.add_dissipation(state.q, u, f);
    if (contact_) contact_->add_damping(state.t, state.q, state.v, u, kind, f);
  }
  /// True if the matrix C of add_damping does not depend on the velocity. This is the case without friction.
  bool damping_is_linear() const { return !loads_.rough(); }
  /// Number of entries of a position vector on all ranks, or 0 without viscosity. The preconditioner of viscous damping
  /// needs this number (mechanics/core/damping_preconditioner.h).
  int n_damped_entries() const { return loads_.viscous() ? static_cast<int>(space_.reference_positions().size()) : 0; }
  /// True if there are viscoelastic branches.
  bool relaxes() const { return !branches_.empty(); }
  const materials::MaxwellBranches& branches() const { return branches_.list; }
  /// Replaces the internal metrics of the branches in x (kernels/branch_kernels.h) by their values after the time h.
  /// During this time the strain is constant: it is materials::mean_strain of the positions `before` and x. Adds the
  /// energy that the branches dissipate to the dissipated energies in v, in total and for each branch. Collective.
  void relax(double h, const Vector& before, Vector& x, Vector& v) const;
  /// Sets the internal metrics of x. If `relaxed` is true, they become Ĉ = J^{−2/3} FᵀF at x and the branches have no
  /// stress. Otherwise they become the identity, which has no stress in the undeformed body. Collective.
  void start_branches(bool relaxed, Vector& x) const { kernels_->start_branches(branches_.list.size(), relaxed, x); }
  /// The energy that the viscoelastic branches store in the whole ball, at the position x with its internal metrics. It
  /// is 0 without branches. Collective.
  double energy_of_branches(const Vector& x) const;
  bool time_dependent() const { return loads_.time_dependent(); }
  /// `time_dependent`: true if a load depends on time or a plane moves. `velocity_dependent`: true if a force depends
  /// on the velocity. `dissipative`: true if a force or a branch dissipates energy.
  bool velocity_dependent() const { return loads_.damped(); }
  bool dissipative() const { return loads_.dissipative(); }
  /// The kinetic energy ½vᵀMv, and the potential energy at the time 0, of the computed sector and without companions.
  /// The potential energy is infinite if the law does not admit F at a quadrature point. Collective.
  double kinetic_energy(const Vector& v) const;
  double potential_energy(const Vector& x) const;
  /// Number of rotations and translations of space that are symmetries (loads::free_motions). It is 0 if a load depends
  /// on time.
  int n_symmetries() const { return static_cast<int>(free_.turns.size() + free_.translations.size()); }
  /// Sets dx and dv at the nodes for symmetry i with the unit vector ê of its axis. For a rotation, dx = ê×(x − x_c)
  /// and dv = ê×(v − v_c) with the means x_c and v_c. For a translation, dx = ê and dv = 0. Rotations come first. About
  /// the centre, a rotation does not change v_c, so a method that uses these fields keeps the centre in uniform motion.
  void symmetry(int i, const Vector& x, const Vector& v, Vector& dx, Vector& dv) const;
  bool has_contact() const { return contact_.has_value(); }

  Vector make_vector() const { return space_.make_vector(); }

  /// The nodal field A X + c, and 0 at the additional nodes. It is a position if A = Q₀ and c is a position, and a
  /// velocity if A = Q̇₀ and c is a velocity.
  Vector affine_field(const Eigen::Matrix3d& A, const Eigen::Vector3d& c = Eigen::Vector3d::Zero()) const;
  /// Replaces each vector x_n of a nodal field by D x_n. The additional nodes do not change.
  void transform(const Eigen::Matrix3d& D, Vector& x) const;
  /// The mass moment Q_M = (Σ m_n x_n X_nᵀ) E₀⁻¹ of a nodal field x over the whole ball, with E₀ = Σ m_n X_n X_nᵀ. If x
  /// is a velocity, the result is the time derivative of Q_M. Collective.
  Eigen::Matrix3d mass_moment(const Vector& x) const;
  /// Mass-weighted mean Σ m_n x_n / Σ m_n of a nodal field over the whole ball. Components normal to a symmetry plane
  /// are 0. Collective.
  Eigen::Vector3d mean(const Vector& x) const;
  /// `add_taken` adds to the dissipated energy in v, and `add_given` to the given energy in v. The argument is the sum
  /// over the sector on all ranks. The functions multiply it by the number of images of the sector. If v is a force,
  /// `energy` is a power. On ranks without the coordinates of BallSpace::account, v does not change.
  void add_taken(double energy, Vector& v) const { add_to_account(energy, 0, v); }
  void add_given(double energy, Vector& v) const { add_to_account(energy, 1, v); }
  /// The dissipated energy, and the energy given by loads and by moving planes, for the whole ball. Both energies are
  /// entries of the velocity v. They are 0 if no rank has the coordinates of BallSpace::account. Collective.
  double dissipated(const Vector& v) const;
  double given(const Vector& v) const;
  /// The energy that each branch has dissipated in the whole ball, from the velocity v. It is 0 for branches that do
  /// not exist. Collective.
  materials::BranchEnergies dissipated_by_branches(const Vector& v) const;

  const mechanics::Orbit& orbit() const { return orbit_; }
  /// `companions` returns the coordinates s_k of the companions (mechanics/core/orbit.h) in a vector, one column for
  /// each companion. It is collective. `set_companions` writes these coordinates into a vector on the rank that owns
  /// them.
  mechanics::Orbit::Columns companions(const Vector& x) const;
  void set_companions(const mechanics::Orbit::Columns& s, Vector& x) const;
  /// The second moment Σ m_n (x_n − x_c)(x_n − x_c)ᵀ over the nodes of the whole ball, with the mean x_c. Collective.
  Eigen::Matrix3d second_moment(const Vector& x) const;

  /// The contact of the whole ball with rigid planes at the time t and the position x. Without planes, the force is 0
  /// and the height is infinite. Collective.
  loads::Contact contact(double t, const Vector& x) const {
    return contact_ ? contact_->contact(t, x) : loads::Contact{};
  }

  /// Inertia E₀ = Σ m_n X_n X_nᵀ, reference volume, and mass of the whole discretised ball. Node n has the mass m_n and
  /// the reference position X_n. The call of `mass` is collective.
  const Eigen::Matrix3d& E0() const { return E0_; }
  double volume() const { return volume_; }
  double mass() const;
  const BallSpace& space() const { return space_; }
  const materials::AnyLaw& law() const { return law_; }
  const CellKernels& kernels() const { return *kernels_; }
  /// The modulus λ of the projected bulk term (kernels/stored_energy.h), and the energy of this term in the whole ball.
  /// Both are 0 if there is none. The energy is NaN if det F is not positive. The second function is collective.
  double projected_bulk() const { return projected_bulk_; }
  double bulk_energy(const Vector& x) const;
  const LoadForces& loads() const { return loads_; }
  /// The self-gravity, or null if there is none.
  const SurfaceGravityForces* gravity() const { return gravity_ ? &*gravity_ : nullptr; }

  /// Returns the integral of a tensor over the whole ball from the integral over the sector. For i ≠ j, the entry (i,
  /// j) changes its sign under the reflections of x_i and of x_j. It is 0 if the sector has one of these reflections.
  /// The other entries are multiplied by the number of images.
  Eigen::Matrix3d whole_ball(const Eigen::Matrix3d& sector_integral) const;
  /// Least det F over the quadrature points of all ranks, with its reference position. Collective.
  LeastPlace least_jacobian(const Vector& x) const;
  /// Least value of a function of F over the quadrature points of all ranks, with its reference position. Collective.
  LeastPlace least(const Vector& x, const std::function<double(const Eigen::Matrix3d& F)>& value) const;
  /// Least reserve of the law over the quadrature points of all ranks, with its reference position. The reserve is
  /// positive if the law admits F, and infinite for a law without limits (materials/law_limits.h). Collective.
  LeastPlace least_reserve(const Vector& x) const;
  /// The integrals and extreme values of CellIntegrals over the sector on all ranks, at the position x and the velocity
  /// v. Collective.
  CellIntegrals integrals(const Vector& x, const Vector& v) const;
  /// Fails if the minimum of `least` over the ranks is not a positive finite number. `least` is the least value of det
  /// F and of the reserve of the law at the quadrature points of this rank. For a law with limits and det F > 0
  /// everywhere, the message names the limit and the place of the least reserve. Otherwise it names the place of the
  /// least det F. Collective.
  mechanics::Status judge(double least, const Vector& x) const;
  /// Fills x with fixed irregular numbers in [−1, 1], the start of the search for the largest frequency
  /// (mechanics/steps/largest_frequency.h). With another number of ranks, the numbers differ by about 1e-12, because
  /// the round-off of the reference positions differs.
  void fill_irregular(Vector& x) const;
  /// Σ_n m_n a_n b_nᵀ over the nodes n of the whole ball, with the nodal masses m_n. Collective.
  Eigen::Matrix3d nodal_moment(const Vector& a, const Vector& b) const;

 protected:
  /// Sets f to all forces without the reactions. Sets the first two coordinates of BallSpace::account in f to the
  /// powers of the opening comment. If `held_at` is not null and there are planes, springs on the whole surface replace
  /// the contact, with its damping and friction. The springs pull each point of the surface towards the place that it
  /// has for the nodal positions `*held_at`, with the stiffness Planes::stiffness_of_all. The total stiffness is then
  /// an upper bound for the stiffness with contact, which the search for a stable step needs. Fails if `judge` fails.
  /// Collective.
  mechanics::Status applied_force(double t, const Vector& x, const Vector& v, const Vector* held_at, Vector& f) const;
  /// Adds the forces of loads, branches, gravity, companions and contact to f, and sets the powers as applied_force
  /// does. On entry, f contains the elastic force, and the reactions if the body is incompressible and the caller has
  /// added them. `least` is the least value of det F and of the reserve of the law on this rank, which the kernel
  /// returned for this force. `held_at` has the meaning of applied_force. Fails if `judge` fails for `least`.
  /// Collective.
  mechanics::Status complete_force(double t, const Vector& x, const Vector& v, double least, const Vector* held_at,
                                   Vector& f) const;

 private:
  /// Index of the first branch among the coordinates from BallSpace::account on. Index 0 is the dissipated energy, and
  /// index 1 is the given energy.
  static constexpr unsigned int first_branch_account = 2;
  double account_entry(const Vector& v, unsigned int component) const;
  void add_companions(const Vector& x, Vector& f) const;
  void add_to_account(double energy, unsigned int component, Vector& v) const;
  LeastPlace of_all_ranks(LeastPlace of_this_one) const;

  BallSpace space_;
  materials::AnyLaw law_;
  std::string_view limit_;  ///< reason why the law does not admit some F (law_limits.h); empty if it has no limit
  bool is_fluid_;
  double projected_bulk_;
  std::unique_ptr<CellKernels> kernels_;
  LoadForces loads_;
  loads::Branches branches_;
  std::optional<SurfaceGravityForces> gravity_;
  std::optional<ContactForces> contact_;  ///< empty if there are no planes
  mechanics::Orbit orbit_;
  loads::FreeMotions free_;  ///< rotations and translations of space that are symmetries
  Eigen::Matrix3d E0_;
  double volume_;
};

}  // namespace pseudorigid::continuum
