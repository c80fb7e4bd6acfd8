/// References of the benchmark problems in __float128, by right-hand sides of their own (not the program's), at the
/// samples t_k. For each problem: `<name>.csv` with the time and the coordinates that benchmarks compare; the header
/// names the source and the difference between two step sizes, which is the reference's own error.
///
///   make_references DIRECTORY

#include <algorithm>
#include <array>
#include <boost/multiprecision/float128.hpp>
#include <cstdio>
#include <fstream>
#include <iomanip>
#include <string>
#include <vector>

#include "extrapolation.h"
#include "problem_data.h"

namespace {

using namespace pseudorigid::benchmarks;
using Real = boost::multiprecision::float128;
using std::array;

using Matrix = array<Real, 9>;  // by rows
using BodyState = array<Real, 18>;

BodyState body_at(double stretch, const array<double, 9>& L) {
  const array<Real, 3> axes{Real(stretch), Real(1), 1 / Real(stretch)};
  BodyState y{};
  for (int i = 0; i < 3; ++i) {
    y[4 * i] = axes[i];
    for (int j = 0; j < 3; ++j) y[9 + 3 * i + j] = axes[i] * Real(L[3 * i + j]);
  }
  return y;
}

Matrix cofactor(const Real* M) {
  Matrix C;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
      C[3 * i + j] = M[3 * a + c] * M[3 * b + d] - M[3 * a + d] * M[3 * b + c];
    }
  return C;
}

/// Q̈ = sC + f with C = cof Q and s such that det Q stays 1: C:Q̈ = tr((CᵀQ̇)²)/J.
BodyState constrained_rate(const BodyState& y, const Matrix& C, const Matrix& f) {
  const Real J = y[0] * C[0] + y[1] * C[1] + y[2] * C[2];
  Matrix P{};  // CᵀQ̇
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) P[3 * i + j] += C[3 * k + i] * y[9 + 3 * k + j];
  Real curvature = 0, of_force = 0, norm = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) curvature += P[3 * i + j] * P[3 * j + i];
  for (int i = 0; i < 9; ++i) {
    of_force += C[i] * f[i];
    norm += C[i] * C[i];
  }
  const Real s = (curvature / J - of_force) / norm;
  BodyState rate;
  for (int i = 0; i < 9; ++i) {
    rate[i] = y[9 + i];
    rate[9 + i] = s * C[i] + f[i];
  }
  return rate;
}

/// Q̈ = −κQ + λQ⁻ᵀ on SL(3): the part of the stress along Q⁻ᵀ is the multiplier's. y = (Q, Q̇) by rows.
struct Sl3 {
  static constexpr const char* name = "sl3";
  static constexpr const char* columns = "Q11,Q12,Q13,Q21,Q22,Q23,Q31,Q32,Q33,V11,V12,V13,V21,V22,V23,V31,V32,V33";
  using Y = BodyState;

  static Y initial() { return body_at(sl3::stretch, sl3::L); }
  Y operator()(const Y& y) const {
    Matrix f;
    for (int i = 0; i < 9; ++i) f[i] = -Real(sl3::kappa) * y[i];
    return constrained_rate(y, cofactor(y.data()), f);
  }
  static std::vector<Real> coordinates(const Y& y) { return {y.begin(), y.end()}; }
};

/// Euler's equation AΩ̇ = AΩ × Ω with Ṙ = RΩ×. y = (R by rows, Ω).
struct RigidBody {
  static constexpr const char* name = "rigid_body";
  static constexpr const char* columns = "R11,R12,R13,R21,R22,R23,R31,R32,R33,Omega1,Omega2,Omega3";
  using Y = array<Real, 12>;

  static Y initial() {
    Y y{};
    y[0] = y[4] = y[8] = 1;
    for (int i = 0; i < 3; ++i) y[9 + i] = Real(rigid_body::Omega[i]);
    return y;
  }
  Y operator()(const Y& y) const {
    Y rate;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      rate[9 + i] = (Real(rigid_body::A[j]) - Real(rigid_body::A[k])) / Real(rigid_body::A[i]) * y[9 + j] * y[9 + k];
      for (int row = 0; row < 3; ++row)  // column i of RΩ×
        rate[3 * row + i] = y[3 * row + j] * y[9 + k] - y[3 * row + k] * y[9 + j];
    }
    return rate;
  }
  static std::vector<Real> coordinates(const Y& y) { return {y.begin(), y.end()}; }
};

/// (5.44), with the right sign, and (5.45) at m = l = g = 1. y = (θ, φ, θ̇, φ̇).
struct DoublePendulum {
  static constexpr const char* name = "double_pendulum";
  static constexpr const char* columns = "x1,y1,x2,y2,vx1,vy1,vx2,vy2";
  using Y = array<Real, 4>;

  static Y initial() { return {Real(double_pendulum::theta), Real(double_pendulum::phi), 0, 0}; }
  Y operator()(const Y& y) const {
    const Real c = cos(y[0] - y[1]), s = sin(y[0] - y[1]);
    const Real r1 = -s * y[3] * y[3] - 2 * sin(y[0]), r2 = s * y[2] * y[2] - sin(y[1]);  // 2θ̈ + cφ̈ = r1, cθ̈ + φ̈ = r2
    const Real det = 2 - c * c;
    return {y[2], y[3], (r1 - c * r2) / det, (2 * r2 - c * r1) / det};
  }
  static std::vector<Real> coordinates(const Y& y) {
    const Real x1 = sin(y[0]), y1 = cos(y[0]), x2 = x1 + sin(y[1]), y2 = y1 + cos(y[1]);
    const Real u1 = y1 * y[2], w1 = -x1 * y[2];
    return {x1, y1, x2, y2, u1, w1, u1 + cos(y[1]) * y[3], w1 - sin(y[1]) * y[3]};
  }
};

/// The positive half of the rule of Gauss and Legendre with 2n nodes on [−1, 1].
template <int n>
struct HalfRule {
  array<Real, n> x, weight;
  HalfRule() {
    for (int i = 0; i < n; ++i) {
      Real y = cos(acos(Real(-1)) * (i + Real(3) / 4) / (2 * n + Real(1) / 2)), slope = 0;
      for (int iteration = 0; iteration < 9; ++iteration) {
        Real before = 1, P = y;
        for (int k = 1; k < 2 * n; ++k) {
          const Real next = ((2 * k + 1) * y * P - k * before) / (k + 1);
          before = P;
          P = next;
        }
        slope = 2 * n * (y * P - before) / (y * y - 1);
        y -= P / slope;
      }
      x[i] = y;
      weight[i] = 2 / ((1 - y * y) * slope * slope);
    }
  }
};

/// Q̈ = −(4/3) D Q + λQ⁻ᵀ. With s = A (1/w² − 1), A = ⅓ tr C,
///   D = 3A ∫₀¹ w² K⁻¹ det(K)^(−1/2) dw,  K = A + w²(C − A).
struct Gravitating {
  static constexpr const char* name = "gravitating";
  static constexpr const char* columns = Sl3::columns;
  using Y = BodyState;

  static Y initial() { return body_at(gravitating::stretch, gravitating::L); }
  Y operator()(const Y& y) const {
    static const HalfRule<24> rule;
    Matrix metric{}, D{}, f{};  // C, D
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k) metric[3 * i + j] += y[3 * i + k] * y[3 * j + k];
    const Real A = (metric[0] + metric[4] + metric[8]) / 3;
    for (std::size_t n = 0; n < rule.x.size(); ++n) {
      const Real w2 = rule.x[n] * rule.x[n];
      Matrix K;
      for (int i = 0; i < 9; ++i) K[i] = w2 * metric[i] + (i % 4 == 0 ? A - w2 * A : Real(0));
      const Matrix cof = cofactor(K.data());
      const Real det = K[0] * cof[0] + K[1] * cof[1] + K[2] * cof[2];
      const Real factor = 3 * A * rule.weight[n] * w2 / (det * sqrt(det));
      for (int i = 0; i < 9; ++i) D[i] += factor * cof[i];
    }
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k) f[3 * i + j] -= Real(4) / 3 * D[3 * i + k] * y[3 * k + j];
    return constrained_rate(y, cofactor(y.data()), f);
  }
  static std::vector<Real> coordinates(const Y& y) { return {y.begin(), y.end()}; }
};

template <class Problem>
std::vector<std::vector<Real>> samples(int n_steps) {  // steps between two samples
  auto y = Problem::initial();
  std::vector<std::vector<Real>> rows;
  const Real H = Real(end_time) / Real(n_samples) / n_steps;
  for (int k = 0; k < n_samples; ++k) {
    for (int i = 0; i < n_steps; ++i) extrapolated_step<12>(Problem{}, H, y);
    rows.push_back(Problem::coordinates(y));
  }
  return rows;
}

template <class Problem>
void write(const std::string& directory) {
  constexpr int n_steps = 10;
  const auto coarse = samples<Problem>(n_steps), rows = samples<Problem>(2 * n_steps);
  Real difference = 0;
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (std::size_t i = 0; i < rows[k].size(); ++i)
      difference = std::max(difference, Real(abs(rows[k][i] - coarse[k][i])));

  std::ofstream file(directory + "/" + Problem::name + ".csv");
  file << "# make_references: midpoint extrapolation of order 24 in __float128, step "
       << end_time / n_samples / (2 * n_steps) << "; greatest difference to the double step " << std::setprecision(2)
       << difference << "\n"
       << "time," << Problem::columns << "\n"
       << std::setprecision(25);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    file << end_time / n_samples * static_cast<double>(k + 1);
    for (const Real& x : rows[k]) file << "," << x;
    file << "\n";
  }
  std::printf("%s: own error below %.1e\n", Problem::name, static_cast<double>(difference));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "make_references DIRECTORY\n");
    return 2;
  }
  write<Sl3>(argv[1]);
  write<RigidBody>(argv[1]);
  write<DoublePendulum>(argv[1]);
  write<Gravitating>(argv[1]);
}
