#pragma once
/// Companions of a body: point masses that move under the gravity of the body and of each other. G is the gravitational
/// constant. The body has the mass M, the centre of mass x_c and the second moment S = ∫ρ(x − x_c)(x − x_c)ᵀ dV.
/// Companion i has the mass m_i and the position r_i relative to x_c. To second degree in the size of the body, the
/// energy is
///
///   U = −Σ_i G m_i [M/|r_i| + (3 r̂_iᵀS r̂_i − tr S)/(2|r_i|³)] − Σ_{i<j} G m_i m_j/|r_i − r_j|.
///
/// To the same degree, the companions act on the body by the quadratic potential ½(x − x_c)ᵀT(x − x_c) per mass,
///
///   T = Σ_i (G m_i/|r_i|³)(Id − 3 r̂_i r̂_iᵀ).
///
/// Jacobi's coordinates R_i separate the motion of the common centre of mass. R_i is the position of companion i
/// relative to the centre of mass of the body and the companions before it. With M_i = M + m_1 + … + m_i,
///
///   r_i = R_i + Σ_{k<i} (m_k/M_k) R_k,   kinetic energy ½ Σ μ_k |Ṙ_k|²,   μ_k = m_k M_{k−1}/M_k.
///
/// Models use the coordinates s_k = √μ_k R_k, so that the kinetic energy is ½ Σ |ṡ_k|². In the two-body problem of
/// companion k and a point of mass M_{k−1}, s_k moves on a conic (kepler_motion.h). The equation of this motion is s̈_k
/// = −k_k s_k/|s_k|³ with k_k = G M_k μ_k^{3/2}. A uniform acceleration changes only the motion of the common centre of
/// mass. In a model with companions, the centre of mass in the state is therefore that of the body and all companions.

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "mechanics/core/kepler.h"

namespace pseudorigid::mechanics {

struct Companion {
  double mass = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< r_i at the start
  std::optional<Eigen::Vector3d> velocity{};  ///< ṙ_i at the start. If empty, Ṙ_i has the speed of a circular orbit and
                                              ///< the horizontal direction of ẑ × R_i.
  /// The orbital elements of R_i at the start, for g = G M_i (kepler.h). If they are given, `position` and `velocity`
  /// are not used.
  std::optional<KeplerElements> elements{};

  bool operator==(const Companion& other) const {
    return mass == other.mass && position == other.position && velocity == other.velocity && elements == other.elements;
  }
};

/// A list of companions. `a += b` appends the companions of b, and sets a.full_potential to true if b.full_potential is
/// true.
struct Companions : std::vector<Companion> {
  using std::vector<Companion>::vector;

  /// True if a finite-element body uses the whole potential of the companions. If false, the potential is expanded to
  /// second degree in the size of the body.
  bool full_potential = false;

  Companions& operator+=(const Companions& others) {
    insert(end(), others.begin(), others.end());
    full_potential = full_potential || others.full_potential;
    return *this;
  }
};

/// The companions of one body: their initial states, their energy and their forces.
class Orbit {
 public:
  static constexpr int most_companions = 2;
  /// A matrix with one column for each companion. A column is s_k, r_i, the rate of one of these, or a force.
  using Columns = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, most_companions>;

  Orbit() = default;
  /// Computes the initial states of at most most_companions companions of a body with the mass M = `mass`.
  Orbit(const Companions& companions, double gravity_constant, double mass);

  int n() const { return n_; }
  double body_mass() const { return mass_; }
  double gravity_constant() const { return G_; }
  /// The coordinates s_k at the start. `velocity` has their rates.
  const Columns& position() const { return s_; }
  const Columns& velocity() const { return sdot_; }
  /// G(M + m_1), which determines the orbit of the first companion about the body. There must be a companion.
  double gravity_of_pair() const { return G_ * (mass_ + masses_[0]); }
  double first_mass() const { return masses_[0]; }
  double mass(int i) const { return masses_[i]; }
  bool full_potential() const { return full_potential_; }
  /// The radius of a homogeneous ball with the mass of the body and the density 1, in internal units.
  double radius_of_ball() const { return std::cbrt(3 * mass_ / (4 * std::numbers::pi)); }

  /// Returns the positions r_i for the coordinates s_k. The map is linear, so the function also returns the velocities
  /// ṙ_i for the rates ṡ_k.
  Columns relative(const Columns& s) const;
  /// Returns the matrix T of the quadratic potential, for the coordinates s.
  Eigen::Matrix3d tide(const Columns& s) const;
  /// Returns the energy U, for the second moment S of the body and the coordinates s.
  double energy(const Eigen::Matrix3d& S, const Columns& s) const;
  /// Returns −Σ_{i<j} G m_i m_j/|r_i − r_j|, the energy of the companions with each other, for their positions r_i.
  double energy_of_companions(const Columns& r) const;
  /// Returns the forces −∂U/∂s_k, for the second moment S of the body and the coordinates s.
  Columns force(const Eigen::Matrix3d& S, const Columns& s) const;
  /// Returns the forces on the coordinates s_k. `r` has the positions r_i, and `of_body` the forces of the body on the
  /// companions. The function adds the forces between the companions.
  Columns force_on_coordinates(const Columns& r, const Columns& of_body) const;
  /// Moves s along Kepler orbits for the time h. RATTLE calls this function after the first half step of the velocity,
  /// in place of the drift s ← s + hṡ. Both half steps of RATTLE use the whole force. The function therefore subtracts
  /// Kepler's force in both half steps from sdot. A step of a pure Kepler orbit is then exact (Wisdom and Holman,
  /// Astron. J. 102 (1991) 1528).
  void drift(double h, Columns& s, Columns& sdot) const;
  /// Returns the largest semi-axis of the homogeneous ellipsoid with the mass of the body and the second moment S.
  double largest_semi_axis(const Eigen::Matrix3d& S) const;
  /// Returns the least of the Hill radii |r_i| (M/(3 m_i))^⅓ of the body, or infinity without companions.
  double hill_radius(const Columns& s) const;
  /// Returns the least distance between the centre of the body and a companion, or between two companions, during a
  /// step. The companions move on straight lines from the coordinates s0 to s1. Without companions the result is
  /// infinite.
  double least_distance(const Columns& s0, const Columns& s1) const;
  /// The coordinates s_k and their rates at one time.
  struct Motion {
    Columns s, sdot;
  };
  /// Integrates the orbits as those of point masses until the time `end`, and finds the closest approach. Returns the
  /// coordinates and rates at the last step that is at least the time `before` ahead of the closest approach. The
  /// result is the start if there is no such step. The result is also the start if the closest approach is at more than
  /// 0.9 times the least distance at the start. A single companion in a bound orbit repeats its motion, so the search
  /// ends after one period. The search neglects changes of the pericentre by tides. The search also ends if two
  /// companions, or a companion and the centre of the body, are nearer than the radius of the ball. In the run, a
  /// distance below the longest semi-axis of the body is a collision (app/run/orbit_of_run.h). The search also ends
  /// after 100,000 steps, which bounds its time, or if the size of a step is 0 or NaN.
  Motion near_closest_approach(double end, double before) const;
  /// Returns the angular momentum of the orbits, Σ μ_k R_k × Ṙ_k. The angular momentum of the body about its centre is
  /// not included.
  static Eigen::Vector3d momentum(const Columns& s, const Columns& sdot);
  /// Returns the torque of all companions on the body about x_c, −∫ρ y × T y dV with y = x − x_c.
  Eigen::Vector3d torque(const Eigen::Matrix3d& S, const Columns& s) const;

 private:
  double total_mass() const;
  /// Returns the period of a single companion in a bound orbit about the body. The result is empty if there is not
  /// exactly one companion, or if the orbit is not bound.
  std::optional<double> kepler_period() const;
  /// Returns the motion of point masses after a step of size h by the classical method of Runge and Kutta. The body
  /// counts as a point mass, so S is zero.
  Motion as_point_masses(const Motion& m, double h) const;
  /// Returns the force of the body on companion i at r = r_i.
  Eigen::Vector3d attraction(int i, const Eigen::Matrix3d& S, const Eigen::Vector3d& r) const;

  double G_ = 0, mass_ = 0;
  int n_ = 0;
  bool full_potential_ = false;
  double masses_[most_companions] = {}, kepler_[most_companions] = {};  ///< m_k and k_k
  double weights_[most_companions][most_companions] = {};               ///< [k][i]: r_i = Σ_k weights_[k][i] s_k
  Columns s_, sdot_;
};

}  // namespace pseudorigid::mechanics
