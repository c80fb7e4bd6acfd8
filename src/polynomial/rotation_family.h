#pragma once
/// A family of steady rotations (steady_rotation.h) over a range of its parameter. The family includes the stability of
/// its members (rotation_spectrum.h) and the special points (mechanics/equilibria/special_points.h). At a fold, the
/// spin has an extremum. At an index point, the energy at fixed momenta gains or loses a negative direction in a class
/// of motions. A branch may start at an index point, and beyond this point dissipation may make the figure unstable. At
/// an instability, a growth rate in a class of motions appears or disappears.
///
/// Each member is found by continuation from the nearest known member. The first spheroid is found from the ball at
/// rest, and the first ellipsoid from a figure that the caller provides.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "mechanics/equilibria/special_points.h"
#include "polynomial/rotation_spectrum.h"

namespace pseudorigid::polynomial {

struct RotationMember {
  double parameter = 0;
  SteadyRotation rotation;
  std::vector<ClassStability> classes;
};

struct SpecialRotation {
  mechanics::SpecialKind kind;
  MotionClass motions;  ///< class of the special point; for a fold, the class of the family
  RotationMember member;
};

/// A parameter without a member, and the reason.
struct NoRotation {
  double parameter;
  std::string reason;
};

struct RotationFamily {
  std::vector<RotationMember> members;
  std::vector<SpecialRotation> special;  ///< special points, sorted by parameter between two members
  std::vector<NoRotation> missing;
};

/// An affine figure near the required figure, with its semi-axes and the square of its spin.
struct NearbyFigure {
  Eigen::Vector3d a;
  double spin_squared;
};

/// `condition` returns the condition that determines the figure with a parameter of the family.
struct FamilyOfRotations {
  Figure figure;
  std::function<FigureCondition(double parameter)> condition;
  /// Sets `nearby` to a figure near the figure with this parameter. Families of ellipsoids require the function.
  std::function<mechanics::Status(double parameter, NearbyFigure& nearby)> nearby{};
};

class RotationFinder {
 public:
  RotationFinder(const BodySetup& setup, bool incompressible, FamilyOfRotations family);

  /// Finds the members with these parameters, in this order, and the special points between successive members.
  /// Parameters for which no member is found are listed in `missing`. `give_up` is called before each member and each
  /// trial member near a special point. If `give_up` returns true, the family ends.
  RotationFamily family(const std::vector<double>& parameters, std::function<bool()> give_up = {});
  /// Finds the member with this parameter. Fails if there is none, if its stability cannot be computed, or if the
  /// `give_up` of the last call of `family` returns true.
  mechanics::Status member(double parameter, RotationMember& member);

  const RotationSpectrum& spectrum() const { return spectrum_; }

 private:
  bool gives_up() const { return give_up_ && give_up_(); }
  mechanics::Status first(double parameter, SteadyRotation& rotation) const;
  /// Finds the figure with this parameter from the nearest known figure, or by `first` if no figure is known. Fails if
  /// the condition has no finite value, if no figure is found, or if its Ω² is negative.
  mechanics::Status find(double parameter, SteadyRotation& rotation);
  void locate_special(double a, double b, std::vector<SpecialRotation>& special);

  FamilyOfRotations family_;
  SteadyRotations rotations_;
  RotationSpectrum spectrum_;
  std::function<bool()> give_up_{};
  std::map<double, SteadyRotation> known_;    ///< known figures, by the value of their condition
  std::map<double, RotationMember> members_;  ///< known members, by their parameter
};

}  // namespace pseudorigid::polynomial
