#pragma once
/// Polynomial bodies: higher-order pseudo-rigid bodies (Cohen and Muncaster 1988; Papadopoulos 2001) of degree N,
///
///   x = Σ q_ia φ_a(X) e_i,   q̈ = −∂V/∂q + loads   [+ Gᵀλ,   g_b = ∫ψ_b ln J dX = 0,   incompressible_body.h]
///   V(q) = ∫W(F) + U(J) dX + Ê + V_e,   F = ∂x/∂X
///
/// This is the generalized Newton law (Oliva 5.3–5.4) for the coefficients q_ia of an orthonormal basis φ_a, with the
/// unit vectors e_i. The mass is therefore the identity (polynomial_space.h). The terms in brackets are those of an
/// incompressible body: the reaction with the multipliers λ and G = Dg, and the constraints g_b with a basis ψ_b of the
/// pressures. The body of degree N = 1 is the pseudo-rigid body, and the limit N → ∞ is the continuum. W is the stored
/// energy, J = det F, and Ê is the energy of self-gravity (body_gravity.h). U is the volumetric stabilisation (κ/8)(J −
/// 1/J)² with the stiffness κ, by default 0. The loads (loads/forcing.h) have the following energies V_e or forces. d
/// is the rate of deformation, and P_b is the stress of branch b:
///
///   quadratic potential T    V = ½ T:∫ρ x xᵀ            uniform acceleration b   V = −b·∫ρ x
///   nominal traction P̄       V = −P̄:∫F                  pressure p               V = p ∫J
///   viscosity η              −∫2ηJ d F⁻ᵀ:∇φ             drag coefficient c       −c q̇
///   viscoelastic branches    −∫ΣP_b:∇φ, with an internal metric C_b at each point (materials/maxwell_branch.h)
///   rigid planes             body_contact.h
///   companions               the quadratic potential T about the centre of mass (mechanics/core/orbit.h)
///
/// If there is dissipation or a load depends on time, the body has two further coordinates s and s'. Their
/// accelerations s̈ and s̈' are the dissipated power and the power that loads give by their change in time. A plane
/// that moves is such a load. Therefore the velocities ṡ and ṡ' are the dissipated and the given energy. Each
/// viscoelastic branch has a further coordinate. Its velocity is the energy that the branch has dissipated. The
/// coordinates of companions follow. The last entries are the internal metrics, which do not have a velocity
/// (mechanics/core/relaxation.h).
///
/// A nearly incompressible body can have the bulk term B of its law (materials/bulk_energy.h) at the projection θ = Σ
/// g_b ψ_b of ln J. V then contains ∫B(θ) dX, and W is the law without its bulk term.
///
/// All integrals are over the whole body, in internal units.

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "loads/list.h"
#include "materials/law_table.h"
#include "mechanics/core/constrained_system.h"
#include "mechanics/core/orbit.h"
#include "polynomial/body_contact.h"
#include "polynomial/body_gravity.h"
#include "polynomial/polynomial_space.h"

namespace pseudorigid::polynomial {

/// Degree, sector, reference shape, material and loads of a body, and numbers of quadrature points.
struct BodySetup {
  int degree = 3;
  std::array<bool, 3> reflect{};  ///< true for each axis whose coordinate plane is a symmetry plane of the motion
  Eigen::Vector3d semi_axes = Eigen::Vector3d::Ones();
  materials::AnyLaw law = materials::CiarletGeymonat{1, 0};
  double volumetric_stiffness = 0;  ///< stiffness κ of the volumetric stabilisation
  double projected_bulk = 0;  ///< modulus λ of the projected bulk term (materials/bulk_energy.h); 0 if there is none
  loads::Loads loads{};
  /// Numbers of quadrature points in each direction of an octant: on the surface for gravity, in the volume, and on the
  /// surface for contact. If a number is empty, the body uses BodyGravity::usual_points, PolynomialSpace::least_points
  /// or BodyContact::usual_points.
  std::optional<int> n_gravity_points{};
  std::optional<int> n_points{};
  std::optional<int> n_contact_points{};
};

/// Parts of the potential energy of the whole body. `external` is the energy of the quadratic potential, the
/// acceleration, the nominal traction and the pressure, including loads that depend on time. `interaction` is the
/// energy of the gravity between the body and its companions.
struct PotentialEnergies {
  double elastic = 0;  ///< stored energy, including the volumetric part and that of the branches
  double volumetric = 0, viscoelastic = 0, gravitational = 0, external = 0, contact = 0, interaction = 0;
  double total() const { return elastic + gravitational + external + contact + interaction; }
};

class PolynomialBody {
 public:
  using Vector = Eigen::VectorXd;
  static constexpr bool has_costly_force = true;

  explicit PolynomialBody(const BodySetup& setup);

  void apply_inverse_mass(const Vector& f, Vector& a) const { a = f; }
  void apply_mass(const Vector& v, Vector& f) const { f = v; }
  bool time_dependent() const { return driven_; }
  bool velocity_dependent() const { return constant_.damped(); }
  bool dissipative() const { return constant_.dissipative(); }
  bool has_contact() const { return !constant_.planes.empty(); }
  bool damping_is_linear() const { return !constant_.planes.rough(); }
  /// The number of coefficients q_ia if the body has viscosity, otherwise 0. A preconditioner needs this number
  /// (mechanics/core/damping_preconditioner.h).
  int n_damped_entries() const { return constant_.viscosity > 0 ? space_->n_unknowns() : 0; }
  bool relaxes() const { return !constant_.branches.empty(); }
  /// Replaces the internal metrics in q by their values at the end of a step of length h. `before` and q are the
  /// positions at the start and at the end of the step, and the metrics follow the mean of their strains. Adds the
  /// energy that the branches dissipate to two kinds of entries of v: the dissipated energy, and the energy that each
  /// branch has dissipated.
  void relax(double h, const Vector& before, Vector& q, Vector& v) const;
  /// The sums Σ μ_b C_b⁻¹ and Σ μ_b over the branches at a quadrature point. Branch b has the modulus μ_b and the
  /// internal metric C_b.
  materials::BranchesAtPoint branches_at(const Vector& q, int point) const;
  /// Sets the internal metrics in q. If `relaxed` is true, they become Ĉ = J^{−2/3} FᵀF at q and the branches have no
  /// stress. Otherwise they become the identity, which belongs to the undeformed body.
  void start_branches(bool relaxed, Vector& q) const;
  /// Returns `state` with the number of metrics of this body. The body of `state` may differ from this body only in its
  /// quadrature points. If the numbers of metrics differ, start_branches sets new metrics.
  mechanics::VectorState<Vector> with_points_of_body(mechanics::VectorState<Vector> state) const;
  Vector make_vector() const { return Vector::Zero(first_metric() + n_metric_entries()); }

  double kinetic_energy(const Vector& v) const { return 0.5 * v.head(space_->n_unknowns()).squaredNorm(); }
  /// The total potential energy at the time 0. It is infinite if q is not an admissible deformation.
  double potential_energy(const Vector& q) const;
  /// The parts of the potential energy at the time t. The deformation q must be admissible.
  PotentialEnergies potential_energies(double t, const Vector& q) const;
  /// Number of rotations and translations of space that are symmetries (loads::free_motions). It is 0 if a load depends
  /// on time.
  int n_symmetries() const { return static_cast<int>(free_.turns.size() + free_.translations.size()); }
  /// Sets the coefficients dq and dv for symmetry i with the unit vector ê of its axis. For a rotation, dq =
  /// ê×(x − x_c) and dv = ê×(ẋ − ẋ_c) with the mean x_c. For a translation, dq = ê and dv = 0. Rotations come first.
  void symmetry(int i, const Vector& q, const Vector& v, Vector& dq, Vector& dv) const;

  /// f ← f − C u for viscosity, drag, and the damping and friction of contacts. C is the linearisation `kind` of the
  /// damping force at `state` (mechanics/core/damping.h).
  void add_damping(const mechanics::VectorState<Vector>& state, const Vector& u, mechanics::Linearization kind,
                   Vector& f) const;
  /// f ← f + rate of the conservative forces along u at the time 0. The forces are those of the stress, the constant
  /// loads, self-gravity and the rigid planes. Companions, branches and other loads that depend on time are not
  /// included.
  void add_force_rate(const Vector& q, const Vector& u, Vector& f) const;

  const PolynomialSpace& space() const { return *space_; }
  const materials::AnyLaw& law() const { return law_; }
  /// The self-gravity, or null if there is none.
  const BodyGravity* gravity() const { return gravity_.get(); }
  /// The contact with rigid planes at the time t and the position q. Without planes, the force is 0 and the height is
  /// infinite.
  loads::Contact contact(double t, const Vector& q) const {
    return contact_ ? contact_->contact(t, q) : loads::Contact{};
  }
  double volumetric_stiffness() const { return volumetric_stiffness_; }
  double projected_bulk() const { return projected_bulk_; }
  const loads::Forcing& constant_forcing() const { return constant_; }

  /// Coefficients of x = c + A X, or of a velocity of this form. All other entries are 0.
  Vector affine(const Eigen::Matrix3d& A, const Eigen::Vector3d& c = Eigen::Vector3d::Zero()) const;
  /// Replaces the coefficients of a field x by those of the field D x. All other entries do not change. D must have the
  /// symmetry planes of the space.
  void transform(const Eigen::Matrix3d& D, Vector& x) const;
  const mechanics::Orbit& orbit() const { return orbit_; }
  /// The coordinates s_k of the companions (mechanics/core/orbit.h) in a vector, one column for each companion.
  mechanics::Orbit::Columns companions(const Vector& q) const {
    return Eigen::Map<const Eigen::Matrix3Xd>(q.data() + first_of_orbit(), 3, orbit_.n());
  }
  void set_companions(const mechanics::Orbit::Columns& s, Vector& q) const {
    Eigen::Map<Eigen::Matrix3Xd>(q.data() + first_of_orbit(), 3, orbit_.n()) = s;
  }
  /// ∫ρ(x − x_c)(x − x_c)ᵀ with the centre of mass x_c.
  Eigen::Matrix3d second_moment(const Vector& q) const;
  /// Adds `energy` to the dissipated energy in v. The body must have the coordinates of the energies (n_accounts() >
  /// 0).
  void add_taken(double energy, Vector& v) const { v[space_->n_unknowns()] += energy; }
  double dissipated(const Vector& v) const { return n_accounts() > 0 ? v[space_->n_unknowns()] : 0; }
  /// The energy that each branch has dissipated in the whole body, from the velocity v.
  materials::BranchEnergies dissipated_by_branches(const Vector& v) const {
    materials::BranchEnergies energies{};
    for (std::size_t b = 0; b < constant_.branches.list.size(); ++b)
      energies[b] = v[first_branch_account() + static_cast<int>(b)];
    return energies;
  }
  /// The energy that loads have given by their change in time, from the velocity v.
  double given(const Vector& v) const { return n_accounts() > 0 ? v[space_->n_unknowns() + 1] : 0; }

  /// Fails if q is not an admissible deformation of this body. If the law has a limit and det F is positive at all
  /// points, the reason is this limit. Otherwise the reason contains the least det F and its place.
  mechanics::Status admissible(const Vector& q) const;
  /// The least det F over the quadrature points as text, such as "det F = 0.61 at X/r = (0.000, 0.000, 0.930)". NaN
  /// counts as the least value.
  std::string least_jacobian_in_words(const Vector& q) const;
  /// The least value of a function of F over the quadrature points, or NaN if the function is NaN at a point.
  double least(const Vector& q, const std::function<double(const Eigen::Matrix3d& F)>& value) const;

 protected:
  /// Sets f to all forces without the reactions. If `held_at` is not null and there are planes, springs on the whole
  /// surface replace the contact. The springs pull each point of the surface towards its position for the coefficients
  /// `*held_at`, with the stiffness Planes::stiffness_of_all. The total stiffness is then an upper bound for the
  /// stiffness with contact. The search for a stable step needs this bound. Fails if q is not an admissible
  /// deformation.
  mechanics::Status applied_force(double t, const Vector& q, const Vector& v, const Vector* held_at, Vector& f) const;
  /// The failure that `admissible` returns, for a deformation that is not admissible.
  [[gnu::cold, gnu::noinline]] mechanics::Status inadmissible(const Vector& q) const;

 private:
  /// Number of coordinates whose velocities are energies: the dissipated energy, the given energy, and the energy that
  /// each branch has dissipated. The number is 0 if there is no dissipation, no load depends on time and no plane
  /// moves.
  int n_accounts() const {
    return driven_ || constant_.dissipative() ? 2 + static_cast<int>(constant_.branches.list.size()) : 0;
  }
  int first_branch_account() const { return space_->n_unknowns() + 2; }
  int first_of_orbit() const { return space_->n_unknowns() + n_accounts(); }
  int first_metric() const { return first_of_orbit() + 3 * orbit_.n(); }
  int n_metric_entries() const {
    return static_cast<int>(constant_.branches.list.size()) * materials::Symmetric<double>::n_entries *
           space_->n_points();
  }
  void add_companions(const Vector& q, Vector& f) const;
  void add_loads(const loads::Forcing& forcing, const Vector& q, Vector& f) const;
  double external_energy(const loads::Forcing& forcing, const Vector& q, const double* F) const;
  /// Adds the viscous stress at the velocity v, times the quadrature weights, to T. Returns the dissipated power.
  double add_dissipation(const Vector& v, const double* F, double* T) const;

  std::shared_ptr<const PolynomialSpace> space_;
  materials::AnyLaw law_;
  double volumetric_stiffness_, projected_bulk_;
  loads::Loads loads_;
  loads::Forcing constant_;  ///< loads that do not depend on time, with all planes
  bool driven_;              ///< true if a load depends on time or a plane moves
  loads::FreeMotions free_;  ///< rotations and translations of space that are symmetries
  std::shared_ptr<const BodyGravity> gravity_;
  std::shared_ptr<const BodyContact> contact_;  ///< null without planes
  mechanics::Orbit orbit_;
};

}  // namespace pseudorigid::polynomial
