#pragma once
/// Adapter of the polynomial body of a scene, incompressible or compressible, to the RunnableModel interface.

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/polynomial/body_setup.h"
#include "app/polynomial/run_quadrature.h"
#include "app/run/nonaffine_watch.h"
#include "app/run/picture.h"
#include "app/run/run_context.h"
#include "app/run/tension_watch.h"
#include "app/search/trace_recorder.h"
#include "io/ball_blocks.h"
#include "io/csv.h"
#include "io/trajectory.h"
#include "mechanics/steps/step_size.h"
#include "polynomial/fields.h"
#include "polynomial/material_faces.h"
#include "polynomial/observe.h"

namespace pseudorigid::app {

/// `Body` is a polynomial::IncompressibleBody or polynomial::CompressibleBody.
template <class Body>
class PolynomialModel {
 public:
  using System = Body;
  using State = mechanics::State<System>;
  using Workspace = typename System::Workspace;
  /// A step of a small body takes microseconds.
  static constexpr int steps_between_looks = 16;
  /// As of the continuum, whose motions these are.
  static constexpr double pilot_reserve = 0.4;

  PolynomialModel(const RunContext& context, const PolynomialTask& task)
      : name_(task.name),
        name(name_.c_str()),
        context_(context),
        trace_(context, task.trace),
        body_(body_setup(context.scene, context.needs.sector.reflect, task.degree)),
        trajectory_(context.needs.quantities, context.units),
        request_(trajectory_.request()),
        nonaffine_(context, name),
        tension_(context, name),
        quadrature_(context, name, body_setup(context.scene, context.needs.sector.reflect, task.degree)) {
    request_.nonaffine |= nonaffine_.watches();
    request_.multiplier |= tension_.watches();
  }
  PolynomialModel(const PolynomialModel&) = delete;

 private:
  std::string name_;

 public:
  const char* const name;

  const System& system() const { return body_; }
  State initial_state() const {
    const scene::Scene& scene = context_.scene;
    const io::Units& units = context_.units;
    return {0, body_.affine(initial_deformation(scene), initial_center(scene, units)),
            body_.affine(initial_velocity(scene, units), initial_center_velocity(scene, units))};
  }
  double constraint_scale() const { return body_.multiplier_scale(); }  // only called with constraints
  Eigen::Matrix3d configuration(const State& state) const { return affine_part(state.q); }
  double rate(const State& state) const { return mechanics::affine_rate(affine_part(state.q), affine_part(state.v)); }
  Eigen::Vector2d energies(const State& state) const {
    return {body_.kinetic_energy(state.v), body_.potential_energies(state.t, state.q).total()};
  }
  /// About half a pulsation: by then shear waves from the surface have crossed the ball.
  double pilot_window(double end) const { return std::min(end, 1.0); }

  std::string place_of_least_jacobian(const State& state) const {
    return "least " + body_.least_jacobian_in_words(state.q);
  }

  const std::vector<std::string>& columns() const { return trajectory_.names(); }

  mechanics::Status row(double time, const State& state, Workspace& workspace, std::vector<double>& row) {
    if (auto status = polynomial::observe(body_, state, workspace, request_, observables_); !status) return status;
    trajectory_.row(time, observables_, row);
    trace_.note(time, [&] { return configuration(state); });
    nonaffine_.look(time, observables_.nonaffine_displacement);
    tension_.look(time, observables_.multiplier * context_.units.multiplier());
    return {};
  }
  /// Restores the history from the rows of an interrupted run.
  void take_up(const io::Table& rows) {
    if (tension_.watches() && rows.has_column("multiplier"))
      tension_.take_up(rows.column("time"), rows.column("multiplier"));
    trace_.take_up(rows);
  }

  std::vector<double> remarks() const {
    const auto of_motion = nonaffine_.remarks();
    const auto of_quadrature = quadrature_.numbers(body_);
    std::vector<double> remarks(of_motion.begin(), of_motion.end());
    remarks.insert(remarks.end(), of_quadrature.begin(), of_quadrature.end());
    return remarks;
  }
  void take_remarks(std::span<const double> remarks) {
    nonaffine_.take_remarks(remarks.first<3>());
    quadrature_.take_numbers(remarks.subspan<3, RunQuadrature<System>::n_numbers>(), body_);
  }

  void choose_quadrature(const State& state) { quadrature_.choose(body_, state); }
  void estimate_quadrature(const State& state, double stable_step) { quadrature_.estimate(body_, state, stable_step); }

  mechanics::Status write_frame(const std::filesystem::path& path, double time, const State& state,
                                Workspace& workspace) {
    Eigen::VectorXd lambda;
    if constexpr (!mechanics::unconstrained<System>) {
      lambda = body_.make_multiplier();
      if (auto status = mechanics::multiplier_of_motion(body_, state, workspace, lambda); !status) return status;
    }
    if (!picture_) picture_.emplace(body_.space());
    mechanics::BodyFields fields;
    if (auto status = picture_->at.fields(body_, state.q, state.v, lambda, fields); !status) return status;
    write_picture(context_, path, time, picture_->ball.blocks, fields);
    return {};
  }

  std::string shape_file() const { return "shapes-" + name_; }
  std::vector<std::string> shape_columns() const {
    std::vector<std::string> columns{"time"};
    columns.insert(columns.end(), polynomial::MaterialFaces::columns.begin(), polynomial::MaterialFaces::columns.end());
    return columns;
  }
  std::vector<std::vector<double>> shape(double time, const State& state) const {
    if (!faces_) faces_.emplace(body_.space());
    std::vector<std::vector<double>> rows = faces_->rows(state.q);
    for (std::vector<double>& row : rows) {
      for (std::size_t c = polynomial::MaterialFaces::first_length; c < row.size(); ++c)
        row[c] *= context_.units.length;
      row.insert(row.begin(), time);
    }
    return rows;
  }

  template <class MethodWorkspace>
  void report([[maybe_unused]] const MethodWorkspace& w, io::Manifest::Model& statistics) const {
    auto& c = statistics.counters;
    c["degree"] = body_.space().degree();
    c["unknowns"] = body_.space().n_unknowns();
    c["images"] = body_.space().n_mirrors();
    c["points"] = body_.space().n_points();
    if constexpr (!mechanics::unconstrained<System>) {
      c["multipliers"] = body_.space().n_pressures();
      c["gram_iterations"] = static_cast<double>(w.counters.n_gram_iterations);
      if constexpr (requires { w.system.gram; })
        c["gram_factorizations"] = static_cast<double>(w.system.gram.n_factorizations());
    }
    nonaffine_.report(statistics);
    tension_.report(statistics);
    quadrature_.report(body_, statistics);
  }

 private:
  /// Cut into cells, a quarter of a circle is 8 straight edges.
  struct Picture {
    explicit Picture(const polynomial::PolynomialSpace& space) : ball(io::ball_blocks(4, 2)), at(space, ball.points) {}
    io::BallBlocks ball;
    polynomial::FieldsAtPoints at;
  };
  Eigen::Matrix3d affine_part(const Eigen::VectorXd& x) const {
    return body_.space().affine_part(x.head(body_.space().n_unknowns()));
  }

  const RunContext& context_;
  TraceRecorder trace_;
  System body_;
  io::Trajectory<mechanics::ContinuumObservables> trajectory_;
  mechanics::ObservableRequest request_;
  mechanics::ContinuumObservables observables_;
  NonaffineWatch nonaffine_;
  TensionWatch tension_;
  RunQuadrature<System> quadrature_;
  std::optional<Picture> picture_;                          ///< from the first one on
  mutable std::optional<polynomial::MaterialFaces> faces_;  ///< likewise
};

}  // namespace pseudorigid::app
