#pragma once
/// Eight incompressible pseudo-rigid bodies as one system, one body in each lane of a SIMD vector. The equations of
/// motion of the bodies (pseudo_rigid_body.h) are independent. A vector of the system contains the entries of Q for all
/// eight bodies, and a multiplier contains eight numbers. Methods with a fixed step can integrate this system like a
/// single body. All bodies have the same step, and an iteration ends when the largest of the eight residuals is small
/// enough.
///
/// The bodies have one material law, and each body has its own inertia.

#include <cmath>

#include "materials/law_table.h"
#include "materials/tensor.h"
#include "mechanics/core/constrained_system.h"
#include "mechanics/core/lanes.h"
#include "reduced/motions_in_lanes.h"

namespace pseudorigid::reduced {

using BodyLanes = mechanics::Lanes<n_body_lanes>;

/// One number for each body.
struct EightNumbers {
  BodyLanes x{0.0};
};

/// One matrix for each body.
struct EightMatrices {
  static constexpr int n_entries = 9;
  BodyLanes x[n_entries];

  EightMatrices() {
    for (BodyLanes& entry : x) entry = 0.0;
  }

  static constexpr Eigen::Index size() { return n_entries * n_body_lanes; }
  double* data() { return reinterpret_cast<double*>(x); }
  const double* data() const { return reinterpret_cast<const double*>(x); }

  double squaredNorm() const {
    BodyLanes sum = 0.0;
    for (const BodyLanes& entry : x) sum += entry * entry;
    return sum.sum(n_body_lanes);
  }
  double norm() const { return std::sqrt(squaredNorm()); }

  friend EightMatrices operator+(EightMatrices A, const EightMatrices& B) {
    for (int i = 0; i < n_entries; ++i) A.x[i] += B.x[i];
    return A;
  }
  friend EightMatrices operator*(double s, EightMatrices A) {
    for (BodyLanes& entry : A.x) entry = s * entry;
    return A;
  }
  EightMatrices& operator-=(const EightMatrices& B) {
    for (int i = 0; i < n_entries; ++i) x[i] = x[i] - B.x[i];
    return *this;
  }
};

/// The largest number of the eight lanes of `a`, or NaN if a lane is NaN.
[[gnu::always_inline]] inline double greatest(BodyLanes a) {
  const auto of_two = [](auto u, auto v) { return (u > v) | (u != u) ? u : v; };
  const auto four =
      of_two(__builtin_shufflevector(a.v, a.v, 0, 1, 2, 3), __builtin_shufflevector(a.v, a.v, 4, 5, 6, 7));
  const auto two = of_two(__builtin_shufflevector(four, four, 0, 1), __builtin_shufflevector(four, four, 2, 3));
  return two[0] > two[1] || two[0] != two[0] ? two[0] : two[1];
}

[[gnu::always_inline]] inline BodyLanes absolute(BodyLanes a) { return a.v < 0.0 ? -a.v : a.v; }

/// Returns ln J in each lane, for J > 0. The result uses the series of materials::log_near_one if |J − 1| ≤ 2⁻¹¹ in all
/// lanes.
[[gnu::always_inline]] inline BodyLanes log_near_one(BodyLanes J) {
  const BodyLanes delta = J - 1.0;
  if (!(greatest(absolute(delta)) <= 0x1p-11)) return log(J);
  return delta - delta * delta * (1.0 / 2 - delta * (1.0 / 3 - delta * (1.0 / 4 - delta * (1.0 / 5))));
}

}  // namespace pseudorigid::reduced

namespace pseudorigid::mechanics {

template <>
struct VectorSpace<reduced::EightMatrices> {
  using V = reduced::EightMatrices;
  static constexpr bool dense = true, compensated = true;
  /// Adds a x + c to y, and sets c to the rounding error of this sum.
  [[gnu::always_inline]] static void add(double a, const V& x, V& y, V& c) {
    for (int i = 0; i < V::n_entries; ++i) {
      const auto t = a * x.x[i].v + c.x[i].v, y_old = y.x[i].v, sum = y_old + t, t_rounded = sum - y_old;
      c.x[i] = (y_old - (sum - t_rounded)) + (t - t_rounded);
      y.x[i] = sum;
    }
  }
  [[gnu::always_inline]] static void axpy(double a, const V& x, V& y) {
    for (int i = 0; i < V::n_entries; ++i) y.x[i] += a * x.x[i];
  }
  [[gnu::always_inline]] static void scale(double a, V& x) {
    for (auto& entry : x.x) entry = a == 0 ? reduced::BodyLanes(0.0) : a * entry;
  }
  /// Adds a x + b z to y.
  [[gnu::always_inline]] static void add_both(double a, const V& x, double b, const V& z, V& y) {
    for (int i = 0; i < V::n_entries; ++i) y.x[i] += a * x.x[i] + b * z.x[i];
  }
  static double max_norm(const V& x) {
    double largest = 0;
    for (const auto& entry : x.x)
      if (const double m = reduced::greatest(reduced::absolute(entry)); !(m <= largest)) largest = m;
    return largest;
  }
  static std::span<double> local_values(V& x) { return {x.data(), static_cast<std::size_t>(V::size())}; }
};

template <>
struct VectorSpace<reduced::EightNumbers> {
  using V = reduced::EightNumbers;
  static void axpy(double a, const V& x, V& y) { y.x += a * x.x; }
  static void scale(double a, V& x) { x.x = a * x.x; }
  static double max_norm(const V& x) { return reduced::greatest(reduced::absolute(x.x)); }
  static std::span<double> local_values(V& x) {
    return {reinterpret_cast<double*>(&x.x), static_cast<std::size_t>(reduced::n_body_lanes)};
  }
};

}  // namespace pseudorigid::mechanics

namespace pseudorigid::reduced {

class EightBodies {
 public:
  using Vector = EightMatrices;
  using Multiplier = EightNumbers;
  struct Workspace {};
  static constexpr int n_constraints = n_body_lanes;

  EightBodies(const materials::AnyLaw& law, const InertiaInLanes& inertia) : law_(law) {
    isotropic_ = inertia.isotropic;
    load(inertia.volume.data(), volume_);
    for (int i = 0; i < 9; ++i) load(inertia.E0_inverse.data() + i * n_body_lanes, E0_inverse_(i / 3, i % 3));
    stress_ = std::visit([]<class Law>(const Law&) { return &stress_of<Law>; }, law_);
  }

  /// Sets f to −∂V/∂Q of each body, with the elastic energy V. Fails if the law does not admit the deformation of one
  /// of the bodies.
  mechanics::Status force(double, const Vector& Q, const Vector&, Workspace&, Vector& f) const {
    Tensor P;
    if (!stress_(law_, tensor(Q), P)) return beyond_limit();
    set(materials::entrywise([this](const BodyLanes& p) { return -(volume_ * p); }, P), f);
    return {};
  }
  void apply_inverse_mass(const Vector& f, Vector& a) const { set(by_inverse_inertia(tensor(f)), a); }

  /// Sets g to ln det Q of each body, or to NaN if det Q is not positive. No iteration accepts NaN as converged, so the
  /// step then fails.
  mechanics::Status constraint(const Vector& Q, Multiplier& g) const {
    const BodyLanes J = materials::determinant(tensor(Q));
    g.x = J.v > 0.0 ? log_near_one(J).v : BodyLanes(std::numeric_limits<double>::quiet_NaN()).v;
    return {};
  }
  void constraint_rate(const Vector& Q, const Vector& v, Multiplier& r) const {
    const Tensor q = tensor(Q), cof = materials::cofactor(q);
    r.x = materials::dot(cof, tensor(v)) / materials::determinant(q, cof);
  }
  void constraint_curvature(const Vector& Q, const Vector& v, Multiplier& r) const {
    const Tensor q = tensor(Q), cof = materials::cofactor(q);
    const BodyLanes J = materials::determinant(q, cof);
    r.x = -(materials::trace_of_square(materials::transposed_product(cof, tensor(v))) / (J * J));
  }
  void add_reaction(const Vector& Q, const Multiplier& lambda, Vector& f) const {
    const Tensor q = tensor(Q), cof = materials::cofactor(q);
    const BodyLanes s = lambda.x / materials::determinant(q, cof);
    set(materials::entrywise([&](const BodyLanes& a, const BodyLanes& c) { return a + s * c; }, tensor(f), cof), f);
  }
  mechanics::SolveReport solve_gram(const Vector& Q1, const Vector& Q0, const Multiplier& r, Workspace&,
                                    Multiplier& lambda) const {
    const Tensor q1 = tensor(Q1), cof1 = materials::cofactor(q1), q0 = tensor(Q0), cof0 = materials::cofactor(q0);
    lambda.x = r.x * (materials::determinant(q1, cof1) * materials::determinant(q0, cof0)) /
               materials::dot(cof1, by_inverse_inertia(cof0));
    return {};
  }
  /// Returns twice the tolerance of a single body, because the residual is the largest of eight residuals, each at
  /// round-off.
  double constraint_tolerance() const { return 8e-16; }

  Vector make_vector() const { return {}; }
  Multiplier make_multiplier() const { return {}; }
  Workspace make_workspace() const { return {}; }

 private:
  using Tensor = materials::Tensor<BodyLanes>;
  /// A function that sets its last argument to the stress P(F) of the eight bodies. It returns false if the law does
  /// not admit the deformation F of one of the bodies.
  using Stress = bool (*)(const materials::AnyLaw&, const Tensor&, Tensor&);

  template <class Law>
  static bool stress_of(const materials::AnyLaw& any, const Tensor& F, Tensor& P) {
    const Law& law = *std::get_if<Law>(&any);
    P = law.stress(F);
    if constexpr (materials::is_limited<Law>) return law.reserve(F).least(n_body_lanes) > 0;
    return true;
  }

  static void load(const double* values, BodyLanes& lanes) {
    lanes = BodyLanes::of([&](int lane) { return values[lane]; });
  }
  [[gnu::always_inline]] static Tensor tensor(const Vector& Q) {
    return {{{Q.x[0], Q.x[1], Q.x[2]}, {Q.x[3], Q.x[4], Q.x[5]}, {Q.x[6], Q.x[7], Q.x[8]}}};
  }
  [[gnu::always_inline]] static void set(const Tensor& A, Vector& Q) {
    for (int i = 0; i < 9; ++i) Q.x[i] = A(i / 3, i % 3);
  }
  [[gnu::always_inline]] Tensor by_inverse_inertia(const Tensor& A) const {
    if (isotropic_) return E0_inverse_(0, 0) * A;
    return materials::product(A, E0_inverse_);
  }
  [[gnu::cold, gnu::noinline]] mechanics::Status beyond_limit() const {
    return mechanics::Status::failure(materials::beyond_limit(materials::limit_of(law_)));
  }

  materials::AnyLaw law_;
  Stress stress_;
  BodyLanes volume_;
  Tensor E0_inverse_;
  bool isotropic_;  // true if E₀ is a multiple of Id for all bodies
};

}  // namespace pseudorigid::reduced
