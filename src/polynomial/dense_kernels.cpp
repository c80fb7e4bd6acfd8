#include "polynomial/dense_kernels.h"

#include <cmath>
#include <limits>
#include <type_traits>
#include <variant>

#include "materials/volumetric_energy.h"
#include "polynomial/branch_loops.h"

namespace pseudorigid::polynomial {
namespace {

[[gnu::always_inline]] inline Tensor transposed(const Tensor& A) {
  return {{{A(0, 0), A(1, 0), A(2, 0)}, {A(0, 1), A(1, 1), A(2, 1)}, {A(0, 2), A(1, 2), A(2, 2)}}};
}

/// Computes n_vectors SIMD vectors of y = Σ_a c_a T_a, from the entry `first` on. T_a is row a of the table.
template <int n_vectors>
[[gnu::always_inline]] inline void combine_block(const double* table, int n, int length, const double* c, double* y,
                                                 int first) {
  L sums[n_vectors];
  for (L& sum : sums) sum = 0;
  for (int a = 0; a < n; ++a) {
    const double* row = table + static_cast<long>(a) * length + first;
    const L factor = c[a];
    for (int k = 0; k < n_vectors; ++k) sums[k] += factor * load(row + k * n_lanes);
  }
  for (int k = 0; k < n_vectors; ++k) store(sums[k], y + first + k * n_lanes);
}

/// Adds Σ_e T_ae y_e to the n_rows coefficients c_a, a = first, first + 1, …
template <int n_rows>
[[gnu::always_inline]] inline void contract_rows(const double* table, int length, const double* y, double* c,
                                                 int first) {
  L sums[n_rows];
  for (L& sum : sums) sum = 0;
  for (int e = 0; e < length; e += n_lanes) {
    const L value = load(y + e);
    for (int k = 0; k < n_rows; ++k) sums[k] += value * load(table + static_cast<long>(first + k) * length + e);
  }
  for (int k = 0; k < n_rows; ++k) c[first + k] += sums[k].sum(n_lanes);
}

/// The arguments of `multiply`.
struct Product {
  const double* A;
  int stride;
  const double* R;
  int n_points, width;
  double* C;
  bool add;
};

/// Computes n_rows rows and n_vectors SIMD vectors of columns of C, from the entry (row, column) on.
template <int n_rows, int n_vectors>
[[gnu::always_inline]] inline void multiply_block(const Product& of, int row, int column) {
  double* C = of.C + static_cast<long>(row) * of.width + column;
  L sums[n_rows][n_vectors];
  for (int i = 0; i < n_rows; ++i)
    for (int k = 0; k < n_vectors; ++k)
      sums[i][k] = of.add ? load(C + static_cast<long>(i) * of.width + k * n_lanes) : L(0.0);
  const double* A = of.A + static_cast<long>(row) * of.stride;
  for (int p = 0; p < of.n_points; ++p) {
    const double* at = of.R + static_cast<long>(p) * of.width + column;
    L r[n_vectors];
    for (int k = 0; k < n_vectors; ++k) r[k] = load(at + k * n_lanes);
    for (int i = 0; i < n_rows; ++i) {
      const L a = A[static_cast<long>(i) * of.stride + p];
      for (int k = 0; k < n_vectors; ++k) sums[i][k] += a * r[k];
    }
  }
  for (int i = 0; i < n_rows; ++i)
    for (int k = 0; k < n_vectors; ++k) store(sums[i][k], C + static_cast<long>(i) * of.width + k * n_lanes);
}

template <int n_rows>
void multiply_rows(const Product& of, int row) {
  constexpr int n_vectors = 2;
  int column = 0;
  for (; column + n_vectors * n_lanes <= of.width; column += n_vectors * n_lanes)
    multiply_block<n_rows, n_vectors>(of, row, column);
  for (; column < of.width; column += n_lanes) multiply_block<n_rows, 1>(of, row, column);
}

/// Number of rows that are computed at a time. Each row needs two SIMD registers for its sums. There are 32 registers
/// with AVX-512, and otherwise 16.
constexpr int max_rows = n_lanes == 8 ? 8 : 4;

/// Calls multiply_rows<n>(of, row) for a number n of rows that is known only at run time. n must be between 1 and
/// n_rows.
template <int n_rows = max_rows>
void multiply_some_rows(const Product& of, int row, int n) {
  if (n == n_rows)
    multiply_rows<n_rows>(of, row);
  else if constexpr (n_rows > 1)
    multiply_some_rows<n_rows - 1>(of, row, n);
}

/// Calls visitor(law, p) for the first point p of every SIMD vector of the n points. The type of `law` is then known.
template <class Visitor>
void for_each_vector(const materials::AnyLaw& law, int n, Visitor&& visitor) {
  std::visit(
      [&](const auto& known) {
        for (int p = 0; p < n; p += n_lanes) visitor(known, p);
      },
      law);
}

/// The stress ∂U/∂F of the volumetric stabilisation U (materials/volumetric_energy.h).
[[gnu::always_inline]] inline Tensor volumetric_stress(double kappa, const Tensor& F) {
  const Tensor cof = materials::cofactor(F);
  return materials::volumetric_pressure(kappa, materials::determinant(F, cof)) * cof;
}
/// The rate of the stress ∂U/∂F of `volumetric_stress` along H.
[[gnu::always_inline]] inline Tensor volumetric_stress_rate(double kappa, const Tensor& F, const Tensor& H) {
  const Tensor cof = materials::cofactor(F);
  const L J = materials::determinant(F, cof), rate = materials::dot(cof, H);
  return add(materials::volumetric_curvature(kappa, J) * rate * cof,
             materials::volumetric_pressure(kappa, J) * materials::cofactor_derivative(F, H));
}

void combine(const double* table, int n, int length, const double* c, double* y) {
  constexpr int n_vectors = 4;
  int first = 0;
  for (; first + n_vectors * n_lanes <= length; first += n_vectors * n_lanes)
    combine_block<n_vectors>(table, n, length, c, y, first);
  for (; first < length; first += n_lanes) combine_block<1>(table, n, length, c, y, first);
}

void contract(const double* table, int n, int length, const double* y, double* c) {
  constexpr int n_rows = 4;
  int a = 0;
  for (; a + n_rows <= n; a += n_rows) contract_rows<n_rows>(table, length, y, c, a);
  for (; a < n; ++a) contract_rows<1>(table, length, y, c, a);
}

void combine_radially(const double* A, int n_levels, int n_radii, int n, const double* c, double* u) {
  for (int j = 0; j < n_radii; ++j)
    for (int g = 0; g < n; g += n_lanes) {
      L sum = 0;
      for (int k = 0; k < n_levels; ++k)
        sum += load(A + (static_cast<long>(k) * n_radii + j) * n + g) * load(c + static_cast<long>(k) * n + g);
      store(sum, u + static_cast<long>(j) * n + g);
    }
}

void contract_radially(const double* A, int n_levels, int n_radii, int n, const double* u, double* c) {
  for (int k = 0; k < n_levels; ++k)
    for (int g = 0; g < n; g += n_lanes) {
      L sum = load(c + static_cast<long>(k) * n + g);
      for (int j = 0; j < n_radii; ++j)
        sum += load(A + (static_cast<long>(k) * n_radii + j) * n + g) * load(u + static_cast<long>(j) * n + g);
      store(sum, c + static_cast<long>(k) * n + g);
    }
}

/// Calls visitor(s, n) for pieces of n numbers from the index s on, which cover the range 0 … length. The pieces are
/// SIMD vectors, and the last vector may overlap the previous one. If `length` is less than a vector, the pieces are
/// single numbers.
template <class Visitor>
[[gnu::always_inline]] inline void for_each_piece(int length, Visitor&& visitor) {
  using Single = std::integral_constant<int, 1>;
  using Vector = std::integral_constant<int, n_lanes>;
  if (length < n_lanes) {
    for (int s = 0; s < length; ++s) visitor(s, Single());
    return;
  }
  int s = 0;
  for (; s + n_lanes <= length; s += n_lanes) visitor(s, Vector());
  if (s < length) visitor(length - n_lanes, Vector());
}
template <int n>
[[gnu::always_inline]] inline auto load_piece(const double* x) {
  if constexpr (n == 1)
    return *x;
  else
    return load(x);
}
template <int n>
[[gnu::always_inline]] inline void store_piece(const auto& value, double* x) {
  if constexpr (n == 1)
    *x = value;
  else
    store(value, x);
}

void fields_of_terms(const double* D, int n_radii, int n_directions, int width, const double* z, double* const* y) {
  const long term = static_cast<long>(n_radii) * width;
  for_each_piece(n_directions, [&]<int n>(int s, std::integral_constant<int, n>) {
    for (int f = 0; f < 3; ++f) {
      const double* row = D + 3L * f * width + s;
      const auto d0 = load_piece<n>(row), d1 = load_piece<n>(row + width), d2 = load_piece<n>(row + 2L * width);
      for (int j = 0; j < n_radii; ++j) {
        const double* at = z + static_cast<long>(j) * width + s;
        store_piece<n>(d0 * load_piece<n>(at) + d1 * load_piece<n>(at + term) + d2 * load_piece<n>(at + 2 * term),
                       y[f] + static_cast<long>(j) * n_directions + s);
      }
    }
  });
}

void terms_of_fields(const double* D, int n_radii, int n_directions, int width, const double* const* y, double* z) {
  const long term = static_cast<long>(n_radii) * n_directions;
  for_each_piece(n_directions, [&]<int n>(int s, std::integral_constant<int, n>) {
    for (int t = 0; t < 3; ++t) {
      const double* column = D + static_cast<long>(t) * width + s;
      const auto d0 = load_piece<n>(column), d1 = load_piece<n>(column + 3L * width),
                 d2 = load_piece<n>(column + 6L * width);
      for (int j = 0; j < n_radii; ++j) {
        const long at = static_cast<long>(j) * n_directions + s;
        store_piece<n>(d0 * load_piece<n>(y[0] + at) + d1 * load_piece<n>(y[1] + at) + d2 * load_piece<n>(y[2] + at),
                       z + t * term + at);
      }
    }
  });
}

/// Computes C ← A R, or C ← C + A R if `add` is true. The rows are divided into groups of at most `max_rows` rows. The
/// sizes of the groups differ by at most one.
void multiply(const double* A, int stride, int m, const double* R, int n_points, int width, double* C, bool add) {
  const Product of{A, stride, R, n_points, width, C, add};
  for (int n_parts = (m + max_rows - 1) / max_rows, row = 0; n_parts > 0; --n_parts) {
    const int n = (m - row + n_parts - 1) / n_parts;
    multiply_some_rows(of, row, n);
    row += n;
  }
}

void combine_at_points(const double* A0, const double* A1, const double* A2, const double* T, int n_points, int width,
                       double* R) {
  const long size = static_cast<long>(n_points) * width;
  for (int p = 0; p < n_points; ++p) {
    const L a0 = A0[p], a1 = A1[p], a2 = A2[p];
    for (int c = 0; c < width; c += n_lanes) {
      const double* at = T + static_cast<long>(p) * width + c;
      store(a0 * load(at) + a1 * load(at + size) + a2 * load(at + 2 * size), R + static_cast<long>(p) * width + c);
    }
  }
}

double stress(const materials::AnyLaw& law, double kappa, int n, const double* w, const double* F, double* T) {
  L least = std::numeric_limits<double>::infinity();
  for_each_vector(law, n, [&]<class Law>(const Law& known, int p) {
    const Tensor f = load(F, n, p);
    least = min(materials::determinant(f), least);
    if constexpr (materials::is_limited<Law>) least = min(known.reserve(f), least);
    Tensor P = known.stress(f);
    if (kappa != 0) P = add(P, volumetric_stress(kappa, f));
    store(load(w + p) * P, T, n, p);
  });
  return least.least(n_lanes);
}

void stress_rate(const materials::AnyLaw& law, double kappa, int n, const double* w, const double* F, const double* H,
                 double* T) {
  for_each_vector(law, n, [&](const auto& known, int p) {
    const Tensor f = load(F, n, p), h = load(H, n, p);
    Tensor P = known.tangent(f, h);
    if (kappa != 0) P = add(P, volumetric_stress_rate(kappa, f, h));
    store(load(w + p) * P, T, n, p);
  });
}

EnergySums energy(const materials::AnyLaw& law, double kappa, int n, const double* w, const double* F) {
  L elastic = 0, volumetric = 0;
  for_each_vector(law, n, [&](const auto& known, int p) {
    const Tensor f = load(F, n, p);
    elastic += load(w + p) * known.energy(f);
    if (kappa != 0) volumetric += load(w + p) * materials::volumetric_energy(kappa, materials::determinant(f));
  });
  return {elastic.sum(n_lanes), volumetric.sum(n_lanes)};
}

double log_jacobian(int n, const double* w, const double* F, double* y) {
  L least = std::numeric_limits<double>::infinity();
  for (int p = 0; p < n; p += n_lanes) {
    const L J = materials::determinant(load(F, n, p));
    least = min(J, least);
    store(load(w + p) * log1p(J - 1.0), y + p);
  }
  return least.least(n_lanes);
}

double jacobian(int n, const double* F, double* J) {
  L least = std::numeric_limits<double>::infinity();
  for (int p = 0; p < n; p += n_lanes) {
    const L det = materials::determinant(load(F, n, p));
    least = min(det, least);
    store(det, J + p);
  }
  return least.least(n_lanes);
}

void inverse_transposed(int n, const double* F, double* A) {
  for (int p = 0; p < n; p += n_lanes) {
    const Tensor f = load(F, n, p), cof = materials::cofactor(f);
    store(1.0 / materials::determinant(f, cof) * cof, A, n, p);
  }
}

void add_multiple(int n, const double* s, const double* A, double* T) {
  for (int p = 0; p < n; p += n_lanes) store(add(load(T, n, p), load(s + p) * load(A, n, p)), T, n, p);
}

void weighted_product(int n, const double* w, const double* A, const double* B, double* y) {
  for (int p = 0; p < n; p += n_lanes) store(load(w + p) * materials::dot(load(A, n, p), load(B, n, p)), y + p);
}

void weighted_curvature(int n, const double* w, const double* A, const double* B, double* y) {
  for (int p = 0; p < n; p += n_lanes) {
    const Tensor rate = materials::transposed_product(load(A, n, p), load(B, n, p));
    store(-(load(w + p) * materials::trace_of_square(rate)), y + p);
  }
}

void add_rate_of_inverse(int n, const double* s, const double* A, const double* B, double* T) {
  for (int p = 0; p < n; p += n_lanes) {
    const Tensor a = load(A, n, p), rate = materials::product(materials::product(a, transposed(load(B, n, p))), a);
    store(add(load(T, n, p), -load(s + p) * rate), T, n, p);
  }
}

double add_viscous_stress(int n, const double* w, double eta, const double* F, const double* A, const double* B,
                          double* T) {
  L power = 0;
  for (int p = 0; p < n; p += n_lanes) {
    const Tensor a = load(A, n, p), L_t = materials::product(a, transposed(load(B, n, p)));
    const Tensor d = L(0.5) * add(L_t, transposed(L_t));
    const L strength = load(w + p) * (2 * eta) * materials::determinant(load(F, n, p));
    power += strength * materials::dot(d, d);
    store(add(load(T, n, p), strength * materials::product(d, a)), T, n, p);
  }
  return power.sum(n_lanes);
}

void transform_images(double* slots, int n_images, int length) {
  for (int half = 1; half < n_images; half *= 2)
    for (int first = 0; first < n_images; first += 2 * half)
      for (int slot = first; slot < first + half; ++slot) {
        double *x = slots + static_cast<long>(slot) * length, *y = x + static_cast<long>(half) * length;
        for (int e = 0; e < length; e += n_lanes) {
          const L a = load(x + e), b = load(y + e);
          store(a + b, x + e);
          store(a - b, y + e);
        }
      }
}

}  // namespace
}  // namespace pseudorigid::polynomial

namespace polynomial = pseudorigid::polynomial;
extern const polynomial::DenseKernels PSEUDORIGID_KERNEL_TABLE{.combine = polynomial::combine,
                                                               .contract = polynomial::contract,
                                                               .combine_radially = polynomial::combine_radially,
                                                               .contract_radially = polynomial::contract_radially,
                                                               .fields_of_terms = polynomial::fields_of_terms,
                                                               .terms_of_fields = polynomial::terms_of_fields,
                                                               .multiply = polynomial::multiply,
                                                               .combine_at_points = polynomial::combine_at_points,
                                                               .stress = polynomial::stress,
                                                               .stress_rate = polynomial::stress_rate,
                                                               .energy = polynomial::energy,
                                                               .log_jacobian = polynomial::log_jacobian,
                                                               .jacobian = polynomial::jacobian,
                                                               .inverse_transposed = polynomial::inverse_transposed,
                                                               .add_multiple = polynomial::add_multiple,
                                                               .weighted_product = polynomial::weighted_product,
                                                               .weighted_curvature = polynomial::weighted_curvature,
                                                               .add_rate_of_inverse = polynomial::add_rate_of_inverse,
                                                               .add_viscous_stress = polynomial::add_viscous_stress,
                                                               .add_branch_stress = polynomial::add_branch_stress,
                                                               .branch_energy = polynomial::branch_energy,
                                                               .relax_branches = polynomial::relax_branches,
                                                               .transform_images = polynomial::transform_images};
