#pragma once
/// The polynomial body of a scene, incompressible or compressible, as a model that ModelRun can integrate.

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/polynomial/body_setup.h"
#include "app/polynomial/figure_start.h"
#include "app/polynomial/run_quadrature.h"
#include "app/run/field_model.h"
#include "app/run/picture.h"
#include "io/ball_blocks.h"
#include "polynomial/fields.h"
#include "polynomial/material_faces.h"
#include "polynomial/observe.h"
#include "polynomial/vibration.h"

namespace pseudorigid::app {

/// The polynomial model of one degree. `Body` is polynomial::IncompressibleBody or polynomial::CompressibleBody.
template <class Body>
class PolynomialModel final : public FieldModel<Body, polynomial::MaterialFaces> {
  using Base = FieldModel<Body, polynomial::MaterialFaces>;
  using Base::context_;
  /// Number of steps between two checks of the clock and of the interrupt flag. A step of a body of low degree takes
  /// microseconds, so a check after every step would cost too much time.
  static constexpr int between_looks = 16;

 public:
  using System = Body;
  using typename Base::State, typename Base::Workspace;

  PolynomialModel(const RunContext& context, const PolynomialTask& task)
      : Base(context, task.name, between_looks, task.trace),
        body_(body_setup(context.scene, context.needs.sector.reflect, task.degree)),
        quadrature_(context, this->name, body_setup(context.scene, context.needs.sector.reflect, task.degree)) {}

  const System& system() const override { return body_; }
  /// The kinetic energy includes that of the companions.
  Eigen::Vector2d energies(const State& state) const override {
    const double of_orbit = 0.5 * body_.companions(state.v).squaredNorm();
    return {body_.kinetic_energy(state.v) + of_orbit, body_.potential_energies(state.t, state.q).total()};
  }
  std::string place_of_least_jacobian(const State& state) const override {
    return "least " + body_.least_jacobian_in_words(state.q);
  }

  void choose_quadrature(const State& state) override { quadrature_.choose(body_, state); }
  void estimate_quadrature(const State& state, double stable_step) override {
    quadrature_.estimate(body_, state, stable_step);
  }

  mechanics::Status write_frame(const std::filesystem::path& path, double time, const State& state,
                                Workspace& workspace) override {
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

  std::string shape_file() const override { return "shapes-" + this->name; }

  void report(const mechanics::Counters& counters, [[maybe_unused]] const Workspace* workspace,
              io::Manifest::Model& statistics) const override {
    auto& c = statistics.counters;
    c["degree"] = body_.space().degree();
    c["unknowns"] = body_.space().n_unknowns();
    c["images"] = body_.space().n_mirrors();
    c["points"] = body_.space().n_points();
    if constexpr (!mechanics::unconstrained<System>) {
      c["multipliers"] = body_.space().n_pressures();
      c["gram_iterations"] = static_cast<double>(counters.n_gram_iterations);
      if (workspace) c["gram_factorizations"] = static_cast<double>(workspace->gram.n_factorizations());
    }
    Base::report(counters, workspace, statistics);
    quadrature_.report(body_, statistics);
  }

 private:
  /// The ball divided into blocks, and the evaluation of the fields at the points of the blocks. If the blocks are
  /// divided into cells, a quarter of a circle has 8 straight edges.
  struct Picture {
    explicit Picture(const polynomial::PolynomialSpace& space) : ball(io::ball_blocks(4, 2)), at(space, ball.points) {}
    io::BallBlocks ball;
    polynomial::FieldsAtPoints at;
  };
  Eigen::VectorXd affine(const Eigen::Matrix3d& A, const Eigen::Vector3d& c) const override {
    return body_.affine(A, c);
  }
  mechanics::Status own_figure(Eigen::VectorXd& x, Eigen::VectorXd& v) const override {
    return start_from_figure(context_.scene, body_.space(), x, v);
  }
  void transform(const Eigen::Matrix3d& D, Eigen::VectorXd& x) const override { body_.transform(D, x); }
  Eigen::Matrix3d affine_part(const Eigen::VectorXd& x) const override {
    return body_.space().affine_part(x.head(body_.space().n_unknowns()));
  }
  Eigen::Vector3d mean(const Eigen::VectorXd& x) const override {
    return body_.space().mean(x.head(body_.space().n_unknowns()));
  }
  double least_jacobian_at(const Eigen::VectorXd& x) const override {
    return body_.least(x, [](const Eigen::Matrix3d& F) { return F.determinant(); });
  }
  mechanics::VibrationObservables vibration(const State& state, const mechanics::ContinuumObservables& known) override {
    if (!vibration_) vibration_.emplace(body_.space());
    return vibration_->observe(state, known);
  }
  std::array<double, 3> own_remarks() const override { return quadrature_.numbers(body_); }
  void take_own_remarks(std::span<const double, 3> remarks) override { quadrature_.take_numbers(remarks, body_); }

  System body_;
  RunQuadrature<System> quadrature_;
  std::optional<polynomial::BodyVibration> vibration_;  ///< empty before the first row with the columns of vibration
  std::optional<Picture> picture_;                      ///< empty before the first picture
};

}  // namespace pseudorigid::app
