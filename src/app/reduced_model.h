#pragma once
/// The pseudo-rigid body of a scene, as ModelRun wants it.

#include "app/scene_to_model.h"
#include "io/ellipsoid_surface.h"
#include "io/trajectory.h"
#include "mechanics/step_size.h"
#include "reduced/observe.h"

namespace pseudorigid::app {

template <class Body>
class ReducedModel {
 public:
  using System = Body;
  using State = mechanics::State<Body>;
  using Workspace = typename Body::Workspace;
  static constexpr const char* name = "reduced";
  /// Steps take a fraction of a microsecond: the clock and the interrupt flag are looked at this seldom.
  static constexpr int steps_between_looks = 256;
  static constexpr double pilot_reserve = 1;

  ReducedModel(Body body, const RunContext& context)
      : body_(std::move(body)), context_(context), request_(context.request()) {}

  const Body& system() const { return body_; }
  State initial_state() const {
    return {0, initial_deformation(context_.scene), initial_velocity(context_.scene, context_.units)};
  }
  double constraint_scale() const { return 1; }
  Eigen::Matrix3d configuration(const State& state) const { return state.q; }
  double rate(const State& state) const { return mechanics::affine_rate(state.q, state.v); }
  /// About ten pulsations: from there on the time error of regular motions grows linearly.
  double pilot_window(double end) const { return std::min(end, 20.0); }

  std::vector<std::string> columns(const scene::Quantities& q) const { return io::reduced_columns(q); }

  mechanics::Status row(double time, const State& state, Workspace& workspace, std::vector<double>& row) {
    if (auto status = reduced::observe(body_, state, workspace, request_, observables_); !status) return status;
    io::reduced_row(time, observables_, context_.units, context_.needs.quantities, row);
    return {};
  }

  mechanics::Status write_frame(const std::filesystem::path& path, const State& state, Workspace& workspace) {
    double Lambda = 0;
    if constexpr (!mechanics::unconstrained<Body>)
      if (auto status = mechanics::multiplier_of_motion(body_, state, workspace, Lambda); !status) return status;
    const Eigen::Matrix3d stress = body_.cauchy_stress(state.q, Lambda / body_.m_bar()) * context_.units.stress();
    if (!sphere_) sphere_.emplace(12);
    io::write_ellipsoid_vtu(path, *sphere_, {state.q, stress, Eigen::Vector3d::Zero(), context_.units.length});
    return {};
  }

  template <class MethodWorkspace>
  void report(const MethodWorkspace&, io::Manifest::Model&) const {}

 private:
  Body body_;
  const RunContext& context_;
  mechanics::ObservableRequest request_;
  mechanics::BodyObservables observables_;
  std::optional<io::CubedSphere> sphere_;
};

}  // namespace pseudorigid::app
