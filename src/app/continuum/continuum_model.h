#pragma once
/// Adapter of the finite-element ball of a scene, incompressible or compressible, to the RunnableModel interface.

#include <fmt/format.h>

#include "app/continuum/stored_energy.h"
#include "app/continuum/wrinkling_watch.h"
#include "app/ranks/on_all_ranks.h"
#include "app/run/mesh_file.h"
#include "app/run/model_run.h"
#include "app/run/nonaffine_watch.h"
#include "app/run/picture.h"
#include "app/run/scene_to_model.h"
#include "app/run/tension_watch.h"
#include "app/search/continuum_run.h"
#include "app/search/trace_recorder.h"
#include "continuum/output/material_faces.h"
#include "continuum/output/nodal_fields.h"
#include "continuum/output/observe.h"
#include "continuum/output/rank_order.h"
#include "continuum/parallel/message_counts.h"
#include "continuum/parallel/ranks.h"
#include "io/trajectory.h"

namespace pseudorigid::app {

/// `Ball` is a continuum::ElasticBall or continuum::CompressibleBall.
template <class Ball>
class ContinuumModel {
 public:
  using System = Ball;
  using State = mechanics::State<System>;
  using Workspace = typename System::Workspace;
  static constexpr const char* name = "continuum";
  static constexpr int steps_between_looks = 1;
  /// In its first half pulsation a ball released from rest gathers as little as 0.45 of the mean growth of its time
  /// error (measured at Time/Tolerance = 1e-3 and 1e-4, t = 10), so the pilot gets this part of the tolerance.
  static constexpr double pilot_reserve = 0.4;

  ContinuumModel(const RunContext& context, const ContinuumTask& task)
      : context_(context),
        trace_(context, task.trace),
        law_(internal_law(context.scene)),
        ball_(mesh_of(context, task.discretization.refinements), task.discretization.degree,
              stored_energy(context.scene), internal_loads(context.scene), context.scene.continuum.gravity_points),
        rank_order_(ball_.space()),
        trajectory_(context.needs.quantities, context.units),
        request_(trajectory_.request()),
        nonaffine_(context, name),
        tension_(context, name),
        wrinkling_(context, law_) {
    request_.nonaffine |= nonaffine_.watches();
    request_.multiplier |= tension_.watches();
  }

  const System& system() const { return ball_; }
  using MemoryLayout = continuum::MemoryLayout;
  const continuum::RankOrder& rank_order() const { return rank_order_; }
  State initial_state() const {
    const scene::Scene& scene = context_.scene;
    const io::Units& units = context_.units;
    return {0, ball_.affine_field(initial_deformation(scene), initial_center(scene, units)),
            ball_.affine_field(initial_velocity(scene, units), initial_center_velocity(scene, units))};
  }
  double constraint_scale() const { return ball_.multiplier_scale(); }  // only called with constraints
  Eigen::Matrix3d configuration(const State& state) const { return ball_.mass_moment(state.q); }
  double rate(const State& state) const {
    return mechanics::affine_rate(ball_.mass_moment(state.q), ball_.mass_moment(state.v));
  }
  Eigen::Vector2d energies(const State& state) const { return continuum::energies(ball_, state); }
  /// About half a pulsation: by then the shear front from the surface has crossed the ball.
  double pilot_window(double end) const { return std::min(end, 1.0); }

  /// Collective.
  std::string place_of_least_jacobian(const State& state) const {
    return "least " + continuum::in_words(ball_.least_jacobian(state.q));
  }

  const std::vector<std::string>& columns() const { return trajectory_.names(); }

  mechanics::Status row(double time, const State& state, Workspace& workspace, std::vector<double>& row) {
    if (auto status = continuum::observe(ball_, state, workspace, request_, observables_); !status) return status;
    trajectory_.row(time, observables_, row);
    trace_.note(time, [&] { return configuration(state); });
    nonaffine_.look(time, observables_.nonaffine_displacement);
    tension_.look(time, observables_.multiplier * context_.units.multiplier());
    wrinkling_.look(time, ball_.space(), state.q);
    return {};
  }
  void take_up(const io::Table& rows) {
    if (tension_.watches() && rows.has_column("multiplier"))
      tension_.take_up(rows.column("time"), rows.column("multiplier"));
    trace_.take_up(rows);
  }

  std::vector<double> remarks() const {
    const auto of_motion = nonaffine_.remarks(), of_surface = wrinkling_.remarks();
    std::vector<double> remarks(of_motion.begin(), of_motion.end());
    remarks.insert(remarks.end(), of_surface.begin(), of_surface.end());
    return remarks;
  }
  void take_remarks(std::span<const double> remarks) {
    nonaffine_.take_remarks(remarks.first<3>());
    wrinkling_.take_remarks(remarks.subspan<3, 3>());
  }

  mechanics::Status write_frame(const std::filesystem::path& path, double time, const State& state,
                                Workspace& workspace) {
    if (blocks_.points.empty()) blocks_ = continuum::nodal_blocks(ball_.space());
    mechanics::BodyFields fields;
    mechanics::Status status = continuum::nodal_fields(ball_, law_, state, workspace, fields);
    if (context_.ranks->any(!status))
      return status ? mechanics::Status::failure("there is no stress to draw on another rank") : status;
    if (context_.scene.output.cells == scene::Cells::lagrange) continuum::make_equidistant(ball_.space(), fields);
    write_picture(context_, path, time, blocks_, fields);
    return {};
  }

  std::string shape_file() const { return "shapes"; }
  std::vector<std::string> shape_columns() const {
    std::vector<std::string> columns{"time"};
    columns.insert(columns.end(), continuum::MaterialFaces::columns.begin(), continuum::MaterialFaces::columns.end());
    return columns;
  }
  /// The rows of shapes.csv at a time, on the first rank. Collective.
  std::vector<std::vector<double>> shape(double time, const State& state) const {
    constexpr std::size_t n_columns = continuum::MaterialFaces::columns.size();
    const std::vector<double> points = faces().rows(state.q);
    std::vector<std::vector<double>> rows;
    for (std::size_t i = 0; i < points.size(); i += n_columns) {
      auto& row = rows.emplace_back(1, time);
      for (std::size_t c = 0; c < n_columns; ++c)
        row.push_back(points[i + c] * (c < continuum::MaterialFaces::first_length ? 1 : context_.units.length));
    }
    return rows;
  }

  template <class MethodWorkspace>
  void report([[maybe_unused]] const MethodWorkspace& w, io::Manifest::Model& statistics) const {
    auto& c = statistics.counters;
    c["cells"] = static_cast<double>(ball_.space().n_global_cells());
    c["unknowns"] = 3.0 * static_cast<double>(ball_.space().n_global_nodes());
    c["images"] = ball_.space().mesh().sector().n_images();
    if constexpr (!mechanics::unconstrained<System>) {
      c["multipliers"] = static_cast<double>(ball_.space().n_global_cells()) * ball_.space().n_pressure();
      c["gram_iterations"] = static_cast<double>(w.counters.n_gram_iterations);
      const auto gram = w.system.gram.statistics();
      c["gram_solves"] = static_cast<double>(gram.n_solves);
      c["gram_iterations_at_most"] = static_cast<double>(gram.n_iterations_at_most);
      c["gram_renewals"] = static_cast<double>(gram.n_renewals);
      c["gram_bytes"] = static_cast<double>(gram.memory);
    }
    c["kernel_bytes"] = static_cast<double>(ball_.kernels().memory());
    if (context_.ranks->size() > 1) report_messages(c);
    nonaffine_.report(statistics);
    tension_.report(statistics);
    wrinkling_.report(statistics);
  }

 private:
  /// Since the mesh was there: those of the search for a step and of the motion, messages and bytes as means over the
  /// ranks. Collective.
  void report_messages(std::map<std::string, double>& counters) const {
    const continuum::MessageCounts own = continuum::message_counts() - counts_at_start_;
    const auto sums = continuum::sum_over_ranks(std::array{own.messages, own.bytes}, MPI_COMM_WORLD);
    counters["messages_of_a_rank"] = sums[0] / context_.ranks->size();
    counters["message_bytes_of_a_rank"] = sums[1] / context_.ranks->size();
    counters["reductions"] = own.reductions;
  }

  static continuum::BallMesh mesh_of(const RunContext& context, int n_refinements) {
    const MPI_Comm communicator = context.ranks->size() > 1 ? MPI_COMM_WORLD : MPI_COMM_SELF;
    if (!scene::has_mesh_file(context.scene)) return {{context.needs.sector.reflect}, n_refinements, communicator};
    const CenteredMesh body = read_mesh_file(context.scene);
    if (body.is_moved)
      context.log->info(
          "continuum: the body of {} is moved by ({:.6g}, {:.6g}, {:.6g}), so that its centre of mass is "
          "the origin",
          context.scene.continuum.mesh, -body.center[0], -body.center[1], -body.center[2]);
    continuum::CoarseMesh mesh;
    for (const auto& X : body.mesh.vertices) mesh.vertices.emplace_back(X[0], X[1], X[2]);
    mesh.cells = body.mesh.cells;
    return {mesh, n_refinements, communicator};
  }
  const continuum::MaterialFaces& faces() const {
    if (!faces_) faces_.emplace(ball_.space());
    return *faces_;
  }

  const RunContext& context_;
  TraceRecorder trace_;
  materials::AnyLaw law_;
  System ball_;
  continuum::RankOrder rank_order_;
  io::Trajectory<mechanics::ContinuumObservables> trajectory_;
  mechanics::ObservableRequest request_;
  mechanics::ContinuumObservables observables_;
  NonaffineWatch nonaffine_;
  TensionWatch tension_;
  WrinklingWatch wrinkling_;
  mechanics::PointBlocks blocks_;                          ///< empty until the first frame
  mutable std::optional<continuum::MaterialFaces> faces_;  ///< likewise, until the first shape
  continuum::MessageCounts counts_at_start_ = continuum::message_counts();
};

}  // namespace pseudorigid::app
