#pragma once
/// Tables with known answers, written through the same columns and rows as those of a run.

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "analysis/comparison.h"
#include "io/trajectory.h"
#include "support/dense.h"

namespace synthetic {

using pseudorigid::io::Table;
using pseudorigid::mechanics::BodyObservables;
using pseudorigid::mechanics::ContinuumObservables;
using pseudorigid::scene::Quantities;

inline constexpr double exact_omega = 2.665622189236, pseudo_rigid_omega = 3.1622776601683795;  // PHYSICS.md, section 3
inline constexpr double m_bar = 4 * std::numbers::pi / 15;

/// Q and Q̇ at a time.
struct Motion {
  std::function<Eigen::Matrix3d(double)> Q, Qdot;
};

/// Id + ε cos(ωt) diag(−½, −½, 1).
inline Motion pulsation(double omega, double amplitude = 0.01) {
  const Eigen::Matrix3d H = Eigen::Vector3d(-0.5, -0.5, 1).asDiagonal();
  return {
      [=](double t) -> Eigen::Matrix3d { return Eigen::Matrix3d::Identity() + amplitude * std::cos(omega * t) * H; },
      [=](double t) -> Eigen::Matrix3d { return -amplitude * omega * std::sin(omega * t) * H; }};
}

/// exp(spin t ·) about the 3-axis, applied to another motion.
inline Motion turning(const Motion& motion, double spin) {
  const auto R = [=](double t) -> Eigen::Matrix3d {
    return Eigen::AngleAxisd(spin * t, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  };
  const Eigen::Matrix3d hat{{0, -spin, 0}, {spin, 0, 0}, {0, 0, 0}};
  return {[=](double t) -> Eigen::Matrix3d { return R(t) * motion.Q(t); },
          [=](double t) -> Eigen::Matrix3d { return R(t) * (motion.Qdot(t) + hat * motion.Q(t)); }};
}

inline Eigen::Vector3d axial(const Eigen::Matrix3d& A) {
  return {A(2, 1) - A(1, 2), A(0, 2) - A(2, 0), A(1, 0) - A(0, 1)};
}

/// Everything that the motion determines; the elastic energy completes the kinetic one to `energy`.
inline ContinuumObservables observe(const Motion& motion, double t, double energy) {
  ContinuumObservables o;
  o.center = o.velocity = Eigen::Vector3d::Zero();
  o.gravitational = o.external = o.dissipated = o.multiplier = 0;
  o.nonaffine_kinetic_fraction = o.nonaffine_displacement = 0;
  o.min_jacobian = 1;
  o.volume_error = o.max_volume_error = 0;
  o.Q = motion.Q(t);
  o.Qdot = motion.Qdot(t);
  o.F = o.Q;
  o.kinetic = 0.5 * m_bar * o.Qdot.squaredNorm();
  o.elastic = energy - o.kinetic;
  o.angular_momentum = m_bar * axial(o.Qdot * o.Q.transpose());
  o.circulation = m_bar * axial(o.Q.transpose() * o.Qdot);
  o.volume_ratio = o.Q.determinant();
  o.semi_axes = pseudorigid::testing::singular_values(o.Q);
  return o;
}

inline std::vector<double> times(int n_samples, double end) {
  std::vector<double> t;
  for (int n = 0; n < n_samples; ++n) t.push_back(end * n / std::max(1, n_samples - 1));
  return t;
}

inline Table reduced_run(const Motion& motion, const std::vector<double>& t,
                         const Quantities& quantities = {.orbit = false}) {
  using pseudorigid::mechanics::ReducedObservables;
  const pseudorigid::io::Trajectory<ReducedObservables> trajectory(quantities);
  Table table{.columns = trajectory.names(), .values = {}};
  std::vector<double> row;
  for (const double time : t) {
    trajectory.row(time, ReducedObservables{observe(motion, time, 1)}, row);
    table.values.insert(table.values.end(), row.begin(), row.end());
  }
  return table;
}

using Change = std::function<void(double, ContinuumObservables&)>;

/// `change` may overwrite what the motion does not determine.
inline Table continuum_run(const Motion& motion, const std::vector<double>& t,
                           const Quantities& quantities = {.orbit = false}, const Change& change = {}) {
  const pseudorigid::io::Trajectory<ContinuumObservables> trajectory(quantities);
  Table table{.columns = trajectory.names(), .values = {}};
  std::vector<double> row;
  for (const double time : t) {
    ContinuumObservables o = observe(motion, time, 1);
    if (change) change(time, o);
    trajectory.row(time, o, row);
    table.values.insert(table.values.end(), row.begin(), row.end());
  }
  return table;
}

/// The pulsation of the two models, at 201 times from 0 to 10.
inline const std::vector<double> ten{times(201, 10)};
inline const Motion reduced_pulsation = pulsation(pseudo_rigid_omega), exact_pulsation = pulsation(exact_omega);

/// What is known of the errors of two runs of which everything is known.
struct KnownErrors {
  pseudorigid::analysis::RunErrors reduced{.time = 0, .space = 0}, continuum{.time = 0, .space = 0};
};

/// Of two runs, called as those of the program.
inline pseudorigid::analysis::Comparison compare(const Table& reduced, const Table& continuum,
                                                 const pseudorigid::analysis::ComparisonOptions& options = {},
                                                 const KnownErrors& errors = {}) {
  return pseudorigid::analysis::compare({"reduced", "pseudo-rigid", reduced, errors.reduced},
                                        {"continuum", "elastic", continuum, errors.continuum}, options);
}

}  // namespace synthetic
