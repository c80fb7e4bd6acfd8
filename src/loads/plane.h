#pragma once
/// Rigid planes n·x = z₀ with the unit normal n, and the law of contact with a plane. The body is on the side n·x > z₀.
/// A plane can move along n with the speed ż₀. At a point of the surface with the penetration d = z₀ − n·x > 0 and the
/// velocity v, the plane exerts the traction
///
///   p n − f k d v_t/√(|v_t|² + s²),   p = k d (1 + β ḋ),   ḋ = ż₀ − n·v,   v_t = v − (n·v) n,
///
/// per area of the reference surface, with the stiffness k. For a reference ellipsoid X = S ξ, the reference area is
/// the area of the sphere |ξ| = 1. The energy of the contact, k d²/2 per reference area, is a penalty for d > 0. In the
/// limit k → ∞ it enforces n·x ≥ z₀. The damping coefficient β of Hunt and Crossley (1975) is 0 for a pressure without
/// damping. The damping dissipates the power k β d ḋ² per area. If β > 0 and the separation is fast, ḋ < −1/β, the
/// plane attracts the body.
///
/// The second term is Coulomb's friction with the coefficient f, regularised by the slip speed s. For |v_t| ≫ s the
/// point slides, and the friction is f k d. For |v_t| ≪ s the friction is f k d v_t/s, so a point that sticks creeps
/// with a speed below s. The friction dissipates the power f k d |v_t|²/√(|v_t|² + s²) per area. The friction does not
/// depend on β.
///
/// The position of a plane at the time t is
///
///   z₀(t) = a + u t + A sin Ωt,   a = z₀(0).
///
/// The motion of the plane gives the power ∫p ż₀ dA to the body and the contact, with the pressure p that includes the
/// damping. Damping dissipates a part of this power. The remainder changes the energies of the body and of the contact.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

namespace pseudorigid::loads {

struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit normal n, pointing to the side of the body
  double position = 0;                                ///< position z₀: a, or z₀(t) in a result of `at`
  double stiffness = 0;                               ///< stiffness k, a pressure per length
  double damping = 0;                                 ///< damping coefficient β, in time/length
  double friction = 0;                                ///< coefficient of friction f
  double slip_speed = 1;                              ///< slip speed s
  double speed = 0;                                   ///< speed u along n, or ż₀(t) in a result of `at`
  double amplitude = 0, frequency = 0;                ///< amplitude A and angular frequency Ω

  /// Returns true if z₀(t) is not constant.
  bool moves() const { return speed != 0 || (amplitude != 0 && frequency != 0); }
  /// Returns the plane with the position z₀(t) and the speed ż₀(t), and without an oscillation. A plane that does not
  /// move is returned unchanged. If a plane moves, call the functions `height`, `rate` and `pressure` for the result of
  /// `at`.
  Plane at(double t) const {
    Plane now = *this;
    if (!moves()) return now;
    now.position += speed * t + amplitude * std::sin(frequency * t);
    now.speed += amplitude * frequency * std::cos(frequency * t);
    now.amplitude = 0;
    return now;
  }
  /// Returns a plane at rest with the position z₀(t).
  Plane stopped_at(double t) const {
    Plane now = at(t);
    now.speed = 0;
    return now;
  }
  /// Returns the height n·x − z₀ of a point, which is negative if the point penetrates the plane.
  double height(const Eigen::Vector3d& x) const { return normal.dot(x) - position; }
  /// Returns the rate ḋ of the penetration of a point with the velocity v.
  double rate(const Eigen::Vector3d& v) const { return speed - normal.dot(v); }
  /// Returns the pressure p at a point of the surface with the position x and the velocity v. The pressure is 0 without
  /// penetration, and negative if β > 0 and ḋ < −1/β.
  double pressure(const Eigen::Vector3d& x, const Eigen::Vector3d& v) const {
    const double d = std::max(0.0, -height(x));
    return stiffness * d * (1 + damping * rate(v));
  }
  bool operator==(const Plane& other) const = default;
};

/// A list of planes. The sum of two lists has the planes of both.
struct Planes : std::vector<Plane> {
  using std::vector<Plane>::vector;

  Planes& operator+=(const Planes& others) {
    insert(end(), others.begin(), others.end());
    return *this;
  }
  /// damped() returns true if at least one plane has damping, rough() if at least one has friction, and moving() if at
  /// least one moves.
  bool damped() const {
    return std::any_of(begin(), end(), [](const Plane& plane) { return plane.damping != 0; });
  }
  bool rough() const {
    return std::any_of(begin(), end(), [](const Plane& plane) { return plane.friction != 0; });
  }
  bool moving() const {
    return std::any_of(begin(), end(), [](const Plane& plane) { return plane.moves(); });
  }
  /// `at` returns Plane::at(t) of each plane, and `stopped_at` returns Plane::stopped_at(t).
  Planes at(double t) const {
    Planes now = *this;
    for (Plane& plane : now) plane = plane.at(t);
    return now;
  }
  Planes stopped_at(double t) const {
    Planes now = *this;
    for (Plane& plane : now) plane = plane.stopped_at(t);
    return now;
  }
  /// Returns an upper bound for the contact stiffness of a point of the surface, per reference area, in any direction
  /// and with any number of planes. The bound is 0 without planes. The stiffnesses of planes with the same normal n add
  /// up. A point cannot touch two planes that face each other, so the larger sum counts for n and −n. The bound is the
  /// smaller of the Frobenius norm of Σ k n nᵀ and its largest sum of absolute values in a row.
  double stiffness_of_all() const {
    constexpr double parallel = 1 - 1e-12;
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < size(); ++i) {
      double same = 0, facing = 0;
      bool is_first = true;
      for (std::size_t j = 0; j < size(); ++j) {
        const double cosine = (*this)[i].normal.dot((*this)[j].normal);
        if (std::abs(cosine) <= parallel) continue;
        (cosine > 0 ? same : facing) += (*this)[j].stiffness;
        is_first = is_first && j >= i;
      }
      if (is_first) sum += std::max(same, facing) * (*this)[i].normal * (*this)[i].normal.transpose();
    }
    return std::min(sum.norm(), sum.cwiseAbs().rowwise().sum().maxCoeff());
  }
};

}  // namespace pseudorigid::loads
