#include "reduced/center_of_mass.h"

#include <limits>
#include <optional>
#include <unsupported/Eigen/MatrixFunctions>

#include "mechanics/methods/dormand_prince_8.h"

namespace pseudorigid::reduced {

CenterOfMass::Motion CenterOfMass::at(double t) const {
  if (quadratic.isZero(0) && drag == 0)
    return {position + t * (velocity + t / 2 * acceleration), velocity + t * acceleration};
  Eigen::Matrix<double, 7, 7> A = Eigen::Matrix<double, 7, 7>::Zero();
  A.block<3, 3>(0, 3).setIdentity();
  A.block<3, 3>(3, 0) = -quadratic;
  A.block<3, 3>(3, 3) = -drag * Eigen::Matrix3d::Identity();
  A.block<3, 1>(3, 6) = acceleration;
  Eigen::Matrix<double, 7, 1> start;
  start << position, velocity, 1;
  const Eigen::Matrix<double, 7, 1> now = (t * A).exp() * start;
  return {now.head<3>(), now.segment<3>(3)};
}

namespace {

/// Potential energy of a point of unit mass at x, without surface loads.
double potential_of(const loads::Forcing& forcing, const Eigen::Vector3d& x) {
  return 0.5 * x.dot(forcing.quadratic * x) - forcing.acceleration.dot(x);
}

/// True if the centre stays at the origin, because it starts there at rest and no load is a uniform acceleration.
bool rests(const CenterOfMass& c) {
  const bool driven =
      loads::depend_on_time(c.driving, [](const loads::Forcing& f) { return !f.acceleration.isZero(0); });
  return c.position.isZero(0) && c.velocity.isZero(0) && c.acceleration.isZero(0) && !driven;
}

}  // namespace

double CenterOfMass::driven(const Motion& m, double t) const {
  return potential_of(loads::driving(driving, t), m.x) - m.work;
}

/// Integrates the position x of the centre, and the energy w per mass that the loads depending on time have given. The
/// vectors are q = (x, s) and v = (ẋ, w). The energy w is the velocity of the further coordinate s, with ẇ = ∂φ/∂t and
/// the potential φ of these loads.
struct CenterPath::Integration {
  struct Field {
    using Vector = Eigen::Vector4d;
    struct Workspace {};
    const CenterOfMass* center;

    mechanics::Status acceleration(double t, const Vector& q, const Vector& v, Workspace&, Vector& a) const {
      const loads::Forcing forcing = loads::driving(center->driving, t);
      const Eigen::Vector3d x = q.head<3>(), xdot = v.head<3>();
      a.head<3>() = center->acceleration + forcing.acceleration - (center->quadratic + forcing.quadratic) * x -
                    (center->drag + forcing.drag) * xdot;
      a[3] = potential_of(loads::driving_rate(center->driving, t), x);
      return {};
    }
    Vector make_vector() const { return Vector::Zero(); }
    Workspace make_workspace() const { return {}; }
  };
  using Method = mechanics::DormandPrince8;
  using State = mechanics::State<Field>;
  /// Tolerance of local errors. A tolerance smaller by a factor of 10 is below round-off.
  static constexpr double tolerance = 1e-15;
  /// Bound of the length of a step. This bound is so large that only the tolerance limits the steps. The steps
  /// therefore do not depend on the sampling times.
  static constexpr double far = 1e3;

  explicit Integration(const CenterOfMass& center) : field{&center} { begin(); }

  void begin() {
    next = {0, field.make_vector(), field.make_vector()};
    next.q.head<3>() = field.center->position;
    next.v.head<3>() = field.center->velocity;
    before = next;
    workspace.emplace(field, tolerance);
  }

  /// Returns the motion at t, or NaN if the method fails. The method chooses its steps until a step passes t. The
  /// motion is then integrated from the start of this step to t.
  CenterOfMass::Motion at(double t) {
    if (t < before.t) begin();
    while (next.t <= t) {
      before = next;
      if (!Method::step(field, next.t + far, next, *workspace)) return beyond_numbers();
    }
    State now = before;
    Method::Workspace<Field> last(field, 1);
    last.h = t - before.t;
    while (now.t < t)
      if (!Method::step(field, t, now, last)) return beyond_numbers();
    return {now.q.head<3>(), now.v.head<3>(), now.v[3]};
  }

  static CenterOfMass::Motion beyond_numbers() {
    const Eigen::Vector3d nowhere = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    return {nowhere, nowhere};
  }

  Field field;
  State before, next;  ///< states at the start and at the end of the last step; both are the initial state at first
  std::optional<Method::Workspace<Field>> workspace;
};

CenterPath::CenterPath(const CenterOfMass& center) : center_(center) {
  if (loads::depend_on_time(center.driving) && !rests(center)) integration_ = std::make_unique<Integration>(center_);
}
CenterPath::~CenterPath() = default;

CenterOfMass::Motion CenterPath::at(double t) {
  if (integration_) return integration_->at(t);
  return center_.at(t);
}

}  // namespace pseudorigid::reduced
