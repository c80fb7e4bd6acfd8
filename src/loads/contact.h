#pragma once
/// Contact of a surface with rigid planes (plane.h), as sums over the quadrature points of the reference surface. A
/// plane n·x = z₀ has the unit normal n toward the body, the position z₀, the speed ż₀ along n and the stiffness k. A
/// point has the position x, the quadrature weight w, the penetration d = z₀ − n·x and the pressure p = k d. The sums
/// over the points with d > 0 are
///
///   energy V = Σ w k d²/2,   force along n  N = Σ w p,   area Σ w,   moments Σ w p x and Σ w p |x − (n·x) n|².
///
/// Let s be the distance of a point from the line along n through the centre of pressure. The mean of s², weighted with
/// the pressure, is ⟨s²⟩. The pressure radius is √(5⟨s²⟩/2). For the pressure of Hertz, p₀√(1 − s²/a²), ⟨s²⟩ is 2a²/5,
/// and the pressure radius is the radius a of the contact. Points near the edge have a small pressure, so the pressure
/// radius is more accurate than the radius √(area/π) of a disk with the contact area.
///
/// A plane with the speed ż₀ gives the power N ż₀ to the body and to the energy of the contact. In this power, N
/// includes the damping force, which dissipates a part of the power.
///
/// A model may compute these sums only for a sector of the body between symmetry planes. The set of planes then has the
/// same symmetry, so reflections give the sums for the whole body.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "loads/plane.h"

namespace pseudorigid::loads {

/// Contact of a surface with one plane, without the damping force. The members are the sums in the opening comment of
/// this file for this plane, and the least height of the points. The default values are those for no points.
struct PlaneContact {
  double energy = 0, force = 0, area = 0;  ///< energy V, force N, and reference area of the contact
  double spread = 0;  ///< second moment of the pressure about the axis n, ∫p |x − (n·x) n|² dA
  double height = std::numeric_limits<double>::infinity();  ///< least n·x − z₀ of all points; infinite without points
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();         ///< integral of the pressure times the position, ∫p x dA

  /// Adds a point with the position x and the quadrature weight w = `weight`. A point with d ≤ 0 changes only `height`.
  /// A plane that moves must be a result of Plane::at.
  void add(const Plane& plane, const Eigen::Vector3d& x, double weight) {
    const double above = plane.height(x);
    height = std::min(height, above);
    if (above >= 0) return;
    const double pressure = -weight * plane.stiffness * above;
    energy -= 0.5 * pressure * above;
    force += pressure;
    area += weight;
    moment += pressure * x;
    spread += pressure * (x - plane.normal.dot(x) * plane.normal).squaredNorm();
  }
  /// Adds the mirror image of another contact, for example of a sector of the body. `signs` has −1 for each reflected
  /// coordinate, otherwise 1. By default no coordinate is reflected.
  void add(const PlaneContact& other, const Eigen::Vector3d& signs = Eigen::Vector3d::Ones()) {
    energy += other.energy;
    force += other.force;
    area += other.area;
    spread += other.spread;
    height = std::min(height, other.height);
    moment += signs.cwiseProduct(other.moment);
  }
};

/// Powers of some of the contact forces at one time, as sums over planes. `taken` is the power that these forces
/// dissipate. `given` is the power N ż₀ that moving planes transmit by these forces. N is their component along n.
struct ContactPower {
  double taken = 0, given = 0;

  ContactPower& operator+=(const ContactPower& other) {
    taken += other.taken;
    given += other.given;
    return *this;
  }
};

/// The values of the output columns for contact. `energy` is the sum over all planes, and `height` is the least height.
/// The other members are for the plane with the largest force N. Without contact, `normal` and `speed` are those of the
/// nearest plane, and `force`, `point` and both radii are 0.
struct Contact {
  double energy = 0, force = 0;
  double height = std::numeric_limits<double>::infinity();  ///< least height over all planes
  double radius = 0;                                        ///< radius √(area/π) of a disk with the contact area
  double pressure_radius = 0;                               ///< pressure radius √(5⟨s²⟩/2)
  Eigen::Vector3d point = Eigen::Vector3d::Zero();          ///< centre of pressure; 0 without contact
  /// Unit normal of the plane with the largest force, or of the nearest plane without contact.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double speed = 0;  ///< speed ż₀ of the plane with this normal, 0 without planes

  /// Returns the largest penetration, or 0 without contact.
  double penetration() const { return std::max(0.0, -height); }
};

/// Returns the mirror image of a plane. Its normal has the components signs_i n_i, and its other members are those of
/// `plane`.
inline Plane mirrored_plane(Plane plane, const Eigen::Vector3d& signs) {
  plane.normal = signs.cwiseProduct(plane.normal);
  return plane;
}

/// Returns the contact of the whole body with each plane, from the contact `computed` of a sector with each plane.
/// `reflect[i]` is true if the body is symmetric under the reflection of x_i. The sector is then on one side of the
/// plane x_i = 0. The set of planes must contain the mirror images of all planes.
inline std::vector<PlaneContact> of_whole_body(const Planes& planes, const std::vector<PlaneContact>& computed,
                                               const std::array<bool, 3>& reflect) {
  std::vector<PlaneContact> whole(planes.size());
  for (int image = 0; image < 8; ++image) {
    Eigen::Vector3d signs;
    bool belongs = true;
    for (int i = 0; i < 3; ++i) {
      const bool mirrored = (image >> i & 1) != 0;
      belongs = belongs && (!mirrored || reflect[i]);
      signs[i] = mirrored ? -1 : 1;
    }
    if (!belongs) continue;
    // The image of the sector touches plane j in the same way as the sector touches the image k of plane j.
    for (std::size_t j = 0; j < planes.size(); ++j)
      for (std::size_t k = 0; k < planes.size(); ++k)
        if (planes[k] == mirrored_plane(planes[j], signs)) {
          whole[j].add(computed[k], signs);
          break;
        }
  }
  return whole;
}

/// Returns the values of the output columns. `contacts` has the contact of the whole body with each plane. Without
/// planes, `normal` is 0 and `height` is infinite.
inline Contact summary(const Planes& planes, const std::vector<PlaneContact>& contacts) {
  Contact result;
  const PlaneContact* pressing = nullptr;
  for (std::size_t j = 0; j < planes.size(); ++j) {
    const PlaneContact& one = contacts[j];
    result.energy += one.energy;
    const bool is_first = pressing == nullptr;
    const bool presses_more = !is_first && one.force > pressing->force;
    const bool is_nearer = !is_first && one.force == pressing->force && one.height < pressing->height;
    if (is_first || presses_more || is_nearer) {
      pressing = &one;
      result.normal = planes[j].normal;
      result.speed = planes[j].speed;
    }
    result.height = std::min(result.height, one.height);
  }
  if (pressing == nullptr || pressing->force <= 0) return result;
  result.force = pressing->force;
  result.radius = std::sqrt(pressing->area / std::numbers::pi);
  result.point = pressing->moment / pressing->force;
  const double off_axis = (result.point - result.normal.dot(result.point) * result.normal).squaredNorm();
  result.pressure_radius = std::sqrt(2.5 * std::max(0.0, pressing->spread / pressing->force - off_axis));
  return result;
}

}  // namespace pseudorigid::loads
