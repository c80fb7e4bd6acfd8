/// A spherical pendulum of unit mass, length and gravity, by RATTLE composed to order 8:
///
///   q̈ = −e_z + λ q,   ½(|q|² − 1) = 0.

#include <pseudorigid/mechanics/methods/composition.h>
#include <cmath>
#include <cstdio>

using namespace pseudorigid::mechanics;

struct SphericalPendulum {
  using Vector = Eigen::Vector3d;
  using Multiplier = double;
  struct Workspace {};
  static constexpr int n_constraints = 1;

  Status force(double, const Vector&, const Vector&, Workspace&, Vector& f) const {
    return f = -Vector::UnitZ(), Status();
  }
  void apply_inverse_mass(const Vector& f, Vector& a) const { a = f; }
  Status constraint(const Vector& q, double& g) const { return g = (q.squaredNorm() - 1) / 2, Status(); }
  void constraint_rate(const Vector& q, const Vector& v, double& r) const { r = q.dot(v); }
  void constraint_curvature(const Vector&, const Vector& v, double& r) const { r = v.squaredNorm(); }
  void add_reaction(const Vector& q, double lambda, Vector& f) const { f += lambda * q; }
  SolveReport solve_gram(const Vector& q1, const Vector& q0, double r, Workspace&, double& lambda) const {
    return lambda = r / q1.dot(q0), SolveReport();
  }
  double constraint_tolerance() const { return 4e-16; }
  Vector make_vector() const { return Vector::Zero(); }
  double make_multiplier() const { return 0; }
  Workspace make_workspace() const { return {}; }
};

int main() {
  const SphericalPendulum pendulum;
  State<SphericalPendulum> state{0, {1, 0, 0}, {0, 0.8, 0}};  // horizontal, pushed sideways
  Rattle8::Workspace<SphericalPendulum> workspace(pendulum);
  for (int step = 1; step <= 1000; ++step) {
    Status status = Rattle8::advance(pendulum, 0.1, state, workspace);
    if (status && step % 100 == 0) status = Rattle8::project_velocity(pendulum, state, workspace);
    if (!status) return std::fprintf(stderr, "%s\n", status.reason().c_str()), 1;
    if (step % 100 == 0)
      std::printf("t = %5.1f  q = (%9.6f, %9.6f, %9.6f)  |q| - 1 = %8.1e  energy %19.16f  momentum %.16f\n", state.t,
                  state.q.x(), state.q.y(), state.q.z(), state.q.norm() - 1, state.v.squaredNorm() / 2 + state.q.z(),
                  state.q.x() * state.v.y() - state.q.y() * state.v.x());
  }
}
