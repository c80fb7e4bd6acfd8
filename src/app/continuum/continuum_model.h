#pragma once
/// The finite-element ball of a scene, incompressible or compressible, as a model that ModelRun can integrate.

#include <fmt/format.h>

#include "app/continuum/figure_start.h"
#include "app/continuum/stored_energy.h"
#include "app/continuum/wrinkling_watch.h"
#include "app/ranks/on_all_ranks.h"
#include "app/run/field_model.h"
#include "app/run/mesh_file.h"
#include "app/run/model_run.h"
#include "app/run/picture.h"
#include "app/search/continuum_run.h"
#include "continuum/output/material_faces.h"
#include "continuum/output/nodal_fields.h"
#include "continuum/output/observe.h"
#include "continuum/output/rank_order.h"
#include "continuum/output/vibration.h"
#include "continuum/parallel/message_counts.h"
#include "continuum/parallel/ranks.h"

namespace pseudorigid::app {

/// The finite-element model on one discretisation. `Ball` is continuum::ElasticBall for an incompressible body and
/// continuum::CompressibleBall for a compressible body.
template <class Ball>
class ContinuumModel final : public FieldModel<Ball, continuum::MaterialFaces> {
  using Base = FieldModel<Ball, continuum::MaterialFaces>;
  using Base::context_;

 public:
  using System = Ball;
  using typename Base::State, typename Base::Workspace;

  ContinuumModel(const RunContext& context, const ContinuumTask& task)
      : Base(context, "continuum", 1, task.trace),
        law_(internal_law(context.scene)),
        ball_(mesh_of(context, task.discretization.refinements), task.discretization.degree,
              stored_energy(context.scene), internal_loads(context.scene), context.scene.continuum.gravity_points,
              context.scene.continuum.contact_points),
        n_refinements_(task.discretization.refinements),
        rank_order_(ball_.space()),
        wrinkling_(context, law_) {}

  const System& system() const override { return ball_; }
  using MemoryLayout = continuum::MemoryLayout;
  const continuum::RankOrder& rank_order() const { return rank_order_; }
  Eigen::Vector2d energies(const State& state) const override { return continuum::energies(ball_, state); }

  /// Text with the least det F over the quadrature points and its place in the body, with the deformation gradient F.
  /// Collective.
  std::string place_of_least_jacobian(const State& state) const override {
    return "least " + continuum::in_words(ball_.least_jacobian(state.q));
  }

  bool has_fronts() const override { return true; }
  mechanics::Status row(double time, const State& state, Workspace& workspace, std::vector<double>& row) override {
    if (auto status = Base::row(time, state, workspace, row); !status) return status;
    wrinkling_.look(time, ball_.space(), state.q);
    return {};
  }
  mechanics::Status write_frame(const std::filesystem::path& path, double time, const State& state,
                                Workspace& workspace) override {
    if (blocks_.points.empty()) blocks_ = continuum::nodal_blocks(ball_.space());
    mechanics::BodyFields fields;
    mechanics::Status status = continuum::nodal_fields(ball_, state, workspace, fields);
    if (context_.ranks->any(!status))
      return status ? mechanics::Status::failure("there is no stress to draw on another rank") : status;
    if (context_.scene.output.cells == scene::Cells::lagrange) continuum::make_equidistant(ball_.space(), fields);
    write_picture(context_, path, time, blocks_, fields);
    return {};
  }

  std::string shape_file() const override { return "shapes"; }

  void report(const mechanics::Counters& counters, const Workspace* workspace,
              io::Manifest::Model& statistics) const override {
    auto& c = statistics.counters;
    c["cells"] = static_cast<double>(ball_.space().n_global_cells());
    c["unknowns"] = 3.0 * static_cast<double>(ball_.space().n_global_nodes());
    c["images"] = ball_.space().mesh().sector().n_images();
    if constexpr (!mechanics::unconstrained<System>) {
      c["multipliers"] = static_cast<double>(ball_.space().n_global_cells()) * ball_.space().n_pressure();
      c["gram_iterations"] = static_cast<double>(counters.n_gram_iterations);
      const auto gram = workspace->gram.statistics();
      c["gram_solves"] = static_cast<double>(gram.n_solves);
      c["gram_iterations_at_most"] = static_cast<double>(gram.n_iterations_at_most);
      c["gram_renewals"] = static_cast<double>(gram.n_renewals);
      c["gram_bytes"] = static_cast<double>(gram.memory);
    }
    c["kernel_bytes"] = static_cast<double>(ball_.kernels().memory());
    if (context_.ranks->size() > 1) report_messages(c);
    Base::report(counters, workspace, statistics);
    wrinkling_.report(statistics);
  }

 private:
  continuum::Vector affine(const Eigen::Matrix3d& A, const Eigen::Vector3d& c) const override {
    return ball_.affine_field(A, c);
  }
  Eigen::Matrix3d affine_part(const continuum::Vector& x) const override { return ball_.mass_moment(x); }
  Eigen::Vector3d mean(const continuum::Vector& x) const override { return ball_.mean(x); }
  mechanics::Status own_figure(continuum::Vector& x, continuum::Vector& v) const override {
    return start_from_figure(context_.scene, n_refinements_, ball_.space(), x, v);
  }
  void transform(const Eigen::Matrix3d& D, continuum::Vector& x) const override { ball_.transform(D, x); }
  double least_jacobian_at(const continuum::Vector& x) const override { return ball_.least_jacobian(x).value; }
  mechanics::VibrationObservables vibration(const State& state, const mechanics::ContinuumObservables& known) override {
    if (!vibration_) vibration_ = continuum::vibration_of(ball_);
    return continuum::observe_vibration(ball_, *vibration_, state, known);
  }
  std::array<double, 3> own_remarks() const override { return wrinkling_.remarks(); }
  void take_own_remarks(std::span<const double, 3> remarks) override { wrinkling_.take_remarks(remarks); }

  /// Adds the numbers of messages, bytes and reductions of MPI since the mesh was built. They include those of the
  /// search for the step. Messages and bytes are means over the ranks. The number of reductions is that of this rank.
  /// Collective.
  void report_messages(std::map<std::string, double>& counters) const {
    const continuum::MessageCounts own = continuum::message_counts() - counts_at_start_;
    const auto sums = continuum::sum_over_ranks(std::array{own.messages, own.bytes}, MPI_COMM_WORLD);
    counters["messages_of_a_rank"] = sums[0] / context_.ranks->size();
    counters["message_bytes_of_a_rank"] = sums[1] / context_.ranks->size();
    counters["reductions"] = own.reductions;
  }

  /// The mesh of the scene: the sector of the builtin ball between its symmetry planes, or the whole body of a mesh
  /// file. If the centre of mass of the file is not the origin, logs the displacement that moves it there.
  static continuum::BallMesh mesh_of(const RunContext& context, int n_refinements) {
    const MPI_Comm communicator = context.ranks->size() > 1 ? MPI_COMM_WORLD : MPI_COMM_SELF;
    if (!scene::has_mesh_file(context.scene))
      return {{context.needs.sector.reflect}, n_refinements, communicator, grading_of(context.scene)};
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
  /// Grading of the builtin mesh towards its two poles on one axis. If the scene has contact planes, this is the axis
  /// closest to the normal of the first plane. Otherwise it is the z axis.
  static continuum::Grading grading_of(const scene::Scene& scene) {
    continuum::Grading grading{.size = scene.continuum.grading};
    const auto planes = loads::constant_forcing(internal_loads(scene)).planes;
    if (!planes.empty()) planes.front().normal.cwiseAbs().maxCoeff(&grading.axis);
    return grading;
  }
  materials::AnyLaw law_;  ///< law of the scene in internal units
  System ball_;
  int n_refinements_;                ///< number of refinements of the mesh
  continuum::RankOrder rank_order_;  ///< order of vectors in checkpoints
  WrinklingWatch wrinkling_;
  std::optional<mechanics::Vibration> vibration_;  ///< empty before the first row with the columns of vibration
  mechanics::PointBlocks blocks_;                  ///< empty before the first picture
  continuum::MessageCounts counts_at_start_ = continuum::message_counts();
};

}  // namespace pseudorigid::app
