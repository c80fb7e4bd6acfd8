#pragma once
/// Point masses, the companions, that move under the gravity of the body and of each other. The body has the mass M,
/// the centre of mass x_c and the second moment S = ∫ρ(x − x_c)(x − x_c)ᵀ. Companion i has the mass m_i and the
/// position r_i relative to x_c. To second degree in the size of the body, the energy is
///
///   U = −Σ_i G m_i [M/|r_i| + (3 r̂_iᵀS r̂_i − tr S)/(2|r_i|³)] − Σ_{i<j} G m_i m_j/|r_i − r_j|.
///
/// On the body it acts as the quadratic potential ½(x − x_c)ᵀT(x − x_c) per mass,
///
///   T = Σ_i (G m_i/|r_i|³)(Id − 3 r̂_i r̂_iᵀ).
///
/// Jacobi's coordinates R_i separate the motion of the common centre of mass. R_i is the position of companion i
/// relative to the centre of mass of the body and the companions before it. With M_i = M + m_1 + … + m_i,
///
///   r_i = R_i + Σ_{k<i} (m_k/M_k) R_k,   kinetic energy ½ Σ μ_k |Ṙ_k|²,   μ_k = m_k M_{k−1}/M_k.
///
/// The coordinates of the systems are s_k = √μ_k R_k, with unit mass. Without the size of the body and the interaction
/// of companions, each moves as s̈_k = −k_k s_k/|s_k|³ with k_k = G M_k μ_k^{3/2}, on a conic (kepler_motion.h). Uniform
/// accelerations act on the common centre of mass alone. In a model with companions, the centre of mass of the model is
/// therefore the common one, and the body is at the origin of the r_i.

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
  std::optional<Eigen::Vector3d> velocity{};           ///< ṙ_i at the start; empty: a circular orbit about the z axis
  /// The elements of R_i at the start, for the gravity G M_i. They replace the position and the velocity.
  std::optional<KeplerElements> elements{};

  bool operator==(const Companion& other) const {
    return mass == other.mass && position == other.position && velocity == other.velocity && elements == other.elements;
  }
};

/// A list of companions. The sum of two lists has the companions of both.
struct Companions : std::vector<Companion> {
  using std::vector<Companion>::vector;

  Companions& operator+=(const Companions& others) {
    insert(end(), others.begin(), others.end());
    return *this;
  }
};

class Orbit {
 public:
  static constexpr int most_companions = 2;
  /// A column for each companion: s, or r, or their rates.
  using Columns = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, most_companions>;

  Orbit() = default;
  Orbit(const Companions& companions, double gravity_constant, double mass)
      : G_(gravity_constant), mass_(mass), n_(static_cast<int>(companions.size())) {
    s_.resize(3, n_);
    sdot_.resize(3, n_);
    Columns R(3, n_), Rdot(3, n_);
    double inner = mass;                                                                          // M_{k−1}
    Eigen::Vector3d center = Eigen::Vector3d::Zero(), center_velocity = Eigen::Vector3d::Zero();  // of this mass
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
  /// The coordinates s_k and their rates at the start.
  const Columns& position() const { return s_; }
  const Columns& velocity() const { return sdot_; }
  /// G(M + m_1), of the relative motion of the first companion.
  double gravity_of_pair() const { return G_ * (mass_ + masses_[0]); }
  double first_mass() const { return masses_[0]; }
  /// The radius of a ball with the mass of the body and the density 1, the unit of density inside the program.
  double radius_of_ball() const { return std::cbrt(3 * mass_ / (4 * std::numbers::pi)); }

  /// The positions r_i for the coordinates s_k, or the velocities for their rates.
  Columns relative(const Columns& s) const {
    Columns r = Columns::Zero(3, n_);
    for (int i = 0; i < n_; ++i)
      for (int k = 0; k <= i; ++k) r.col(i) += weights_[k][i] * s.col(k);
    return r;
  }
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
  /// U, for the second moment S.
  double energy(const Eigen::Matrix3d& S, const Columns& s) const {
    const Columns r = relative(s);
    double sum = 0;
    for (int i = 0; i < n_; ++i) {
      const double d = r.col(i).norm();
      const Eigen::Vector3d u = r.col(i) / d;
      sum -= G_ * masses_[i] / d * (mass_ + (3 * u.dot(S * u) - S.trace()) / (2 * d * d));
      for (int j = 0; j < i; ++j) sum -= G_ * masses_[i] * masses_[j] / (r.col(i) - r.col(j)).norm();
    }
    return sum;
  }
  /// −∂U/∂s_k
  Columns force(const Eigen::Matrix3d& S, const Columns& s) const {
    const Columns r = relative(s);
    Columns on_r = Columns::Zero(3, n_);  // −∂U/∂r_i
    for (int i = 0; i < n_; ++i) {
      on_r.col(i) += attraction(i, S, r.col(i));
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
  /// The motion of the companions from s to the time h later, for the velocity sdot after the half step of a symplectic
  /// method. The method leaves out the drift of s. The drift of Kepler's motion replaces it, and takes back the two
  /// half steps by Kepler's force. The step is then exact for a Kepler orbit (Wisdom and Holman, Astron. J. 102 (1991)
  /// 1528).
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
  /// The largest semi-axis of the ellipsoid with the second moment S.
  double largest_semi_axis(const Eigen::Matrix3d& S) const {
    return std::sqrt(5 * S.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff() / mass_);
  }
  /// The least of the Hill radii |r_i| (M/(3 m_i))^⅓.
  double hill_radius(const Columns& s) const {
    const Columns r = relative(s);
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < n_; ++i) least = std::min(least, r.col(i).norm() * std::cbrt(mass_ / (3 * masses_[i])));
    return least;
  }
  /// The least distance of a companion from the centre of the body, or of two companions from each other. All move on
  /// straight lines from the coordinates s0 to s1.
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
  /// A motion of the companions as of point masses.
  struct Motion {
    Columns s, sdot;
  };
  /// The motion of point masses at the time `before` before their closest approach, or at the start if this is later.
  /// The closest approach is searched until the time `end`. It must be nearer than the start by a tenth. Otherwise the
  /// result is the motion at the start. A single companion in a bound orbit repeats its motion, so the search ends
  /// after one period. Changes of the pericentre by tides are not known before the run in any case. The search also
  /// ends if a companion is within the radius of the ball, because the run then ends with a collision.
  Motion near_closest_approach(double end, double before) const {
    if (const auto period = kepler_period()) end = std::min(end, *period);
    constexpr int most_steps = 100'000;
    constexpr double part = 0.02, nearer = 0.9;  // of the time in which a companion falls or passes
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
  /// The angular momentum Σ μ_k R_k × Ṙ_k.
  static Eigen::Vector3d momentum(const Columns& s, const Columns& sdot) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (Eigen::Index k = 0; k < s.cols(); ++k) sum += cross(s.col(k), sdot.col(k));
    return sum;
  }
  /// The torque of all companions on the body about its centre, −∫ρ x × T x with x relative to x_c.
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
  /// The period of a single companion in a bound orbit about the body; empty if the orbit is not of this kind.
  std::optional<double> kepler_period() const {
    if (n_ != 1) return std::nullopt;
    const double g = gravity_of_pair();
    const double by_a = 2 / relative(s_).norm() - relative(sdot_).squaredNorm() / g;
    if (!(by_a > 0)) return std::nullopt;
    return 2 * std::numbers::pi / std::sqrt(g * by_a * by_a * by_a);
  }
  /// A step of the classical method of Runge and Kutta.
  Motion as_point_masses(const Motion& m, double h) const {
    const auto a = [this](const Columns& s) { return force(Eigen::Matrix3d::Zero(), s); };
    const Columns k1 = a(m.s), k2 = a(m.s + h / 2 * m.sdot), k3 = a(m.s + h / 2 * m.sdot + h * h / 4 * k1),
                  k4 = a(m.s + h * m.sdot + h * h / 2 * k2);
    return {m.s + h * m.sdot + h * h / 6 * (k1 + k2 + k3), m.sdot + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)};
  }
  static Eigen::Vector3d circular_velocity(const Eigen::Vector3d& R, double gravity) {
    const Eigen::Vector3d along(-R[1], R[0], 0);
    return std::sqrt(gravity / R.norm()) / along.norm() * along;
  }
  /// The attraction of companion i by the body.
  Eigen::Vector3d attraction(int i, const Eigen::Matrix3d& S, const Eigen::Vector3d& r) const {
    const double d = r.norm();
    const Eigen::Vector3d u = r / d, Su = S * u;
    return -G_ * masses_[i] / (d * d) * (mass_ * u + (1.5 / (d * d)) * ((5 * u.dot(Su) - S.trace()) * u - 2 * Su));
  }

  double G_ = 0, mass_ = 0;
  int n_ = 0;
  double masses_[most_companions] = {}, kepler_[most_companions] = {};  ///< m_k and k_k
  double weights_[most_companions][most_companions] = {};               ///< [k][i]: r_i = Σ_k weights_[k][i] s_k
  Columns s_, sdot_;
};

}  // namespace pseudorigid::mechanics
