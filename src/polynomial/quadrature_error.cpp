#include "polynomial/quadrature_error.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mechanics/steps/largest_frequency.h"
#include "mechanics/steps/pilot_run.h"
#include "mechanics/steps/step_size.h"
#include "polynomial/compressible_body.h"
#include "polynomial/incompressible_body.h"

namespace pseudorigid::polynomial {
namespace {

using mechanics::detail::PilotRun;

/// The window is at least the time `least_window`, in units r/c with the radius r and the speed c of shear waves. It is
/// also at least the fraction `part_of_run` of the run. In units r/c, the lowest mode of the incompressible ball has
/// the period 2.36.
constexpr double least_window = 3, part_of_run = 1.0 / 16;
constexpr double caution = 6;             ///< factor in the estimate e (head of quadrature_error.h)
constexpr double caution_of_volume = 60;  ///< factor in e for the volume if points are added
/// Largest number of points in each direction that the search adds.
constexpr int most_points_more = 8;

template <class Body>
class QuadratureSearch {
 public:
  QuadratureSearch(const BodySetup& setup, const BodyState& state, const QuadratureRequest& request)
      : setup_(setup), state_(state), request_(request), window_(window(request)) {
    setup_.n_points = setup.n_points.value_or(PolynomialSpace::least_points(setup.degree));
    choice_.n_points = *setup_.n_points;
  }

  QuadratureChoice run(const Body& body) {
    if (setup_.degree == 1) {
      choice_.error = 0;  // the motion remains affine
      return choice_;
    }
    double e = of_volume(body);
    if (choice_.reason.empty() && body.gravity()) e += of_gravity();
    if (choice_.reason.empty()) choice_.error = e;
    return std::move(choice_);
  }

 private:
  static double window(const QuadratureRequest& request) {
    return request.adds_points ? request.end : std::min(request.end, std::max(least_window, part_of_run * request.end));
  }

  /// Returns the estimate for the rule in the volume, and adds points if this is requested. If a pilot run fails, sets
  /// the reason and returns 0.
  double of_volume(const Body& body) {
    if (!find_step(body)) return 0;
    const int most = choice_.n_points + most_points_more;
    const double factor = request_.adds_points ? caution_of_volume : caution;
    double e = HUGE_VAL;
    for (;;) {
      BodySetup other = setup_;
      ++*other.n_points;
      PilotRun finer = pilot(Body(other));
      if (!finer.status) {
        choice_.reason = finer.status.reason();
        return 0;
      }
      const double before = std::exchange(e, error(factor, own_, finer));
      // If a further point does not halve the error, the error has reached round-off.
      const bool is_enough = e <= mechanics::detail::error_safety * request_.tolerance || e > before / 2;
      if (!request_.adds_points || is_enough || choice_.n_points == most) return e;
      own_ = std::move(finer);
      setup_ = std::move(other);
      choice_.n_points = *setup_.n_points;
    }
  }

  /// Returns the estimate for the rule on the surface. If the pilot run fails, sets the reason, and the result is not
  /// valid.
  double of_gravity() {
    constexpr int fewest = 4;
    BodySetup other = setup_;
    const int n = setup_.n_gravity_points.value_or(BodyGravity::usual_points(setup_.degree));
    other.n_gravity_points = n < fewest ? n + 2 : n - 2;
    const PilotRun of_other = pilot(Body(other));
    choice_.reason = of_other.status ? "" : of_other.status.reason();
    return error(caution, own_, of_other);
  }

  double error(double factor, const PilotRun& a, const PilotRun& b) const {
    return factor * mechanics::detail::largest_difference(a, b) * std::pow(request_.end / window_, quadrature_growth);
  }

  /// Computes the number of steps from the stability limit, and makes the pilot run own_. If this run fails, the motion
  /// may have become stiffer, and the step is halved. If all halvings fail, the window is shortened. Returns false if
  /// no pilot run succeeds or if the stability limit cannot be computed.
  bool find_step(const Body& body) {
    constexpr double reserve = 0.8;
    constexpr int most_halvings = 3;
    const double stable = request_.stable_step > 0 ? request_.stable_step : stable_step(body);
    if (!choice_.reason.empty()) return false;
    n_steps_ = std::max(1L, static_cast<long>(std::ceil(window_ / (reserve * stable))));
    for (int i = 0; i < most_halvings; ++i, n_steps_ *= 2)
      if (own_ = pilot(body); own_.status) return true;
    // Shorter steps did not help, so the motion itself probably ends inside the window. The new window is half of the
    // time that the last run reached.
    if (own_.t > 0) {
      window_ = own_.t / 2;
      own_ = pilot(body);
    }
    if (!own_.status) choice_.reason = own_.status.reason();
    return bool(own_.status);
  }

  double stable_step(const Body& body) {
    constexpr int n_lanczos = 24;
    constexpr double accuracy = 0.02;
    auto workspace = body.make_workspace();
    const auto frequency = mechanics::largest_frequency(body, state_, workspace, n_lanczos, accuracy);
    if (!frequency.status) choice_.reason = frequency.status.reason();
    const PolynomialSpace& space = body.space();
    const double rate = mechanics::affine_rate(space.affine_part(state_.q.head(space.n_unknowns())),
                                               space.affine_part(state_.v.head(space.n_unknowns())));
    return std::min(mechanics::rattle_step_limit(frequency.omega, rate, 1), window_);
  }

  /// Makes a pilot run over the window with n_steps_ steps, or with slightly more for equidistant samples. The
  /// constraint tolerance of the run is a fraction of the tolerance of Q, so that the iterations cost less.
  PilotRun pilot(const Body& body) {
    const mechanics::StepRequest request{.give_up = request_.give_up};
    constexpr long most = mechanics::detail::max_pilot_samples;
    const long n_steps = (n_steps_ + most - 1) / most, n_samples = (n_steps_ + n_steps - 1) / n_steps;
    const auto Q_of = [&](const BodyState& state) -> Eigen::Matrix3d {
      return body.space().affine_part(state.q.head(body.space().n_unknowns()));
    };
    PilotRun run = mechanics::detail::run_pilot<mechanics::Rattle>(
        body, body.with_points_of_body(state_), request, Q_of, window_, n_samples, n_steps, [&](auto& workspace) {
          if constexpr (requires { workspace.constraint_tolerance; })
            workspace.constraint_tolerance =
                std::max(workspace.constraint_tolerance, mechanics::detail::pilot_constraint * request_.tolerance *
                                                             std::min(1.0, window_ / request_.end));
        });
    choice_.n_force += run.n_force;
    return run;
  }

  BodySetup setup_;
  const BodyState& state_;
  const QuadratureRequest& request_;
  double window_;
  long n_steps_ = 1;
  PilotRun own_{};  ///< the pilot run of the body with the chosen points
  QuadratureChoice choice_{};
};

}  // namespace

template <class Body>
QuadratureChoice choose_quadrature(const BodySetup& setup, const Body& body, const BodyState& state,
                                   const QuadratureRequest& request) {
  return QuadratureSearch<Body>(setup, state, request).run(body);
}

template QuadratureChoice choose_quadrature(const BodySetup&, const IncompressibleBody&, const BodyState&,
                                            const QuadratureRequest&);
template QuadratureChoice choose_quadrature(const BodySetup&, const CompressibleBody&, const BodyState&,
                                            const QuadratureRequest&);

}  // namespace pseudorigid::polynomial
