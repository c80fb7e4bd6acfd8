#pragma once
/// A family of figures of equilibrium (figures.h) over a range of its parameter. The family includes the stability of
/// its members and the special points (special_points.h). At a fold, the drive has an extremum. At an index point, the
/// energy at fixed momenta gains or loses a negative direction in a class of motions. A branch may start at an index
/// point, and beyond this point dissipation may make the figure unstable. At an instability, a growth rate in a class
/// of motions appears or disappears.
///
/// Each member is found by continuation from the nearest known member. The first member is found from the ball at
/// rest, or from a figure that the caller provides.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "mechanics/equilibria/figures.h"
#include "mechanics/equilibria/special_points.h"

namespace pseudorigid::mechanics {

/// A class of small motions, which are not coupled to the motions of other classes.
struct MotionClass {
  bool odd_in_z;  ///< true if the motions are odd under x₃ ↦ −x₃
  int m;          ///< azimuthal number on a spheroid; on an ellipsoid 0 if even under the half turn about x₃, else 1
};

struct ClassStability {
  MotionClass motions;
  LinearStability stability;
};

struct FigureMember {
  double parameter = 0;
  EquilibriumFigure figure;
  std::vector<ClassStability> classes;
};

struct SpecialFigure {
  SpecialKind kind;
  MotionClass motions;  ///< class of the special point; for a fold, the class of the motions along the family
  FigureMember member;
};

/// A parameter without a member, and the reason.
struct NoFigure {
  double parameter;
  std::string reason;
};

struct FigureFamily {
  std::vector<FigureMember> members;
  std::vector<SpecialFigure> special;  ///< special points, sorted by parameter between two members
  std::vector<NoFigure> missing;
  /// Parameters of the members that differ from the preceding member in the number of negative directions, although the
  /// search between the two finds no index point. Pairs with a member at rest are not compared.
  std::vector<double> without_special;
};

/// An affine figure near the required figure, with its semi-axes and its drive.
struct NearbyFigure {
  Eigen::Vector3d a;
  double drive;
};

/// A family of spheroids or ellipsoids. `condition` returns the condition that determines the figure with the given
/// parameter.
struct FamilyOfFigures {
  Figure figure;
  std::function<FigureCondition(double parameter)> condition;
  /// Sets `nearby` to a figure near the figure with this parameter, from which the first figure is found. If the
  /// function is empty, the first figure is found by continuation from the ball at rest.
  std::function<Status(double parameter, NearbyFigure& nearby)> nearby{};
};

/// Sets `classes` to the stability of a figure, for the same classes in the same order for every figure of a family.
using StabilityOfFigure = std::function<Status(const EquilibriumFigure& figure, std::vector<ClassStability>& classes)>;

class FigureFinder {
 public:
  /// The object refers to `equations`, which must exist as long as the object. `resolution` is half of the relative
  /// width of the bracket at which the search for a special point ends. Each step of the search solves an eigenvalue
  /// problem, so a coarser resolution saves time.
  FigureFinder(const FigureEquations& equations, StabilityOfFigure analyse, FamilyOfFigures family,
               double resolution = 1e-12);

  /// Finds the members with these parameters, in this order, and the special points between successive members.
  /// Parameters for which no member is found are listed in `missing`. `give_up` is called before each member and each
  /// trial member near a special point. If `give_up` returns true, the family ends.
  FigureFamily family(const std::vector<double>& parameters, std::function<bool()> give_up = {});
  /// Finds the member with this parameter. Fails if there is none, if its stability cannot be computed, or if the
  /// `give_up` of the last call of `family` returns true.
  Status member(double parameter, FigureMember& member);

 private:
  bool gives_up() const { return give_up_ && give_up_(); }
  Status first(double parameter, EquilibriumFigure& figure) const;
  /// Finds the figure with this parameter from the nearest known figure, or by `first` if no figure is known. Fails if
  /// the condition has no finite value, if no figure is found, or if its drive is negative.
  Status find(double parameter, EquilibriumFigure& figure);
  /// Appends the special points between the members with the parameters a and b to `result`.
  void locate_special(double a, double b, FigureFamily& result);

  const FigureEquations& equations_;
  StabilityOfFigure analyse_;
  FamilyOfFigures family_;
  double resolution_;
  std::function<bool()> give_up_{};
  std::map<double, EquilibriumFigure> known_;  ///< known figures; the key is the value of their condition
  std::map<double, FigureMember> members_;     ///< known members; the key is their parameter
};

}  // namespace pseudorigid::mechanics
