#pragma once
/// A family of figures of equilibrium (figures.h), for a list of values of its parameter. The result contains the
/// stability of the figures and the special points between them (special_points.h). At a fold, the drive has an
/// extremum. At an index point, the second variation of the energy at fixed momenta gains or loses a negative
/// eigenvalue in a class of motions. Another family may branch off at an index point, and beyond this point dissipation
/// may make the figure unstable. At an instability, a growth rate in a class of motions becomes or ceases to be
/// positive.
///
/// The figures of the family are called its members. Each member is found by continuation from the nearest known
/// figure. The first member is found from the ball at rest. A family of ellipsoids may bifurcate from the spheroids, as
/// Jacobi's family does. The continuation then follows the spheroids to a place near the bifurcation. There it adds the
/// displacement (ε/2)(x₁ ê₁ − x₂ ê₂), which is close to the null vector of the bifurcation. It then solves for the
/// figure with ln(a₂/a₁) = −ε and for its drive.

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mechanics/equilibria/figures.h"
#include "mechanics/equilibria/special_points.h"

namespace pseudorigid::mechanics {

/// A class of small motions about a figure. By symmetry, the motions of different classes are not coupled.
struct MotionClass {
  bool odd_in_z;  ///< true if the motions are odd under x₃ ↦ −x₃
  int m;  ///< azimuthal number on a spheroid; on an ellipsoid 0 if even under a rotation by π about x₃, else 1
};

struct ClassStability {
  MotionClass motions;
  LinearStability stability;
  /// The stability in a smaller basis of motions, from which the error of a finite basis is estimated. It has no rates
  /// if the rates are exact for the discretisation.
  LinearStability in_smaller_basis{};
};

struct FigureMember {
  double parameter = 0;
  EquilibriumFigure figure;
  std::vector<ClassStability> classes;
};

struct SpecialFigure {
  SpecialKind kind;
  MotionClass motions;  ///< class of motions of the special point; for a fold {false, 0}
  FigureMember member;
};

/// A parameter for which no member was found, and the reason.
struct NoFigure {
  double parameter;
  std::string reason;
};

struct FigureFamily {
  std::vector<FigureMember> members;
  std::vector<SpecialFigure> special;  ///< special points; those between two successive members are sorted by parameter
  std::vector<NoFigure> missing;
  /// Parameters of members with a missing index point. In a class of motions, the number of negative eigenvalues
  /// differs from that of the preceding member, but no index point is found between the two members. Or a special point
  /// is found between them, but the stability of its figure cannot be computed. Pairs with a member at rest are not
  /// compared.
  std::vector<double> without_special;
};

/// A family of spheroids or ellipsoids. `condition` returns the condition that the figure with the given parameter
/// satisfies. The value of the condition is not finite if no figure can have this parameter.
struct FamilyOfFigures {
  Figure figure;
  std::function<FigureCondition(double parameter)> condition;
  /// Sets a₃/a₁ to the approximate ratio of the semi-axes of the spheroid at which the family bifurcates. The condition
  /// must then be on a₂/a₁. If the function is empty, the family contains the ball at rest.
  std::function<Status(double& ratio_of_spheroid)> bifurcation{};
};

/// A function that sets `classes` to the stability of a figure. All figures of a family must have the same classes in
/// the same order. If `only` has a value, only the class with this index is needed. The stability of the other classes
/// is then not defined.
using StabilityOfFigure = std::function<Status(const EquilibriumFigure& figure, std::optional<std::size_t> only,
                                               std::vector<ClassStability>& classes)>;

/// Returns the family with one member, the figure at rest under the loads times `factor`. The drive of `equations` must
/// be the factor of the loads. The figure is found by continuation from the undeformed ball, while the loads rise from
/// 0. If it is not found, the member is the figure with the largest factor that was reached, and `missing` has the
/// reason. The family has no member if this largest factor is 0, or if the stability of the figure cannot be computed.
FigureFamily figure_at_rest(const FigureEquations& equations, const StabilityOfFigure& analyse, double factor);

/// A function that is called with the completed fraction of a family, and with the completed part.
using FamilyWatch = std::function<void(double fraction, const FigureFamily& known)>;

/// Finds members of one family and stores known figures as starts of the continuation.
class FigureFinder {
 public:
  /// The object refers to `equations`, which must exist as long as the object. The search for a special point ends if
  /// the relative width of its bracket is at most 2 · `resolution`. Each step of the search solves an eigenvalue
  /// problem, so a coarser resolution saves time.
  FigureFinder(const FigureEquations& equations, StabilityOfFigure analyse, FamilyOfFigures family,
               double resolution = 1e-12);

  /// Finds the members with these parameters, in this order, and the special points between successive members.
  /// Folds are located only if the parameter of the condition is a ratio of axes.
  /// Parameters for which no member is found are listed in `missing`. `give_up` is called before each member and each
  /// trial member near a special point. If `give_up` returns true, the function returns the members found so far and
  /// all special points between them. `watch` is called before each member with the completed fraction of the
  /// parameters and this part of the result. `known` is the part of an earlier call with the same parameters, which
  /// this call completes.
  FigureFamily family(const std::vector<double>& parameters, std::function<bool()> give_up = {},
                      const FamilyWatch& watch = {}, FigureFamily known = {});
  /// Finds the member with this parameter. Fails if no figure is found, if its stability cannot be computed, or if the
  /// function `give_up` of the last call of `family` returns true.
  Status member(double parameter, FigureMember& member);

 private:
  bool gives_up() const { return give_up_ && give_up_(); }
  Status first(const FigureCondition& condition, EquilibriumFigure& figure);
  Status first_of_branch(const FigureCondition& condition, EquilibriumFigure& figure);
  /// Finds the figure with this parameter from the nearest known figure, or by `first` if no figure is known. Fails if
  /// the condition has no finite value, if no figure is found, or if its drive is negative.
  Status find(double parameter, EquilibriumFigure& figure);
  /// The stability in the class with the index `of_class` of the figure with this parameter. Empty if the figure or
  /// this stability cannot be computed, or if give_up_ returns true.
  std::optional<LinearStability> stability(double parameter, std::size_t of_class);
  /// Makes this member the only known figure.
  void forget_all_but(const FigureMember& member);
  /// Appends the special points between the members with the parameters a and b to `result`.
  void locate_special(double a, double b, FigureFamily& result);

  const FigureEquations& equations_;
  StabilityOfFigure analyse_;
  FamilyOfFigures family_;
  double resolution_;
  std::function<bool()> give_up_{};
  std::map<double, EquilibriumFigure> known_;  ///< known figures; the key is the value of their condition
  std::map<double, FigureMember> members_;     ///< known members; the key is their parameter
  /// The results of `stability` for figures that are not members. The key has the parameter and the index of the class.
  std::map<std::pair<double, std::size_t>, LinearStability> trials_;
};

}  // namespace pseudorigid::mechanics
