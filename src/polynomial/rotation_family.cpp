#include "polynomial/rotation_family.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "mechanics/core/bracketed_root.h"

namespace pseudorigid::polynomial {
namespace {

/// Half of the relative width of the bracket at which the search for a special point ends. Each step of the search
/// solves an eigenvalue problem.
constexpr double resolution = 1e-12;

}  // namespace

RotationFinder::RotationFinder(const BodySetup& setup, bool incompressible, FamilyOfRotations family)
    : family_(std::move(family)),
      rotations_(setup, incompressible, family_.figure),
      spectrum_(setup, incompressible, family_.figure) {}

/// Finds the figure with this parameter if no other figure is known yet. Fails if the function `nearby` of the family
/// fails, or if no figure is found.
mechanics::Status RotationFinder::first(double parameter, SteadyRotation& rotation) const {
  const FigureCondition condition = family_.condition(parameter);
  if (family_.figure == Figure::ellipsoid) {
    NearbyFigure nearby;
    if (auto status = family_.nearby(parameter, nearby); !status) return status;
    rotation = rotations_.affine(nearby.a, nearby.spin_squared);
    return rotations_.solve(condition, rotation);
  }
  rotation = rotations_.affine(Eigen::Vector3d::Ones(), 0);
  if (auto status = rotations_.solve({condition.parameter, 0}, rotation); !status) return status;
  return rotations_.follow(0, condition, rotation);
}

mechanics::Status RotationFinder::find(double parameter, SteadyRotation& rotation) {
  const FigureCondition condition = family_.condition(parameter);
  if (!std::isfinite(condition.value)) return mechanics::Status::failure("there is no figure with this parameter");
  mechanics::Status status;
  if (known_.empty()) {
    status = first(parameter, rotation);
  } else {
    const auto nearest = std::ranges::min_element(
        known_, {}, [&](const auto& known) { return std::abs(known.first - condition.value); });
    rotation = nearest->second;
    status = rotations_.follow(nearest->first, condition, rotation);
  }
  if (!status) return status;
  constexpr double round_off = 1e-12;
  if (rotation.spin_squared < -round_off)
    return mechanics::Status::failure("this figure does not turn steadily about its axis: Omega^2 = " +
                                      mechanics::six_digits(rotation.spin_squared));
  rotation.spin_squared = std::max(rotation.spin_squared, 0.0);
  known_[condition.value] = rotation;
  return {};
}

mechanics::Status RotationFinder::member(double parameter, RotationMember& member) {
  if (const auto found = members_.find(parameter); found != members_.end()) {
    member = found->second;
    return {};
  }
  member = {parameter, {}, {}};
  if (gives_up()) return mechanics::Status::failure("interrupted");
  if (auto status = find(parameter, member.rotation); !status) return status;
  if (auto status = spectrum_.analyse(member.rotation, member.classes); !status) return status;
  members_[parameter] = member;
  return {};
}

/// Appends the special points between the members with the parameters a and b.
void RotationFinder::locate_special(double a, double b, std::vector<SpecialRotation>& special) {
  struct Found {
    mechanics::SpecialPoint point;
    MotionClass motions;
  };
  std::vector<Found> found;
  const std::vector<ClassStability> classes = members_.at(a).classes;
  for (std::size_t k = 0; k < classes.size(); ++k) {
    std::vector<mechanics::SpecialPoint> of_class;
    mechanics::locate_changes_of_stability(
        [&](double p) -> std::optional<mechanics::LinearStability> {
          RotationMember at;
          if (!member(p, at)) return std::nullopt;
          return at.classes[k].stability;
        },
        a, b, of_class, resolution);
    for (const auto& point : of_class) found.push_back({point, classes[k].motions});
  }
  if (family_.condition(a).parameter != FigureParameter::spin_squared) {
    const auto slope = [&](double p) {
      SteadyRotation at;
      return find(p, at) ? rotations_.slope(family_.condition(p), at) : std::numeric_limits<double>::quiet_NaN();
    };
    if (const auto p = mechanics::bracketed_root(slope, a, b, resolution); p && std::abs(slope(*p)) < 1e-6)
      found.push_back({{mechanics::SpecialKind::fold, *p}, {false, 0}});
  }
  std::ranges::stable_sort(found, {}, [](const Found& f) { return f.point.s; });
  for (const Found& f : found) {
    RotationMember at;
    if (member(f.point.s, at)) special.push_back({f.point.kind, f.motions, std::move(at)});
  }
}

RotationFamily RotationFinder::family(const std::vector<double>& parameters, std::function<bool()> give_up) {
  give_up_ = std::move(give_up);
  RotationFamily result;
  bool previous = false;
  for (const double p : parameters) {
    RotationMember at;
    const mechanics::Status status = member(p, at);
    if (!status && gives_up()) break;
    if (status) {
      if (previous) locate_special(result.members.back().parameter, p, result.special);
      result.members.push_back(at);
      // The figures that were computed between members are not needed again.
      known_ = {{family_.condition(p).value, at.rotation}};
      members_ = {{p, std::move(at)}};
    } else {
      result.missing.push_back({p, status.reason()});
    }
    previous = status.ok();
  }
  return result;
}

}  // namespace pseudorigid::polynomial
