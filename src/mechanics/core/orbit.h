#pragma once
/// Point masses, the companions, that move under the gravity of the body and of each other. G is the gravitational
/// constant. The body has the mass M, the centre of mass x_c and the second moment S = ∫ρ(x − x_c)(x − x_c)ᵀ. Companion
/// i has the mass m_i and the position r_i relative to x_c. To second degree in the size of the body, the energy is
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
/// Models use the coordinates s_k = √μ_k R_k, which have unit mass. If the body were a point and companions did not
/// interact, each s_k would move on a conic (kepler_motion.h). Its equation would be s̈_k = −k_k s_k/|s_k|³ with k_k =
/// G M_k μ_k^{3/2}. Uniform accelerations act on the common centre of mass alone. In a model with companions, the
/// centre of mass in the state is therefore the common one.

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "mechanics/core/kepler.h"
#include "mechanics/core/kepler_motion.h"

namespace pseudorigid::mechanics {

struct Companion {
  double mass = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< r_i at the start
  std::optional<Eigen::Vector3d> velocity{};  ///< ṙ_i at the start. If empty, Ṙ_i is horizontal with the speed
                                              ///< of a circular orbit, in the direction of ẑ × R_i.
  /// The elements of the orbit of R_i at the start, for g = G M_i (kepler.h). If they are given, `position` and
  /// `velocity` are not used.
  std::optional<KeplerElements> elements{};

  bool operator==(const Companion& other) const {
    return mass == other.mass && position == other.position && velocity == other.velocity && elements == other.elements;
  }
};

/// A list of companions. The sum of two lists has the companions of both.
struct Companions : std::vector<Companion> {
  using std::vector<Companion>::vector;

  /// True if a finite-element body uses the whole potential of the companions in place of its second degree.
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
  /// A column for each companion: s_k, r_i, a rate of these, or a force.
  using Columns = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, most_companions>;

  Orbit() = default;
  /// Computes the initial states of at most most_companions companions of a body with the mass M = `mass`.
  Orbit(const Companions& companions, double gravity_constant, double mass)
      : G_(gravity_constant),
        mass_(mass),
        n_(static_cast<int>(companions.size())),
        full_potential_(companions.full_potential) {
    s_.resize(3, n_);
    sdot_.resize(3, n_);
    Columns R(3, n_), Rdot(3, n_);
    double inner = mass;                                                                          // M_{k−1}
    Eigen::Vector3d center = Eigen::Vector3d::Zero(), center_velocity = Eigen::Vector3d::Zero();  // of the mass M_{k−1}
    for (int k = 0; k < n_; ++k) {
      const Companion& companion = companions[static_cast<std::size_t>(k)];
      const double whole = inner + companion.mass, reduced = std::sqrt(companion.mass * (inner / whole));
      masses_[k] = companion.mass;
      kepler_[k] = G_ * whole * reduced * reduced * reduced;
      if (companion.elements) {
        const OrbitalMotion motion = motion_of(*companion.elements, G_ * whole);
        R.col(k) = motion.position;
        Rdot.col(k) = motion.velocity;
      } else {
        R.col(k) = companion.position - center;
        Rdot.col(k) = companion.velocity ? Eigen::Vector3d(*companion.velocity - center_velocity)
                                         : circular_velocity(R.col(k), G_ * whole);
      }
      s_.col(k) = reduced * R.col(k);
      sdot_.col(k) = reduced * Rdot.col(k);
      for (int i = 0; i < n_; ++i) weights_[k][i] = i < k ? 0 : (i == k ? 1 : companion.mass / whole) / reduced;
      center += companion.mass / whole * R.col(k);
      center_velocity += companion.mass / whole * Rdot.col(k);
      inner = whole;
    }
  }

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
  /// The radius of a ball with the mass of the body and the density 1, which is the internal unit of density.
  double radius_of_ball() const { return std::cbrt(3 * mass_ / (4 * std::numbers::pi)); }

  /// Returns the positions r_i for the coordinates s_k. The map is linear, so the function also returns the velocities
  /// ṙ_i for the rates ṡ_k.
  Columns relative(const Columns& s) const {
    Columns r = Columns::Zero(3, n_);
    for (int i = 0; i < n_; ++i)
      for (int k = 0; k <= i; ++k) r.col(i) += weights_[k][i] * s.col(k);
    return r;
  }
  /// Returns the matrix T of the potential per mass.
  Eigen::Matrix3d tide(const Columns& s) const {
    const Columns r = relative(s);
    Eigen::Matrix3d T = Eigen::Matrix3d::Zero();
    for (int i = 0; i < n_; ++i) {
      const double d = r.col(i).norm();
      const Eigen::Vector3d u = r.col(i) / d;
      T += G_ * masses_[i] / (d * d * d) * (Eigen::Matrix3d::Identity() - 3 * u * u.transpose());
    }
    return T;
  }
  /// Returns the energy U, for the second moment S of the body and the coordinates s.
  double energy(const Eigen::Matrix3d& S, const Columns& s) const {
    const Columns r = relative(s);
    double sum = 0;
    for (int i = 0; i < n_; ++i) {
      const double d = r.col(i).norm();
      const Eigen::Vector3d u = r.col(i) / d;
      sum -= G_ * masses_[i] / d * (mass_ + (3 * u.dot(S * u) - S.trace()) / (2 * d * d));
    }
    return sum + energy_of_companions(r);
  }
  /// Returns the energy of the companions with each other, for their positions r_i.
  double energy_of_companions(const Columns& r) const {
    double sum = 0;
    for (int i = 0; i < n_; ++i)
      for (int j = 0; j < i; ++j) sum -= G_ * masses_[i] * masses_[j] / (r.col(i) - r.col(j)).norm();
    return sum;
  }
  /// Returns the forces −∂U/∂s_k.
  Columns force(const Eigen::Matrix3d& S, const Columns& s) const {
    const Columns r = relative(s);
    Columns on_r = Columns::Zero(3, n_);
    for (int i = 0; i < n_; ++i) on_r.col(i) = attraction(i, S, r.col(i));
    return force_on_coordinates(r, on_r);
  }
  /// Returns the forces on s_k, for the positions r_i and the forces of the body on the companions. The function adds
  /// the forces between the companions.
  Columns force_on_coordinates(const Columns& r, const Columns& of_body) const {
    Eigen::Matrix<double, 3, most_companions> on_r = Eigen::Matrix<double, 3, most_companions>::Zero();  // −∂U/∂r_i
    for (int i = 0; i < n_; ++i) {
      on_r.col(i) += of_body.col(i);
      for (int j = 0; j < i; ++j) {
        const Eigen::Vector3d apart = r.col(i) - r.col(j);
        const double d = apart.norm();
        const Eigen::Vector3d pull = G_ * masses_[i] * masses_[j] / (d * d * d) * apart;
        on_r.col(i) -= pull;
        on_r.col(j) += pull;
      }
    }
    Columns f = Columns::Zero(3, n_);
    for (int k = 0; k < n_; ++k)
      for (int i = k; i < n_; ++i) f.col(k) += weights_[k][i] * on_r.col(i);
    return f;
  }
  /// Moves s along Kepler's orbits for the time h. A symplectic method calls this function in place of the drift s ← s
  /// + hṡ, after the half step of the velocity. The half steps of the method use the whole force. The function
  /// therefore subtracts Kepler's force of both half steps from sdot. The step is then exact for a Kepler orbit (Wisdom
  /// and Holman, Astron. J. 102 (1991) 1528).
  void drift(double h, Columns& s, Columns& sdot) const {
    for (int k = 0; k < n_; ++k) {
      const auto half_kick = [&](const Eigen::Vector3d& at) {
        const double d = at.norm();
        return Eigen::Vector3d(0.5 * h * kepler_[k] / (d * d * d) * at);
      };
      const Eigen::Vector3d start = s.col(k), velocity = sdot.col(k) + half_kick(start);
      const KeplerIncrements moved = kepler_increments(kepler_[k], start, velocity, h);
      s.col(k) += moved.s;
      sdot.col(k) += half_kick(start) + moved.sdot + half_kick(s.col(k));
    }
  }
  /// Returns the largest semi-axis of the homogeneous ellipsoid with the mass of the body and the second moment S.
  double largest_semi_axis(const Eigen::Matrix3d& S) const {
    return std::sqrt(5 * S.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff() / mass_);
  }
  /// Returns the least of the Hill radii |r_i| (M/(3 m_i))^⅓ of the body, or infinity without companions.
  double hill_radius(const Columns& s) const {
    const Columns r = relative(s);
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < n_; ++i) least = std::min(least, r.col(i).norm() * std::cbrt(mass_ / (3 * masses_[i])));
    return least;
  }
  /// Returns the least distance of a companion from the centre of the body, or of two companions from each other. The
  /// companions move on straight lines from the coordinates s0 to s1. Without companions the result is infinite.
  double least_distance(const Columns& s0, const Columns& s1) const {
    const Columns r0 = relative(s0), r1 = relative(s1);
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < n_; ++i) {
      least = std::min(least, distance_from_line(r0.col(i), r1.col(i)));
      for (int j = 0; j < i; ++j)
        least = std::min(least, distance_from_line(r0.col(i) - r0.col(j), r1.col(i) - r1.col(j)));
    }
    return least;
  }
  /// The coordinates s_k and their rates at one time.
  struct Motion {
    Columns s, sdot;
  };
  /// Integrates the orbits as those of point masses until the time `end`, and finds the closest approach. Returns the
  /// coordinates and rates at the last step that is at least the time `before` ahead of the closest approach. The
  /// result is the start if there is no such step. The result is also the start if the least distance is more than 0.9
  /// times the distance at the start. A single companion in a bound orbit repeats its motion, so the search ends after
  /// one period. Changes of the pericentre by tides are not known before the run. The search also ends if two
  /// companions, or a companion and the centre of the body, are nearer than the radius of the ball. In the run, a
  /// distance below the longest semi-axis of the body is a collision (app/run/orbit_of_run.h). The search also ends
  /// after 100,000 steps, which bounds its time, or if the size of a step is 0 or NaN.
  Motion near_closest_approach(double end, double before) const {
    if (const auto period = kepler_period()) end = std::min(end, *period);
    constexpr int most_steps = 100'000;
    constexpr double part = 0.02, nearer = 0.9;  // step divided by a time of fall or passage; ratio of distances
    std::vector<std::pair<double, Motion>> path{{0.0, {s_, sdot_}}};
    double t = 0, closest_time = 0, closest = nearer * least_distance(s_, s_);
    const double radius = radius_of_ball();
    Motion now{s_, sdot_};
    for (int n = 0; n < most_steps && t < end; ++n) {
      const double d = least_distance(now.s, now.s), speed = relative(now.sdot).colwise().norm().maxCoeff();
      double h = std::min(end - t, part / (speed / d + std::sqrt(G_ * total_mass() / (d * d * d))));
      if (!(h > 0)) break;
      now = as_point_masses(now, h);
      path.emplace_back(t += h, now);
      const double distance = least_distance(now.s, now.s);
      if (distance < closest) closest = distance, closest_time = t;
      if (distance < radius) break;
    }
    Motion found = path.front().second;
    for (const auto& [time, motion] : path)
      if (time <= closest_time - before) found = motion;
    return found;
  }
  /// Returns the angular momentum of the orbits, Σ μ_k R_k × Ṙ_k. The angular momentum of the body about its centre is
  /// not included.
  static Eigen::Vector3d momentum(const Columns& s, const Columns& sdot) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (Eigen::Index k = 0; k < s.cols(); ++k) sum += cross(s.col(k), sdot.col(k));
    return sum;
  }
  /// Returns the torque of all companions on the body about x_c, −∫ρ y × T y with y = x − x_c.
  Eigen::Vector3d torque(const Eigen::Matrix3d& S, const Columns& s) const {
    const Columns r = relative(s);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int i = 0; i < n_; ++i) {
      const double d = r.col(i).norm();
      const Eigen::Vector3d u = r.col(i) / d;
      sum -= 3 * G_ * masses_[i] / (d * d * d) * cross(u, S * u);
    }
    return sum;
  }

 private:
  static Eigen::Vector3d cross(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  /// Returns the distance between the origin and the segment from a to b.
  static double distance_from_line(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    const Eigen::Vector3d along = b - a;
    const double square = along.squaredNorm(), x = square > 0 ? std::clamp(-a.dot(along) / square, 0.0, 1.0) : 0;
    return (a + x * along).norm();
  }
  double total_mass() const {
    double sum = mass_;
    for (int i = 0; i < n_; ++i) sum += masses_[i];
    return sum;
  }
  /// Returns the period of a single companion in a bound orbit about the body. The result is empty if there is another
  /// number of companions or if the orbit is not bound.
  std::optional<double> kepler_period() const {
    if (n_ != 1) return std::nullopt;
    const double g = gravity_of_pair();
    const double by_a = 2 / relative(s_).norm() - relative(sdot_).squaredNorm() / g;
    if (!(by_a > 0)) return std::nullopt;
    return 2 * std::numbers::pi / std::sqrt(g * by_a * by_a * by_a);
  }
  /// Returns the motion of point masses after a step of size h by the classical method of Runge and Kutta. The body
  /// counts as a point mass, so S is zero.
  Motion as_point_masses(const Motion& m, double h) const {
    const auto a = [this](const Columns& s) { return force(Eigen::Matrix3d::Zero(), s); };
    const Columns k1 = a(m.s), k2 = a(m.s + h / 2 * m.sdot), k3 = a(m.s + h / 2 * m.sdot + h * h / 4 * k1),
                  k4 = a(m.s + h * m.sdot + h * h / 2 * k2);
    return {m.s + h * m.sdot + h * h / 6 * (k1 + k2 + k3), m.sdot + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)};
  }
  /// Returns the horizontal velocity of a circular orbit through R, in the direction of ẑ × R. R must not be on the z
  /// axis.
  static Eigen::Vector3d circular_velocity(const Eigen::Vector3d& R, double gravity) {
    const Eigen::Vector3d along(-R[1], R[0], 0);
    return std::sqrt(gravity / R.norm()) / along.norm() * along;
  }
  /// Returns the force of the body on companion i at r = r_i.
  Eigen::Vector3d attraction(int i, const Eigen::Matrix3d& S, const Eigen::Vector3d& r) const {
    const double d = r.norm();
    const Eigen::Vector3d u = r / d, Su = S * u;
    return -G_ * masses_[i] / (d * d) * (mass_ * u + (1.5 / (d * d)) * ((5 * u.dot(Su) - S.trace()) * u - 2 * Su));
  }

  double G_ = 0, mass_ = 0;
  int n_ = 0;
  bool full_potential_ = false;
  double masses_[most_companions] = {}, kepler_[most_companions] = {};  ///< m_k and k_k
  double weights_[most_companions][most_companions] = {};               ///< [k][i]: r_i = Σ_k weights_[k][i] s_k
  Columns s_, sdot_;
};

}  // namespace pseudorigid::mechanics
