#include "mechanics/equilibria/figure_family.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "mechanics/core/bracketed_root.h"

namespace pseudorigid::mechanics {

FigureFamily figure_at_rest(const FigureEquations& equations, const StabilityOfFigure& analyse, double factor) {
  FigureFamily found;
  FigureMember member;
  member.figure = equations.affine(Eigen::Vector3d::Ones(), 0);
  Status status = equations.solve({FigureParameter::drive, 0}, member.figure);
  if (status) status = equations.follow(0, {FigureParameter::drive, factor}, member.figure);
  if (!status) found.missing.push_back({factor, status.reason()});
  member.parameter = status ? factor : member.figure.drive;
  if (member.parameter == 0) return found;
  status = analyse(member.figure, {}, member.classes);
  if (status)
    found.members.push_back(std::move(member));
  else
    found.missing.push_back({member.parameter, status.reason()});
  return found;
}

FigureFinder::FigureFinder(const FigureEquations& equations, StabilityOfFigure analyse, FamilyOfFigures family,
                           double resolution)
    : equations_(equations), analyse_(std::move(analyse)), family_(std::move(family)), resolution_(resolution) {}

/// Finds the first figure of the family, which satisfies the condition. Fails if family_.bifurcation fails, or if no
/// figure is found.
Status FigureFinder::first(const FigureCondition& condition, EquilibriumFigure& figure) {
  figure = equations_.affine(Eigen::Vector3d::Ones(), 0);
  if (family_.bifurcation) return first_of_branch(condition, figure);
  if (auto status = equations_.solve({condition.parameter, 0}, figure); !status) return status;
  return equations_.follow(0, condition, figure);
}

/// Replaces `figure`, the undeformed ball, by the figure with the condition in a family that bifurcates from the
/// spheroids. The figure next to the bifurcation becomes known, so that it is not sought again if the condition has no
/// figure.
Status FigureFinder::first_of_branch(const FigureCondition& condition, EquilibriumFigure& figure) {
  constexpr double epsilon = 0.05;
  double ratio = 1;
  if (auto status = family_.bifurcation(ratio); !status) return status;
  const FigureCondition round{FigureParameter::log_ratio_31, 0};
  if (auto status = equations_.solve(round, figure); !status) return status;
  const FigureCondition at_bifurcation{FigureParameter::log_ratio_31, std::log(ratio)};
  if (auto status = equations_.follow(0, at_bifurcation, figure); !status) return status;
  const double a = std::pow(ratio, -1.0 / 3);  // a₁ = a₂ if the volume is that of the ball
  figure.x += equations_.affine({a * epsilon / 2, -a * epsilon / 2, 0}, 0).x;
  const FigureCondition start{condition.parameter, -epsilon};
  if (auto status = equations_.solve(start, figure); !status) return status;
  known_[start.value] = figure;
  return equations_.follow(-epsilon, condition, figure);
}

Status FigureFinder::find(double parameter, EquilibriumFigure& figure) {
  const FigureCondition condition = family_.condition(parameter);
  if (!std::isfinite(condition.value)) return Status::failure("there is no figure with this parameter");
  Status status;
  if (known_.empty()) {
    status = first(condition, figure);
  } else {
    const auto nearest = std::ranges::min_element(
        known_, {}, [&](const auto& known) { return std::abs(known.first - condition.value); });
    figure = nearest->second;
    status = equations_.follow(nearest->first, condition, figure);
  }
  if (!status) return status;
  constexpr double round_off = 1e-12;
  if (figure.drive < -equations_.error_of_drive())
    return Status::failure("this figure does not turn steadily about its axis: Omega^2 = " + six_digits(figure.drive));
  if (figure.drive < round_off) figure.drive = 0;
  known_[condition.value] = figure;
  return {};
}

Status FigureFinder::member(double parameter, FigureMember& member) {
  if (const auto found = members_.find(parameter); found != members_.end()) {
    member = found->second;
    return {};
  }
  member = {parameter, {}, {}};
  if (gives_up()) return Status::failure("interrupted");
  if (auto status = find(parameter, member.figure); !status) return status;
  if (auto status = analyse_(member.figure, {}, member.classes); !status) return status;
  members_[parameter] = member;
  return {};
}

std::optional<LinearStability> FigureFinder::stability(double parameter, std::size_t of_class) {
  if (const auto found = members_.find(parameter); found != members_.end())
    return found->second.classes[of_class].stability;
  if (const auto found = trials_.find({parameter, of_class}); found != trials_.end()) return found->second;
  EquilibriumFigure figure;
  std::vector<ClassStability> classes;
  if (gives_up() || !find(parameter, figure) || !analyse_(figure, of_class, classes)) return {};
  return trials_[{parameter, of_class}] = classes[of_class].stability;
}

/// Appends the special points between the members with the parameters a and b to `result`. Also appends b to
/// `without_special` if the number of negative directions changes in a class without an index point and both members
/// rotate.
void FigureFinder::locate_special(double a, double b, FigureFamily& result) {
  struct Found {
    SpecialPoint point;
    MotionClass motions;
  };
  std::vector<Found> found;
  const std::vector<ClassStability> classes = members_.at(a).classes;
  bool is_complete = true;
  for (std::size_t k = 0; k < classes.size(); ++k) {
    std::vector<SpecialPoint> of_class;
    locate_changes_of_stability([&](double p) { return stability(p, k); }, a, b, of_class, resolution_);
    for (const auto& point : of_class) found.push_back({point, classes[k].motions});
    const bool changes = classes[k].stability.n_negative != members_.at(b).classes[k].stability.n_negative;
    const bool is_found = std::ranges::any_of(of_class, [](const auto& p) { return p.kind == SpecialKind::index; });
    is_complete = is_complete && (!changes || is_found);
  }
  if (family_.condition(a).parameter != FigureParameter::drive) {
    const auto slope = [&](double p) {
      EquilibriumFigure at;
      return find(p, at) ? equations_.slope(family_.condition(p), at) : std::numeric_limits<double>::quiet_NaN();
    };
    // A jump of the slope through 0 is not a fold.
    constexpr double absent = 1e-4;
    if (const auto p = bracketed_root(slope, a, b, resolution_);
        p && std::abs(slope(*p)) < absent * std::max(std::abs(slope(a)), std::abs(slope(b))))
      found.push_back({{SpecialKind::fold, *p}, {false, 0}});
  }
  std::ranges::stable_sort(found, {}, [](const Found& f) { return f.point.s; });
  for (const Found& f : found) {
    FigureMember at;
    if (member(f.point.s, at))
      result.special.push_back({f.point.kind, f.motions, std::move(at)});
    else
      is_complete = false;
  }
  const bool rotates = members_.at(a).figure.drive > 0 && members_.at(b).figure.drive > 0;
  if (!is_complete && rotates && !gives_up()) result.without_special.push_back(b);
}

void FigureFinder::forget_all_but(const FigureMember& member) {
  known_ = {{family_.condition(member.parameter).value, member.figure}};
  members_ = {{member.parameter, member}};
  trials_.clear();
}

FigureFamily FigureFinder::family(const std::vector<double>& parameters, std::function<bool()> give_up,
                                  const FamilyWatch& watch, FigureFamily known) {
  give_up_ = std::move(give_up);
  FigureFamily result = std::move(known);
  const std::size_t n_known = result.members.size() + result.missing.size();
  if (!result.members.empty()) forget_all_but(result.members.back());
  // True if the preceding parameter has a member.
  bool previous = !result.members.empty() && result.members.back().parameter == parameters[n_known - 1];
  for (std::size_t i = n_known; i < parameters.size(); ++i) {
    if (watch) watch(static_cast<double>(i) / static_cast<double>(parameters.size()), result);
    const double p = parameters[i];
    FigureMember at;
    const Status status = member(p, at);
    if (!status && gives_up()) break;
    if (status) {
      const auto n_special = static_cast<std::ptrdiff_t>(result.special.size());
      if (previous) locate_special(result.members.back().parameter, p, result);
      if (previous && gives_up()) {  // some special points may be missing
        result.special.erase(result.special.begin() + n_special, result.special.end());
        break;
      }
      result.members.push_back(at);
      forget_all_but(at);  // the figures that were computed between members are not needed again
    } else {
      result.missing.push_back({p, status.reason()});
    }
    previous = status.ok();
  }
  return result;
}

}  // namespace pseudorigid::mechanics
