#include "mechanics/core/orbit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "mechanics/core/kepler_motion.h"

namespace pseudorigid::mechanics {
namespace {

Eigen::Vector3d cross(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Returns the distance of the origin from the line segment between a and b.
double distance_from_line(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double square = along.squaredNorm(), x = square > 0 ? std::clamp(-a.dot(along) / square, 0.0, 1.0) : 0;
  return (a + x * along).norm();
}

/// Returns the horizontal velocity at R, in the direction of ẑ × R, with the speed of a circular orbit of radius |R|.
/// `gravity` is the gravitational constant times the sum of the two masses. R must not be on the z axis.
Eigen::Vector3d circular_velocity(const Eigen::Vector3d& R, double gravity) {
  const Eigen::Vector3d along(-R[1], R[0], 0);
  return std::sqrt(gravity / R.norm()) / along.norm() * along;
}

}  // namespace

Orbit::Orbit(const Companions& companions, double gravity_constant, double mass)
    : G_(gravity_constant),
      mass_(mass),
      n_(static_cast<int>(companions.size())),
      full_potential_(companions.full_potential) {
  s_.resize(3, n_);
  sdot_.resize(3, n_);
  Columns R(3, n_), Rdot(3, n_);
  double inner = mass;  // mass of the body and the companions before companion k
  // Position and velocity of the centre of mass of the body and the companions before k, relative to the centre of the
  // body.
  Eigen::Vector3d center = Eigen::Vector3d::Zero(), center_velocity = Eigen::Vector3d::Zero();
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

Orbit::Columns Orbit::relative(const Columns& s) const {
  Columns r = Columns::Zero(3, n_);
  for (int i = 0; i < n_; ++i)
    for (int k = 0; k <= i; ++k) r.col(i) += weights_[k][i] * s.col(k);
  return r;
}

Eigen::Matrix3d Orbit::tide(const Columns& s) const {
  const Columns r = relative(s);
  Eigen::Matrix3d T = Eigen::Matrix3d::Zero();
  for (int i = 0; i < n_; ++i) {
    const double d = r.col(i).norm();
    const Eigen::Vector3d u = r.col(i) / d;
    T += G_ * masses_[i] / (d * d * d) * (Eigen::Matrix3d::Identity() - 3 * u * u.transpose());
  }
  return T;
}

double Orbit::energy(const Eigen::Matrix3d& S, const Columns& s) const {
  const Columns r = relative(s);
  double sum = 0;
  for (int i = 0; i < n_; ++i) {
    const double d = r.col(i).norm();
    const Eigen::Vector3d u = r.col(i) / d;
    sum -= G_ * masses_[i] / d * (mass_ + (3 * u.dot(S * u) - S.trace()) / (2 * d * d));
  }
  return sum + energy_of_companions(r);
}

double Orbit::energy_of_companions(const Columns& r) const {
  double sum = 0;
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < i; ++j) sum -= G_ * masses_[i] * masses_[j] / (r.col(i) - r.col(j)).norm();
  return sum;
}

Orbit::Columns Orbit::force(const Eigen::Matrix3d& S, const Columns& s) const {
  const Columns r = relative(s);
  Columns on_r = Columns::Zero(3, n_);
  for (int i = 0; i < n_; ++i) on_r.col(i) = attraction(i, S, r.col(i));
  return force_on_coordinates(r, on_r);
}

Orbit::Columns Orbit::force_on_coordinates(const Columns& r, const Columns& of_body) const {
  // Column i is the force −∂U/∂r_i on companion i, with the energy U of orbit.h.
  Eigen::Matrix<double, 3, most_companions> on_r = Eigen::Matrix<double, 3, most_companions>::Zero();
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

void Orbit::drift(double h, Columns& s, Columns& sdot) const {
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

double Orbit::largest_semi_axis(const Eigen::Matrix3d& S) const {
  return std::sqrt(5 * S.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff() / mass_);
}

double Orbit::hill_radius(const Columns& s) const {
  const Columns r = relative(s);
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < n_; ++i) least = std::min(least, r.col(i).norm() * std::cbrt(mass_ / (3 * masses_[i])));
  return least;
}

double Orbit::least_distance(const Columns& s0, const Columns& s1) const {
  const Columns r0 = relative(s0), r1 = relative(s1);
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < n_; ++i) {
    least = std::min(least, distance_from_line(r0.col(i), r1.col(i)));
    for (int j = 0; j < i; ++j)
      least = std::min(least, distance_from_line(r0.col(i) - r0.col(j), r1.col(i) - r1.col(j)));
  }
  return least;
}

Orbit::Motion Orbit::near_closest_approach(double end, double before) const {
  if (const auto period = kepler_period()) end = std::min(end, *period);
  constexpr int most_steps = 100'000;
  // `part` is the size of a step divided by the time in which the least distance d changes by itself: 1/(v/d +
  // √(GM/d³)), with the largest speed v and the total mass M. An approach counts only if its distance is less than
  // `nearer` times the distance at the start.
  constexpr double part = 0.02, nearer = 0.9;
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

Eigen::Vector3d Orbit::momentum(const Columns& s, const Columns& sdot) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Eigen::Index k = 0; k < s.cols(); ++k) sum += cross(s.col(k), sdot.col(k));
  return sum;
}

Eigen::Vector3d Orbit::torque(const Eigen::Matrix3d& S, const Columns& s) const {
  const Columns r = relative(s);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < n_; ++i) {
    const double d = r.col(i).norm();
    const Eigen::Vector3d u = r.col(i) / d;
    sum -= 3 * G_ * masses_[i] / (d * d * d) * cross(u, S * u);
  }
  return sum;
}

double Orbit::total_mass() const {
  double sum = mass_;
  for (int i = 0; i < n_; ++i) sum += masses_[i];
  return sum;
}

std::optional<double> Orbit::kepler_period() const {
  if (n_ != 1) return std::nullopt;
  const double g = gravity_of_pair();
  const double by_a = 2 / relative(s_).norm() - relative(sdot_).squaredNorm() / g;
  if (!(by_a > 0)) return std::nullopt;
  return 2 * std::numbers::pi / std::sqrt(g * by_a * by_a * by_a);
}

Orbit::Motion Orbit::as_point_masses(const Motion& m, double h) const {
  const auto a = [this](const Columns& s) { return force(Eigen::Matrix3d::Zero(), s); };
  const Columns k1 = a(m.s), k2 = a(m.s + h / 2 * m.sdot), k3 = a(m.s + h / 2 * m.sdot + h * h / 4 * k1),
                k4 = a(m.s + h * m.sdot + h * h / 2 * k2);
  return {m.s + h * m.sdot + h * h / 6 * (k1 + k2 + k3), m.sdot + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)};
}

Eigen::Vector3d Orbit::attraction(int i, const Eigen::Matrix3d& S, const Eigen::Vector3d& r) const {
  const double d = r.norm();
  const Eigen::Vector3d u = r / d, Su = S * u;
  return -G_ * masses_[i] / (d * d) * (mass_ * u + (1.5 / (d * d)) * ((5 * u.dot(Su) - S.trace()) * u - 2 * Su));
}

}  // namespace pseudorigid::mechanics
