#pragma once
/// The orbit of two point masses. Let r and v be their relative position and velocity, and g = G(M + m) with the
/// gravitational constant G and the masses M and m. An orbit has six elements. The semi-major axis a and the
/// eccentricity e are those of the conic section. The inclination i is the angle of the orbit to the plane z = 0. The
/// longitude Ω of the ascending node is counted from the x axis, and the argument ω of the pericentre from the node.
/// The mean anomaly is 0 at the pericentre. With h = r × v and r̂ = r/|r|,
///
///   1/a = 2/|r| − |v|²/g,   e = |v × h/g − r̂|,   tan i = |(h_x, h_y)|/h_z,   node along (−h_y, h_x, 0).
///
/// An ellipse has a > 0 and e < 1, the eccentric anomaly E and the true anomaly f. Its mean anomaly is E − e sin E,
/// with tan(E/2) = √((1 − e)/(1 + e)) tan(f/2). A hyperbola has a < 0 and e > 1, and the mean anomaly e sinh H − H,
/// with sinh H = r·v/(e √(g|a|)). All angles are in radians. If the angle between h and the z axis is below 10⁻¹⁰, the
/// node is on the x axis. If e is 0, the pericentre is at the node.

#include <Eigen/Core>

namespace pseudorigid::mechanics {

struct KeplerElements {
  double semi_major_axis = 0, eccentricity = 0, inclination = 0, ascending_node = 0, argument_of_pericentre = 0,
         mean_anomaly = 0;

  bool operator==(const KeplerElements& other) const = default;
};

/// The position and the velocity on an orbit.
struct OrbitalMotion {
  Eigen::Vector3d position, velocity;
};

/// Returns the solution E of Kepler's equation E − e sin E = `mean`, the mean anomaly, for 0 ≤ e < 1.
double eccentric_anomaly(double mean, double e);

/// Returns the solution H of e sinh H − H = `mean`, the mean anomaly, for e > 1.
double hyperbolic_anomaly(double mean, double e);

/// Returns the relative position and velocity for the elements `o` and g = G(M + m). A parabola has no finite a and is
/// represented by a = 0. Its results are not finite.
OrbitalMotion motion_of(const KeplerElements& o, double g);

/// Returns the elements of the orbit through r with the velocity v, for g = G(M + m). The angles are between −π and π,
/// except the mean anomaly of a hyperbola. For a parabola, the result has a = 0 and the mean anomaly 0.
KeplerElements elements_of(const Eigen::Vector3d& r, const Eigen::Vector3d& v, double g);

}  // namespace pseudorigid::mechanics
