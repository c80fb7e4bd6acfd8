#pragma once
/// A heavy point on a massless rod that can rotate about its upper end. The z axis points upwards. For the mass m, the
/// length l of the rod, the acceleration of gravity g and the drag coefficient c, the motion satisfies
///
///   m q̈ = −m g e_z − c q̇ + λ q/l²,   ½(|q|²/l² − 1) = 0,   V = m g z,
///
/// with the multiplier λ and the potential V. The tension −λ/l of the rod is positive if the rod pulls. Without drag,
/// the energy E and the angular momentum about the vertical, m (x ẏ − y ẋ), are constant. With drag, dE/dt = −c |q̇|².
/// With gravity, the equilibria are the hanging point (Morse index 0) and the standing point (Morse index 2).

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "entries/entry_kinds.h"
#include "mechanics/equilibria/constrained_landscape.h"
#include "systems/system_scene.h"
#include "systems/systems_in_lanes.h"

namespace pseudorigid::systems {

class SphericalPendulum {
 public:
  using Vector = Eigen::Vector3d;
  using Multiplier = double;
  struct Workspace {};
  static constexpr int n_constraints = 1;

  struct Parameters {
    double m = 1, l = 1, g = 1, c = 0;
  };

  explicit SphericalPendulum(const Parameters& parameters) : p_(parameters) {}

  mechanics::Status force(double, const Vector&, const Vector& v, Workspace&, Vector& f) const {
    f = -p_.m * p_.g * Vector::UnitZ() - p_.c * v;
    return {};
  }
  void apply_inverse_mass(const Vector& f, Vector& a) const { a = f / p_.m; }

  /// The next three members are for methods on the explicit acceleration, with the multiplier as a function of the
  /// state (mechanics/core/explicit_multiplier.h, stage_by_stage.h). The acceleration fails if |q| is 0 or NaN.
  mechanics::Status acceleration(double, const Vector& q, const Vector& v, Workspace&, Vector& a) const {
    if (of_stages()(0, q.data(), v.data(), a.data()) > 0) return {};
    return mechanics::Status::failure("the point is at the end of the rod that is held, or nowhere");
  }
  bool solve_stages_in_lanes(mechanics::GaussStages& stages) const {
    return solve_stages_in_lanes_of(of_stages(), stages);
  }
  double cost_of_iteration() const { return cost_of_iteration_in_lanes<SphericalPendulumOfStages>; }

  mechanics::Status constraint(const Vector& q, Multiplier& g) const {
    g = 0.5 * (q.squaredNorm() / l2() - 1);
    return {};
  }
  void constraint_rate(const Vector& q, const Vector& v, Multiplier& r) const { r = q.dot(v) / l2(); }
  void constraint_curvature(const Vector&, const Vector& v, Multiplier& r) const { r = v.squaredNorm() / l2(); }
  void add_reaction(const Vector& q, const Multiplier& lambda, Vector& f) const { f += lambda / l2() * q; }
  /// Solves G(q₁)M⁻¹G(q₀)ᵀλ = r with the derivative G of the constraint and the mass operator M. Fails unless the angle
  /// between q₁ and q₀ is less than a right angle.
  mechanics::SolveReport solve_gram(const Vector& q1, const Vector& q0, const Multiplier& r, Workspace&,
                                    Multiplier& lambda) const {
    const double S = q1.dot(q0) / (p_.m * l2() * l2());  // G(q₁) M⁻¹ G(q₀)ᵀ
    if (!(S > 0)) return {mechanics::Status::failure("the rod turns by a right angle in one step; use a smaller step")};
    lambda = r / S;
    return {};
  }
  /// The largest residual of the constraint that counts as zero, about twice the machine precision.
  double constraint_tolerance() const { return 4e-16; }
  Vector make_vector() const { return Vector::Zero(); }
  Multiplier make_multiplier() const { return 0; }
  Workspace make_workspace() const { return {}; }

  bool velocity_dependent() const { return p_.c != 0; }
  bool dissipative() const { return p_.c != 0; }

  double kinetic_energy(const Vector& v) const { return 0.5 * p_.m * v.squaredNorm(); }
  double potential_energy(const Vector& q) const { return p_.m * p_.g * q.z(); }
  void apply_mass(const Vector& v, Vector& f) const { f = p_.m * v; }
  /// The constraint is quadratic. Therefore the rate of G(q)ᵀλ along v is G(v)ᵀλ, which this function adds to f.
  void add_reaction_rate(const Vector&, const Vector& v, const Multiplier& lambda, Vector& f) const {
    add_reaction(v, lambda, f);
  }
  /// The number of symmetries: the rotations about the vertical, or without gravity the rotations about three axes.
  /// Symmetry 0 is the rotation about the vertical.
  int n_symmetries() const { return p_.g == 0 ? 3 : 1; }
  void symmetry(int i, const Vector& q, const Vector& v, Vector& dq, Vector& dv) const {
    const Vector axis = Vector::Unit(2 - i);
    dq = axis.cross(q);
    dv = axis.cross(v);
  }

  const Parameters& parameters() const { return p_; }

 private:
  double l2() const { return p_.l * p_.l; }
  SphericalPendulumOfStages of_stages() const { return {p_.g, p_.c / p_.m}; }

  Parameters p_;
};

struct SphericalPendulumScene {
  static constexpr std::string_view name = "spherical pendulum", file = "spherical_pendulum",
                                    section = "Spherical pendulum";
  static constexpr std::string_view documentation =
      "A heavy point on a massless rod that is free to turn about its upper end, with drag if asked for, z pointing "
      "up.";
  static constexpr bool has_equilibria = true;

  double m = 1, l = 1, gravity = 9.81, drag = 0;
  std::vector<double> angles{1, 0}, rates{0, 1};

  template <class Self, class Visit>
  static void visit(Self& s, Visit&& visit) {
    visit(s.m, scene::positive, About{"Spherical pendulum/Mass", "mass", "Mass of the point."});
    visit(s.l, scene::positive, About{"Spherical pendulum/Length", "length", "Length of the rod."});
    visit(s.gravity, scene::Number{.low = 0},
          About{"Spherical pendulum/Gravity", "length/time^2", "Acceleration of gravity."});
    visit(s.drag, scene::Number{.low = 0},
          About{"Spherical pendulum/Drag", "mass/time", "Drag c: the force of the air is -c times the velocity."});
    visit(s.angles, scene::Numbers{2},
          About{"Spherical pendulum/Angles", "",
                "Initial angles theta, phi in radians: theta from the downward vertical, phi around it from the x "
                "axis."});
    visit(s.rates, scene::Numbers{2}, About{"Spherical pendulum/Rates", "1/time", "Initial rates of theta and phi."});
  }

  /// Refuses a rate of φ if the rod is vertical, because φ is then not defined.
  std::optional<Refusal> refuses() const {
    if (rates[1] == 0 || std::abs(std::sin(angles[0])) > 1e-12) return {};
    return Refusal{"Spherical pendulum/Rates", "expected no rate of phi where the rod is vertical and has no phi"};
  }

  /// The units of length and mass are l and m. The unit of time is √(l/g). Without gravity, it is the reciprocal of the
  /// largest absolute value of an initial rate, or 1 at rest.
  Scales scales() const {
    const double rate = std::max(std::abs(rates[0]), std::abs(rates[1]));
    return {l, m, gravity > 0 ? std::sqrt(l / gravity) : rate > 0 ? 1 / rate : 1};
  }

  std::vector<Column> columns() const {
    return {{"x", "length", "position of the point"},
            {"y", "length", "position of the point"},
            {"z", "length", "position of the point, upwards"},
            {"vx", "length/time", "velocity"},
            {"vy", "length/time", "velocity"},
            {"vz", "length/time", "velocity"},
            {"kinetic", "mass*length^2/time^2", "kinetic energy"},
            {"potential", "mass*length^2/time^2", "potential energy, 0 at the height of the suspension"},
            {"energy", "mass*length^2/time^2", "their sum"},
            {"momentum", "mass*length^2/time", "angular momentum about the vertical"},
            {"tension", "mass*length/time^2", "force along the rod by the multiplier, positive if it pulls"},
            {"tension_by_curvature", "mass*length/time^2",
             "the same by the second fundamental form of the sphere (5.29), without multiplier"}};
  }

  struct Model {
    using System = SphericalPendulum;
    System system;
    mechanics::State<System> initial;

    mechanics::Status row(const mechanics::State<System>& state, System::Workspace& workspace,
                          std::vector<double>& row) const {
      double lambda = 0;
      if (auto status = mechanics::multiplier_of_motion(system, state, workspace, lambda); !status) return status;
      const double K = system.kinetic_energy(state.v), V = system.potential_energy(state.q);
      const auto& p = system.parameters();
      row.insert(row.end(), state.q.begin(), state.q.end());
      row.insert(row.end(), state.v.begin(), state.v.end());
      Eigen::Vector3d force;
      if (auto status = system.force(state.t, state.q, state.v, workspace, force); !status) return status;
      // The reaction is R = −(m|v|² + ⟨F, q⟩) q/l², from (5.29) with the second fundamental form B(v, v) = −|v|²q/l².
      const double by_curvature = (p.m * state.v.squaredNorm() + force.dot(state.q)) / p.l;
      row.insert(row.end(), {K, V, K + V, p.m * state.q.cross(state.v).z(), -lambda / p.l, by_curvature});
      return {};
    }
    auto landscape() const { return mechanics::ConstrainedLandscape<System>(system); }
    std::vector<Column> coordinates() const { return {{"x", "length", ""}, {"y", "length", ""}, {"z", "length", ""}}; }
  };

  template <class Run>
  auto with_model(Run&& run) const {
    const double sine = std::sin(angles[0]), cosine = std::cos(angles[0]);
    const Eigen::Vector2d across(std::cos(angles[1]), std::sin(angles[1])), around(-across.y(), across.x());
    mechanics::State<SphericalPendulum> initial{};
    initial.q << l * sine * across, -l * cosine;
    initial.v << l * (cosine * rates[0] * across + sine * rates[1] * around), l * sine * rates[0];
    return run(Model{SphericalPendulum({m, l, gravity, drag}), initial});
  }
};

}  // namespace pseudorigid::systems
