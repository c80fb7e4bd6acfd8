#pragma once
/// Observables of a ball at one time, and the columns of the CSV files that contain them. Observables are for the whole
/// ball, even if only a sector between symmetry planes is computed. This file declares the columns, each with its name,
/// group, unit, meaning and computation. The class io::Trajectory makes headers, rows, units and documentation from
/// these columns.
///
///   K = ½ ∫ρ|ẋ|² dV,   J = ∫ρ (x−x_c)×(ẋ−ẋ_c) dV,   Z = ∫ρ X×(Fᵀ(ẋ−ẋ_c)) dV
///
/// are the kinetic energy, the angular momentum and the circulation. The integrals are over the reference body with its
/// density ρ. X is the reference position, x the position, F = ∂x/∂X, x_c the centre of mass and ẋ_c its velocity. The
/// second moment of mass of the reference body is E₀ = ∫ρ X Xᵀ dV, and m̄ = tr E₀/3.
///
/// The motion of the pseudo-rigid body is x = QX + x_c. For a ball, E₀ = m̄ Id, and this motion has J_i = m̄ ε_ijk Q_jA
/// Q̇_kA and Z_A = m̄ ε_ABC (QᵀQ̇)_CB. A rigid rotation of a ball with angular velocity ω at Q = Id has J = Z = 2m̄ω. For
/// motions that are not affine, the mass moment Q_M = (∫ρ (x − x_c) Xᵀ dV) E₀⁻¹ takes the place of Q. All observables
/// are in internal units (entries/units.h).
///
/// To add an observable, add a member and a column, and set the member in the models that have it (reduced/observe.h,
/// polynomial/observe.cpp, continuum/output/observe.cpp). An observable that a model does not set is NaN. If the column
/// of such an observable is requested, the run ends at its first sample. The observables of contact and the two
/// energies of orbits are 0 if a model does not set them.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <limits>
#include <string_view>
#include <variant>
#include <vector>

#include "entries/unit.h"
#include "mechanics/core/kepler.h"
#include "mechanics/core/principal_axes.h"
#include "observables/observable_request.h"
#include "observables/quantities.h"

namespace pseudorigid::mechanics {

/// The value of an observable that a model does not set.
inline constexpr double not_observed = std::numeric_limits<double>::quiet_NaN();

/// The entries 12, 13 and 23 of an antisymmetric matrix.
struct AntisymmetricEntries {
  Eigen::Vector3d values;
};

/// One or several columns with the components of one observable. The type Observables is ReducedObservables or
/// ContinuumObservables.
template <class Observables>
struct BodyColumn {
  std::string_view name;
  bool Quantities::*group;  ///< the group of Output/Quantities that contains the column
  scene::Unit unit;
  std::string_view documentation;
  /// The value in internal units. It is a scalar, a vector (name1 … name3 or name4), a matrix (name11 … name33, row by
  /// row), or an antisymmetric matrix (name12, name13, name23). It can also be the least or largest value over the
  /// quadrature points (OverPoints).
  std::variant<double (*)(const Observables&), Eigen::Vector3d (*)(const Observables&),
               Eigen::Vector4d (*)(const Observables&), Eigen::Matrix3d (*)(const Observables&),
               AntisymmetricEntries (*)(const Observables&), OverPoints>
      value;
};

/// Contact with rigid planes. The members from `energy` to `point` describe the current state (loads/contact.h), and
/// are 0 if no point of the body touches a plane. The other members summarise the run up to the current time
/// (app/run/contact_watch.h). They are the beginning of the first contact, the end of the last contact, the largest
/// force and the coefficient of restitution. Before the first contact, these members are 0.
struct ContactObservables {
  double energy = 0, force = 0, penetration = 0, radius = 0, pressure_radius = 0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double first = 0, last = 0, largest_force = 0, restitution = 0;

  /// Sets the members from `energy` to `point` to the values of a loads::Contact.
  template <class Contact>
  void take(const Contact& now) {
    energy = now.energy;
    force = now.force;
    penetration = now.penetration();
    radius = now.radius;
    pressure_radius = now.pressure_radius;
    point = now.point;
  }
};

/// The energy of vibration (observables/vibration.h). The entry of_degree[n − first_degree] is the part of this energy
/// in spheroidal motions of degree n.
struct VibrationObservables {
  static constexpr int first_degree = 2, last_degree = 8;
  using Parts = std::array<double, last_degree - first_degree + 1>;

  double energy = not_observed;
  Parts of_degree = [] {
    Parts unknown;
    unknown.fill(not_observed);
    return unknown;
  }();
};

/// The von Mises stress √(3/2) |dev σ| with the Cauchy stress σ of the law and of viscoelastic branches, without
/// viscosity and volumetric stabilisation. Pressure does not change it. Its mean is over the reference body.
struct StressObservables {
  double mean = not_observed, largest = not_observed, at_center = not_observed;
};

/// The motion of the companions relative to the centre of mass of the body. The header observables/orbit.h has the
/// formulas, and the texts of the columns below explain the members. Without companions, the energies are 0 and the
/// other members are NaN. The elements and the members from `lag` to `obliquity` refer to the first companion, and
/// `torque` to all companions. If a finite-element body uses the full potential of the companions, `interaction` and
/// `torque` are computed from this potential.
struct OrbitObservables {
  double kinetic = 0;  ///< kinetic energy of the orbits about the common centre of mass
  /// Potential energy of the gravity between the body and the companions, and between the companions.
  double interaction = 0;
  /// Positions and velocities of the first and of the second companion, relative to the centre of mass of the body.
  Eigen::Vector3d position = Eigen::Vector3d::Constant(not_observed), velocity = position;
  Eigen::Vector3d second_position = position, second_velocity = position;
  KeplerElements elements{not_observed, not_observed, not_observed, not_observed, not_observed, not_observed};
  double lag = not_observed, k2 = not_observed, inverse_Q = not_observed, obliquity = not_observed;
  Eigen::Vector3d torque = position, spin = position, total_momentum = position;
};

/// Observables that every model of the ball has. The texts of the columns with the same names below explain the
/// energies.
struct BodyObservables {
  Eigen::Matrix3d Q = Eigen::Matrix3d::Constant(not_observed);     ///< Q or Q_M (head of this file)
  Eigen::Matrix3d Qdot = Eigen::Matrix3d::Constant(not_observed);  ///< time derivative of Q
  /// Centre of mass x_c and its velocity. With companions, both are those of the body and the companions together.
  Eigen::Vector3d center = Eigen::Vector3d::Constant(not_observed);
  Eigen::Vector3d velocity = Eigen::Vector3d::Constant(not_observed);
  double kinetic = not_observed, elastic = not_observed, gravitational = not_observed, external = not_observed,
         dissipated = not_observed;
  double viscoelastic = not_observed;  ///< energy stored by viscoelastic branches, a part of `elastic`
  /// Energy dissipated by each viscoelastic branch, a part of `dissipated`. The entries of branches that the body does
  /// not have are 0.
  Eigen::Vector4d dissipated_by_branches = Eigen::Vector4d::Constant(not_observed);
  Eigen::Vector3d angular_momentum = Eigen::Vector3d::Constant(not_observed);  ///< J about the centre of mass
  Eigen::Vector3d circulation = Eigen::Vector3d::Constant(not_observed);       ///< Z about the centre of mass
  double volume_ratio = not_observed;                                          ///< current volume / reference volume
  /// For the incompressible pseudo-rigid ball, the multiplier Λ of the constraint ln det Q = 0, divided by m̄. This is
  /// λ of Oliva (5.120). For motions that are not affine, it is (1/m̄)∫p dV with the Kirchhoff pressure p. It is 0 for
  /// compressible bodies.
  double multiplier = not_observed;
  /// The semi-axes a₁ ≥ a₂ ≥ a₃ of the ellipsoid Q S B with the unit ball B: the singular values of Q S. The reference
  /// body is the ellipsoid S B. For a ball of radius r, S = r Id.
  Eigen::Vector3d semi_axes = Eigen::Vector3d::Constant(not_observed);
  std::vector<double> over_points{};  ///< one value for each entry of ObservableRequest::over_points
  ContactObservables contact{};
  OrbitObservables orbit{};
  VibrationObservables vibration{};
  StressObservables stress{};

  /// The sum of all energies and of the dissipated energy.
  double energy() const {
    return kinetic + elastic + gravitational + external + dissipated + contact.energy + orbit.kinetic +
           orbit.interaction;
  }
};

/// The columns of the observables that every model has.
template <class O>
inline constexpr BodyColumn<O> common_columns[] = {
    {"Q", &Quantities::state, "", "deformation; of the continuum the mass moment Q_M, the affine motion nearest to it",
     [](const O& o) { return o.Q; }},
    {"Qdot", &Quantities::state, "1/time", "its rate", [](const O& o) { return o.Qdot; }},
    {"x", &Quantities::state, "length", "centre of mass", [](const O& o) { return o.center; }},
    {"v", &Quantities::state, "length/time", "velocity of the centre of mass", [](const O& o) { return o.velocity; }},
    {"kinetic", &Quantities::energies, "mass*length^2/time^2", "kinetic energy", [](const O& o) { return o.kinetic; }},
    {"elastic", &Quantities::energies, "mass*length^2/time^2", "stored energy", [](const O& o) { return o.elastic; }},
    {"viscoelastic", &Quantities::branches, "mass*length^2/time^2",
     "part of the elastic energy that viscoelastic branches store; with the energies, if the scene has branches",
     [](const O& o) { return o.viscoelastic; }},
    {"gravitational", &Quantities::energies, "mass*length^2/time^2", "energy of the self-gravity",
     [](const O& o) { return o.gravitational; }},
    {"external", &Quantities::energies, "mass*length^2/time^2",
     "energy of all loads, minus the energy that time-dependent loads and moving planes have given to the body",
     [](const O& o) { return o.external; }},
    {"dissipated", &Quantities::energies, "mass*length^2/time^2",
     "energy dissipated by viscosity, branches, drag and contact", [](const O& o) { return o.dissipated; }},
    {"branch_dissipated", &Quantities::branches, "mass*length^2/time^2",
     "parts of it by the viscoelastic branches, in the order of Material/Branch moduli; 0 for branches that the scene "
     "does not have",
     [](const O& o) { return o.dissipated_by_branches; }},
    {"energy", &Quantities::energies, "mass*length^2/time^2", "their sum", [](const O& o) { return o.energy(); }},
    {"J", &Quantities::momenta, "mass*length^2/time", "angular momentum about the centre of mass",
     [](const O& o) { return o.angular_momentum; }},
    {"Z", &Quantities::momenta, "mass*length^2/time",
     "circulation, the integral of rho X x (F^T v) about the centre of mass; a rigid spin of the undeformed ball has "
     "J = Z",
     [](const O& o) { return o.circulation; }},
    {"volume_ratio", &Quantities::axes, "", "current volume / reference volume",
     [](const O& o) { return o.volume_ratio; }},
    {"multiplier", &Quantities::multiplier, "1/time^2",
     "multiplier of det Q = 1 per tr E0/3 (of the ball, lambda of Oliva 5.120); of the continuum the integral of the "
     "Kirchhoff pressure per tr E0/3. Positive is pressure",
     [](const O& o) { return o.multiplier; }},
    {"a", &Quantities::axes, "length", "semi-axes of Q, in descending order", [](const O& o) { return o.semi_axes; }},
    {"mean_von_mises", &Quantities::stresses, "pressure",
     "mean over the reference body of the von Mises stress, without viscosity",
     [](const O& o) { return o.stress.mean; }},
    {"max_von_mises", &Quantities::stresses, "pressure", "largest von Mises stress at the integration points",
     [](const O& o) { return o.stress.largest; }},
    {"center_von_mises", &Quantities::stresses, "pressure",
     "von Mises stress at the integration points nearest to the material centre",
     [](const O& o) { return o.stress.at_center; }},
    {"contact", &Quantities::contact, "mass*length^2/time^2",
     "energy of the contact with rigid planes, if the scene has planes, as the columns after it",
     [](const O& o) { return o.contact.energy; }},
    {"contact_force", &Quantities::contact, "mass*length/time^2", "normal force of the plane that presses most",
     [](const O& o) { return o.contact.force; }},
    {"contact_point", &Quantities::contact, "length", "its centre of pressure; 0 without contact",
     [](const O& o) { return o.contact.point; }},
    {"contact_radius", &Quantities::contact, "length",
     "radius of a circle with the undeformed area of the surface that touches this plane",
     [](const O& o) { return o.contact.radius; }},
    {"pressure_radius", &Quantities::contact, "length",
     "radius of the contact by its pressure, sqrt(5/2) times the root mean square distance along the plane from the "
     "centre of pressure. It is exact for the pressure of Hertz",
     [](const O& o) { return o.contact.pressure_radius; }},
    {"penetration", &Quantities::contact, "length", "largest distance of the surface behind a plane",
     [](const O& o) { return o.contact.penetration; }},
    {"first_contact", &Quantities::contact, "time",
     "begin of the first contact, interpolated between steps; 0 before it", [](const O& o) { return o.contact.first; }},
    {"last_contact", &Quantities::contact, "time",
     "end of the last contact so far, interpolated between steps; 0 before it",
     [](const O& o) { return o.contact.last; }},
    {"largest_force", &Quantities::contact, "mass*length/time^2", "largest contact_force at the ends of steps so far",
     [](const O& o) { return o.contact.largest_force; }},
    {"restitution", &Quantities::contact, "",
     "normal velocity of the centre of mass relative to the plane after the last contact, over the approach velocity "
     "before the first; 0 before the end of a contact",
     [](const O& o) { return o.contact.restitution; }},
    {"vibration", &Quantities::vibration, "mass*length^2/time^2",
     "kinetic energy relative to a rigid motion with the same momenta, plus the elastic energy",
     [](const O& o) { return o.vibration.energy; }},
    {"vibration_2", &Quantities::vibration, "mass*length^2/time^2",
     "its part in spheroidal motions of degree 2, for small strains; all of it for the reduced model",
     [](const O& o) { return o.vibration.of_degree[0]; }},
    {"vibration_3", &Quantities::vibration, "mass*length^2/time^2", "its part of degree 3",
     [](const O& o) { return o.vibration.of_degree[1]; }},
    {"vibration_4", &Quantities::vibration, "mass*length^2/time^2", "its part of degree 4",
     [](const O& o) { return o.vibration.of_degree[2]; }},
    {"vibration_5", &Quantities::vibration, "mass*length^2/time^2", "its part of degree 5",
     [](const O& o) { return o.vibration.of_degree[3]; }},
    {"vibration_6", &Quantities::vibration, "mass*length^2/time^2", "its part of degree 6",
     [](const O& o) { return o.vibration.of_degree[4]; }},
    {"vibration_7", &Quantities::vibration, "mass*length^2/time^2", "its part of degree 7",
     [](const O& o) { return o.vibration.of_degree[5]; }},
    {"vibration_8", &Quantities::vibration, "mass*length^2/time^2", "its part of degree 8",
     [](const O& o) { return o.vibration.of_degree[6]; }},
    {"orbital", &Quantities::orbit, "mass*length^2/time^2",
     "kinetic energy of the orbit about the common centre of mass, if the scene has a companion, as the columns after "
     "it",
     [](const O& o) { return o.orbit.kinetic; }},
    {"interaction", &Quantities::orbit, "mass*length^2/time^2",
     "energy of the gravity between body and companions, to degree 2 in the size of the body; of finite elements with "
     "Companions/Full potential, the whole energy",
     [](const O& o) { return o.orbit.interaction; }},
    {"companion", &Quantities::orbit, "length", "position of the companion, relative to the centre of the body",
     [](const O& o) { return o.orbit.position; }},
    {"companion_velocity", &Quantities::orbit, "length/time", "its velocity, relative to the centre of the body",
     [](const O& o) { return o.orbit.velocity; }},
    {"semi_major_axis", &Quantities::orbit, "length",
     "of the Kepler orbit of point masses with this position and velocity; negative for a hyperbola",
     [](const O& o) { return o.orbit.elements.semi_major_axis; }},
    {"eccentricity", &Quantities::orbit, "", "of this Kepler orbit",
     [](const O& o) { return o.orbit.elements.eccentricity; }},
    {"inclination", &Quantities::orbit, "", "of this orbit to the plane z = 0, in radians, as all angles",
     [](const O& o) { return o.orbit.elements.inclination; }},
    {"ascending_node", &Quantities::orbit, "", "longitude of the ascending node from the x axis; 0 in the plane z = 0",
     [](const O& o) { return o.orbit.elements.ascending_node; }},
    {"argument_of_pericentre", &Quantities::orbit, "",
     "angle from the ascending node to the pericentre; round-off in a circular orbit",
     [](const O& o) { return o.orbit.elements.argument_of_pericentre; }},
    {"mean_anomaly", &Quantities::orbit, "", "mean anomaly from this pericentre; of a hyperbola e sinh H - H",
     [](const O& o) { return o.orbit.elements.mean_anomaly; }},
    {"lag", &Quantities::orbit, "",
     "angle in the orbital plane from the companion to the long axis of the second moment, in radians; positive if the "
     "bulge is ahead of the companion",
     [](const O& o) { return o.orbit.lag; }},
    {"k2", &Quantities::orbit, "",
     "size of the bulge in the orbital plane over that of a ball with Love number 1. It is |k2| of a ball with a small "
     "tide in a circular orbit, with the spin along its normal, after the free oscillations",
     [](const O& o) { return o.orbit.k2; }},
    {"inverse_Q", &Quantities::orbit, "",
     "1/Q = |sin(2 lag)|, the inverse quality factor of the tide under the same conditions",
     [](const O& o) { return o.orbit.inverse_Q; }},
    {"torque", &Quantities::orbit, "mass*length^2/time^2", "torque of the companions on the body about its centre",
     [](const O& o) { return o.orbit.torque; }},
    {"spin", &Quantities::orbit, "1/time", "angular velocity of a rigid body with the same J and second moment",
     [](const O& o) { return o.orbit.spin; }},
    {"obliquity", &Quantities::orbit, "", "angle from the normal of the orbit to the spin, in radians",
     [](const O& o) { return o.orbit.obliquity; }},
    {"total_J", &Quantities::orbit, "mass*length^2/time", "angular momentum of body and orbit",
     [](const O& o) { return o.orbit.total_momentum; }},
    {"second_companion", &Quantities::second_orbit, "length",
     "position of the second companion, relative to the centre of the body",
     [](const O& o) { return o.orbit.second_position; }},
    {"second_companion_velocity", &Quantities::second_orbit, "length/time", "its velocity",
     [](const O& o) { return o.orbit.second_velocity; }},
};

/// Observables of the pseudo-rigid body only.
struct ReducedObservables : BodyObservables {
  double central_pressure = not_observed;  ///< p_c of the pressure p_c(1 − |ξ|²), the reaction to
                                           ///< det Q = 1; |ξ| = 1 is the surface
  Eigen::Vector3d axes = Eigen::Vector3d::Constant(not_observed);  ///< r A_ii of Q = TᵀAS, continuous in time
  /// Rotations T and S of the bipolar decomposition Q = TᵀAS with a diagonal matrix A.
  Eigen::Matrix3d T = Eigen::Matrix3d::Constant(not_observed), S = T;
  Eigen::Vector3d Omega_star = Eigen::Vector3d::Constant(not_observed);   ///< entries 12, 13, 23 of Ω* = ṪTᵀ
  Eigen::Vector3d Lambda_star = Eigen::Vector3d::Constant(not_observed);  ///< entries 12, 13, 23 of Λ* = ṠSᵀ
  double bipolar_residual = not_observed;  ///< largest absolute entry of the residual of equation (5.121) of Oliva,
                                           ///< divided by m̄ = tr E₀/3 (reduced/bipolar.h)
};

inline constexpr BodyColumn<ReducedObservables> reduced_columns[] = {
    {"central_pressure", &Quantities::pressure, "pressure", "p_c of p = p_c (1 - |X|^2/r^2), the reaction to det Q = 1",
     [](const ReducedObservables& o) { return o.central_pressure; }},
    {"A", &Quantities::bipolar, "length", "semi-axes of Q = T^T A S, followed along the motion, in no order",
     [](const ReducedObservables& o) { return o.axes; }},
    {"T", &Quantities::bipolar, "", "rotation T of the bipolar decomposition",
     [](const ReducedObservables& o) { return o.T; }},
    {"S", &Quantities::bipolar, "", "rotation S of the bipolar decomposition",
     [](const ReducedObservables& o) { return o.S; }},
    {"Omega_star", &Quantities::bipolar, "1/time", "T' T^T",
     [](const ReducedObservables& o) { return AntisymmetricEntries{o.Omega_star}; }},
    {"Lambda_star", &Quantities::bipolar, "1/time", "S' S^T",
     [](const ReducedObservables& o) { return AntisymmetricEntries{o.Lambda_star}; }},
    {"bipolar_residual", &Quantities::bipolar, "1/time^2",
     "largest entry of the residual of Oliva (5.121), per tr E0/3",
     [](const ReducedObservables& o) { return o.bipolar_residual; }},
    {"stretch", &Quantities::stretches, "", "principal stretches of Q, in descending order",
     [](const ReducedObservables& o) { return singular_values(o.Q); }},
};

/// Observables that only models with motions that are not affine have.
struct ContinuumObservables : BodyObservables {
  Eigen::Matrix3d F = Eigen::Matrix3d::Constant(not_observed);  ///< mean of F = ∂x/∂X over the reference volume.
  /// Fraction of the kinetic energy relative to x_c that is not in the affine motion with Q_M, or 0 if this energy is
  /// 0.
  double nonaffine_kinetic_fraction = not_observed;
  double nonaffine_displacement = not_observed;  ///< |y − Q_M X|/|y|, y = x − x_c, |y|² = ∫ρ y·y dV
  double volumetric = not_observed;              ///< energy of the volumetric stabilisation, a part of `elastic`
  double min_jacobian = not_observed;            ///< least det F over the quadrature points
  double volume_error = not_observed;            ///< root mean square of ln det F over the reference volume
  double max_volume_error = not_observed;        ///< largest |ln det F| over the quadrature points
};

inline constexpr BodyColumn<ContinuumObservables> continuum_columns[] = {
    {"F", &Quantities::state, "", "mean deformation gradient", [](const ContinuumObservables& o) { return o.F; }},
    {"nonaffine_kinetic_fraction", &Quantities::nonaffine, "",
     "share of the kinetic energy that is not in the affine motion",
     [](const ContinuumObservables& o) { return o.nonaffine_kinetic_fraction; }},
    {"nonaffine_displacement", &Quantities::nonaffine, "", "|x - Q X| / |x|, norms weighted with the mass",
     [](const ContinuumObservables& o) { return o.nonaffine_displacement; }},
    {"min_jacobian", &Quantities::nonaffine, "", "least det F at the integration points",
     [](const ContinuumObservables& o) { return o.min_jacobian; }},
    {"volume_error", &Quantities::nonaffine, "", "root mean square of ln det F over the body",
     [](const ContinuumObservables& o) { return o.volume_error; }},
    {"max_volume_error", &Quantities::nonaffine, "", "largest |ln det F| at the integration points",
     [](const ContinuumObservables& o) { return o.max_volume_error; }},
    {"volumetric", &Quantities::volumetric, "mass*length^2/time^2",
     "part of the elastic energy that the volumetric stabilisation stores; with the energies, where it is on",
     [](const ContinuumObservables& o) { return o.volumetric; }},
    {"stretch", &Quantities::stretches, "", "principal stretches of the mean deformation gradient, in descending order",
     [](const ContinuumObservables& o) { return singular_values(o.F); }},
    {"max_stretch", &Quantities::stretches, "", "largest principal stretch at the integration points",
     OverPoints{true, [](const Eigen::Matrix3d& F) { return singular_values(F)[0]; }, largest_singular_value_bound}},
    {"min_stretch", &Quantities::stretches, "", "least principal stretch at the integration points",
     OverPoints{false, [](const Eigen::Matrix3d& F) { return singular_values(F)[2]; }, least_singular_value_bound}},
};

}  // namespace pseudorigid::mechanics
