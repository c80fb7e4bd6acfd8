/// The nonlinear release of the ball (benchmarks/ball_release.py) by the implicit midpoint rule inside the program:
///
///   implicit_midpoint [--quick] > implicit_midpoint.csv
///
/// The rule is that of benchmarks/peers/release.py, so the difference from FEniCSx is the implementation. The
/// difference from ball_release.csv is the method. With the mass M, the forces f, the constraint g, G = Dg, and a step
/// h,
///
///   (2/h²) M (q¹ − q⁰ − h v⁰) = f(qᵐ) + G(qᵐ)ᵀλ,   qᵐ = (q⁰ + q¹)/2,   g(q¹) = 0,   v¹ = 2(q¹ − q⁰)/h − v⁰,
///
/// or five such steps, composed to order 4 (Suzuki). r is the difference of the right side and the left side.
/// With the stiffness K, a modified Newton iteration for (q¹, λ) is
///
///   δq = B⁻¹(2r − γGᵀg(q¹)),   δλ = −(γ/2)(g(q¹) + G δq),   B = K + (4/h²) M + γGᵀG.
///
/// It converges like Newton's iteration divided by a factor of the order of γ (augmented Lagrangian). B, and the
/// position of G, are kept until an iteration converges slowly. B is condensed to the unknowns between cells
/// (modes/parity_sector.h). Guesses are extrapolated from the last four steps. γ was chosen by hand: 10³ to 10⁶ times
/// the stiffness took the same number of iterations.
///
/// Columns: degree, refinements, scheme, step, unknowns, seconds (processor time from the first force to the last
/// sample; median of three runs, or of as many as 10 seconds hold), error (largest difference of Q33 over the 50
/// samples), iterations_per_step, factorizations, seconds_in_factors (part of the seconds).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "continuum/body/elastic_ball.h"
#include "continuum/modes/cell_stiffness.h"
#include "continuum/modes/linear_problem.h"
#include "continuum/modes/parity_sector.h"
#include "measuring.h"

namespace {

using namespace pseudorigid;
using namespace pseudorigid::continuum;
using benchmarks::cpu_seconds;
using benchmarks::require;

constexpr double end_time = 5, tolerance = 1e-7, slow = 0.5, relative_penalty = 1e4;
constexpr int n_samples = 50, max_iterations = 30;

/// The matrix B at a position q, with its factors, and G at this position.
class StepMatrix : public LinearProblem {
 public:
  StepMatrix(const ElasticBall& ball, const StoredEnergy& stored, const Vector& q, const Vector& lambda, double h)
      : LinearProblem(ball.space(), true, 4 / (h * h), relative_penalty / 1e4 * (1 + 4 / (h * h))), at(q) {
    const CellKernels& kernels = ball.kernels();
    set_constraint(kernels, q);
    const CellStiffness cells(space);
    std::vector<double> pressure(space.nodes_per_cell(), 0);
    set_stiffness([&](unsigned int cell) {
      kernels.multiplier_at_points(lambda, cell, pressure);
      return cells.cell_matrix(cell, q, [&](int point, const materials::Tensor<double>& F) {
        return tangent_at(stored, F, pressure[static_cast<std::size_t>(point)]);
      });
    });
    sector = std::make_unique<ParitySector>(*this, parity_of_sector(0));
    require(sector->factorize());
  }

  Vector at;
  std::unique_ptr<ParitySector> sector;
};

/// Position and multiplier of a step's end.
struct Unknowns {
  Vector q, lambda;
};

/// Weights of the extrapolation from the last n values, the latest first, by n.
constexpr std::array<std::array<double, 4>, 5> cubic{{{}, {1}, {2, -1}, {3, -3, 1}, {4, -6, 4, -1}}};

class Motion {
 public:
  Motion(const ElasticBall& ball, const StoredEnergy& stored)
      : ball_(ball),
        stored_(stored),
        workspace_(ball.make_workspace()),
        q_(ball.affine_field(Eigen::Matrix3d::Identity())),
        v_(ball.affine_field(Eigen::Vector3d(0.3, 0.3, -0.6).asDiagonal())) {}

  /// Makes a step of size h, the step number `place` of a composition. False if the iteration does not converge.
  bool step(double h, int place) {
    Vector moved = q_;
    moved.add(h, v_);
    auto& past = past_[place];
    Unknowns z{moved, ball_.make_multiplier()};
    for (std::size_t i = 0; i < past.size(); ++i) {
      z.q.add(cubic[past.size()][i], past[i].q);
      z.lambda.add(cubic[past.size()][i], past[i].lambda);
    }
    double before = HUGE_VAL, change = HUGE_VAL;
    for (int i = 0; i < max_iterations && !(change < tolerance); ++i) {
      auto& factors = factors_[h];
      if (!factors) {
        const double start = cpu_seconds();
        Vector middle = q_;
        middle.sadd(0.5, 0.5, z.q);
        factors = std::make_unique<StepMatrix>(ball_, stored_, middle, z.lambda, h);
        ++n_factorizations;
        seconds_in_factors += cpu_seconds() - start;
        before = HUGE_VAL;
      }
      change = correct(h, moved, *factors, z);
      ++n_iterations;
      if (!std::isfinite(change)) {  // the guess or an iterate is not admissible
        z = {moved, past.empty() ? ball_.make_multiplier() : past.front().lambda};
        factors.reset();
        continue;
      }
      if (change >= tolerance && change > slow * before) factors.reset();
      before = change;
    }
    if (!(change < tolerance)) return false;
    ++n_steps;
    if (past.size() == 4) past.pop_back();
    past.insert(past.begin(), {z.q, z.lambda});
    past.front().q -= moved;
    Vector v = z.q;
    v -= q_;
    v_.sadd(-1, 2 / h, v);
    q_ = z.q;
    return true;
  }

  double Q33() const { return ball_.mass_moment(q_)(2, 2); }

  long n_iterations = 0, n_factorizations = 0, n_steps = 0;
  double seconds_in_factors = 0;

 private:
  /// One modified Newton iteration. Returns the largest change of a coordinate, or infinity if a force or the
  /// constraint fails.
  double correct(double h, const Vector& moved, const StepMatrix& factors, Unknowns& z) {
    const double gamma = factors.penalty;
    Vector middle = q_, f = ball_.make_vector(), inertia = z.q, g = ball_.make_multiplier(), rate = g;
    middle.sadd(0.5, 0.5, z.q);
    if (!ball_.force_with_reaction(0, middle, v_, z.lambda, workspace_, f) || !ball_.constraint(z.q, g))
      return HUGE_VAL;
    inertia -= moved;
    ball_.apply_mass(inertia, inertia);
    f.sadd(2, -4 / (h * h), inertia);
    Vector of_constraint = g;
    of_constraint *= -gamma;
    ball_.kernels().add_reaction(factors.at, of_constraint, f);
    Eigen::VectorXd u = factors.sector->entries_of(f);
    factors.sector->solve_penalized<1>(u);
    const Vector dq = factors.sector->field_of(u);
    ball_.kernels().constraint_rate(factors.at, dq, rate);
    z.q += dq;
    z.lambda.add(-gamma / 2, g, -gamma / 2, rate);
    return u.cwiseAbs().maxCoeff();
  }

  const ElasticBall& ball_;
  const StoredEnergy& stored_;
  ElasticBall::Workspace workspace_;
  Vector q_, v_;
  std::map<double, std::unique_ptr<StepMatrix>> factors_;
  std::map<int, std::vector<Unknowns>> past_;  ///< ends of the last steps minus q⁰ + h v⁰, the latest first
};

struct Scheme {
  const char* name;
  std::vector<double> weights;
};
const double suzuki = 1 / (4 - std::cbrt(4.0));
const Scheme midpoint{"midpoint", {1}};
const Scheme order_4{"\"midpoint, order 4\"", {suzuki, suzuki, 1 - 4 * suzuki, suzuki, suzuki}};

/// A mesh and a scheme with its numbers of steps between two samples; the jobs of benchmarks/peers/fenicsx_release.py.
struct Job {
  int degree, n_refinements;
  const Scheme& scheme;
  std::vector<int> n_steps;
};
const std::vector<Job> jobs{{3, 0, midpoint, {2, 4, 8}}, {3, 0, order_4, {1}},       {4, 0, midpoint, {4, 8, 16, 32}},
                            {4, 0, order_4, {1, 2}},     {3, 1, order_4, {1, 2, 3}}, {5, 0, midpoint, {32}},
                            {5, 0, order_4, {1, 2, 3}},  {4, 1, order_4, {1, 2, 3}}, {5, 1, order_4, {2, 3}}};
const std::vector<Job> quick_jobs{{3, 0, midpoint, {4}}, {4, 0, midpoint, {8}}, {4, 0, order_4, {1}}};

std::vector<double> reference() {
  std::ifstream file(PSEUDORIGID_REFERENCES "/ball_release.csv");
  std::vector<double> values;
  for (std::string line; std::getline(file, line);)
    if (std::isdigit(line.front())) values.push_back(std::stod(line.substr(line.find(',') + 1)));
  return values;
}

void measure(const Job& job, int n_rounds, const std::vector<double>& exact) {
  const StoredEnergy stored = materials::CiarletGeymonat{1, 0};
  const ElasticBall ball({{true, true, true}}, job.degree, job.n_refinements, stored);
  for (const int n_steps : job.n_steps) {
    const double h = end_time / n_samples / n_steps;
    std::vector<double> seconds;
    double error = 0, total = 0;
    std::unique_ptr<Motion> motion;
    while (static_cast<int>(seconds.size()) < n_rounds && total < 10) {
      motion = std::make_unique<Motion>(ball, stored);
      error = 0;
      bool converges = true;
      const double start = cpu_seconds();
      for (std::size_t sample = 1; sample <= n_samples && converges; ++sample) {
        for (int i = 0; i < n_steps && converges; ++i)
          for (std::size_t place = 0; place < job.scheme.weights.size() && converges; ++place)
            converges = motion->step(job.scheme.weights[place] * h, static_cast<int>(place));
        error = std::max(error, std::abs(motion->Q33() - exact.at(sample)));
      }
      if (!converges) {
        std::fprintf(stderr, "degree %d refined %d, %s, %d steps: no convergence\n", job.degree, job.n_refinements,
                     job.scheme.name, n_steps);
        break;
      }
      seconds.push_back(cpu_seconds() - start);
      total += seconds.back();
    }
    if (seconds.empty()) continue;
    std::printf("%d,%d,%s,%.4g,%zu,%.4g,%.3g,%.1f,%ld,%.3g\n", job.degree, job.n_refinements, job.scheme.name, h,
                3 * ball.space().n_global_nodes() + ball.space().n_global_cells() * ball.space().n_pressure(),
                benchmarks::median(seconds), error,
                static_cast<double>(motion->n_iterations) / static_cast<double>(motion->n_steps),
                motion->n_factorizations, motion->seconds_in_factors);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const bool quick = argc > 1 && std::string_view(argv[1]) == "--quick";
  if (argc > 1 + quick) {
    std::fprintf(stderr, "implicit_midpoint [--quick]\n");
    return 2;
  }
  const std::vector<double> exact = reference();
  std::printf(
      "degree,refinements,scheme,step,unknowns,seconds,error,iterations_per_step,factorizations,"
      "seconds_in_factors\n");
  for (const Job& job : quick ? quick_jobs : jobs) measure(job, quick ? 1 : 3, exact);
}
