#pragma once
/// The inner loops of polynomial bodies, compiled for several instruction sets (mechanics/core/kernel_builds.h). The
/// loops are sums over functions at the points of a grid, transposed sums, and operations at the points. The arguments
/// are plain arrays.

#include "materials/law_table.h"
#include "materials/maxwell_branch.h"
#include "mechanics/core/kernel_builds.h"

namespace pseudorigid::polynomial {

/// Number of points in a block. It is a multiple of the number of lanes of every SIMD vector. The last block is padded
/// with points of weight 0. `filled_up` rounds n up to whole blocks.
inline constexpr int point_block = 8;
constexpr int filled_up(int n) { return (n + point_block - 1) / point_block * point_block; }

struct EnergySums {
  double elastic, volumetric;
};

struct DenseKernels {
  /// A table T has n rows of `length` numbers, one row T_a for each function a. `length` is a multiple of
  /// `point_block`.

  /// y_e = Σ_a c_a T_ae
  void (*combine)(const double* table, int n, int length, const double* c, double* y);
  /// c_a ← c_a + Σ_e T_ae y_e
  void (*contract)(const double* table, int n, int length, const double* y, double* c);

  /// Sums over radial functions A_kjg with level k and radius j, for n groups g at once. A group is a pair (l, m) of
  /// spherical harmonics, and level k has the functions of degree l + 2k (point_tables.h). A_kjg is stored at (k
  /// n_radii + j) n + g, c_kg at k n + g, and u_jg at j n + g. n is a multiple of `point_block`.

  /// u_jg = Σ_k A_kjg c_kg
  void (*combine_radially)(const double* A, int n_levels, int n_radii, int n, const double* c, double* u);
  /// c_kg ← c_kg + Σ_j A_kjg u_jg
  void (*contract_radially)(const double* A, int n_levels, int n_radii, int n, const double* u, double* c);

  /// Computes the fields y_f, f = 0, 1, 2, at the points with radius j and direction s. The terms z_t, t = 0, 1, 2, are
  /// the derivatives along e_r, e_θ and e_φ. Each term has n_radii · width numbers:
  ///   y_f[j n_directions + s] = Σ_t D_ft(s) z_t[j width + s].
  /// Each direction s has a 3 × 3 matrix, whose entries D_ft(s) are stored at (3f + t) width + s.
  void (*fields_of_terms)(const double* D, int n_radii, int n_directions, int width, const double* z, double* const* y);
  /// The transposed map: z_t[j n_directions + s] = Σ_f D_ft(s) y_f[j n_directions + s]. The terms z_t are stored one
  /// after the other, without padding.
  void (*terms_of_fields)(const double* D, int n_radii, int n_directions, int width, const double* const* y, double* z);

  /// C ← A R, or C ← C + A R if `add` is true. The matrices are row-major: A (m × n_points, with rows of `stride`
  /// numbers), R (n_points × width) and C (m × width). `width` is a multiple of `point_block`.
  void (*multiply)(const double* A, int stride, int m, const double* R, int n_points, int width, double* C, bool add);
  /// R_pa = Σ_k A_kp T_kpa with k = 0, 1, 2. T (3 × n_points × width) is row-major, so the functions a of a point p are
  /// contiguous. Each A_k has n_points numbers.
  void (*combine_at_points)(const double* A0, const double* A1, const double* A2, const double* T, int n_points,
                            int width, double* R);

  /// In the following functions, w[p] is the quadrature weight of point p of n points. The entry (i, j) of a 3×3 tensor
  /// at this point is stored at (3i + j) n + p.

  /// T ← w P(F) + w ∂U/∂F with the stress P of the law, J = det F and the volumetric stabilisation U = (κ/8)(J − 1/J)².
  /// Returns the least of det F over the points. For a law with limits, returns the least of det F and of the reserve
  /// (materials/law_limits.h).
  double (*stress)(const materials::AnyLaw& law, double kappa, int n, const double* w, const double* F, double* T);
  /// T ← w DP(F)[H] + w D²U(F)[H], the rate of the result of `stress` along H.
  void (*stress_rate)(const materials::AnyLaw& law, double kappa, int n, const double* w, const double* F,
                      const double* H, double* T);
  /// Returns Σ w W(F) and Σ w U(J), with the stored energy W of the law and the stabilisation U of `stress`.
  EnergySums (*energy)(const materials::AnyLaw& law, double kappa, int n, const double* w, const double* F);

  /// y ← w ln det F at every point. Returns the least det F. If the least det F is not positive, y is not valid.
  double (*log_jacobian)(int n, const double* w, const double* F, double* y);
  /// J ← det F at every point. Returns the least det F.
  double (*jacobian)(int n, const double* F, double* J);
  /// A ← F⁻ᵀ at every point.
  void (*inverse_transposed)(int n, const double* F, double* A);
  /// T ← T + s A at every point, with a number s for each point.
  void (*add_multiple)(int n, const double* s, const double* A, double* T);
  /// y ← w A : B at every point.
  void (*weighted_product)(int n, const double* w, const double* A, const double* B, double* y);
  /// y ← −w tr((AᵀB)²) with A = F⁻ᵀ. Without w, y is the second variation of ln det F along B.
  void (*weighted_curvature)(int n, const double* w, const double* A, const double* B, double* y);
  /// T ← T − s A Bᵀ A with A = F⁻ᵀ. This adds the rate of s A for the rate B of F and constant s.
  void (*add_rate_of_inverse)(int n, const double* s, const double* A, const double* B, double* T);
  /// Adds the viscous stress for the viscosity η: T ← T + w 2η J d A with A = F⁻ᵀ, J = det F and d = sym(B Aᵀ). B is
  /// the gradient of the velocity with respect to X. Returns the power Σ w 2ηJ d:d.
  double (*add_viscous_stress)(int n, const double* w, double eta, const double* F, const double* A, const double* B,
                               double* T);

  /// Functions for viscoelastic branches (materials/maxwell_branch.h). Branch b has the stress P_b, the stored energy
  /// W_b and an internal metric at each point. In `metrics`, entry k of the metric of branch b at point p has the index
  /// (6b + k) n + p.

  /// T ← T + w Σ P_b
  void (*add_branch_stress)(const materials::MaxwellBranches& branches, int n, const double* w, const double* metrics,
                            const double* F, double* T);
  /// Returns the sum of w W_b over the points and the branches.
  double (*branch_energy)(const materials::MaxwellBranches& branches, int n, const double* w, const double* metrics,
                          const double* F);
  /// Replaces the metrics by their values after a step of the length h. The deformation gradient is F0 at the start of
  /// the step and F1 at the end. During the step the strain is constant: the mean of F0ᵀF0 and F1ᵀF1, scaled to
  /// determinant 1 (materials::mean_strain). Returns the energy that each branch has lost, summed over the points with
  /// the weights w.
  materials::BranchEnergies (*relax_branches)(const materials::MaxwellBranches& branches, double h, int n,
                                              const double* w, const double* F0, const double* F1, double* metrics);

  /// A Walsh–Hadamard transform over the mirror images of points. `slots` has a slot of `length` numbers for each of
  /// the n_images sets of reflections, and n_images is a power of 2. The bits of the index of a slot are the
  /// reflections of the set. Slot m becomes the sum Σ_c (−1)^{|m & c|} x_c of the old slots x_c, with the number |m &
  /// c| of common bits.
  void (*transform_images)(double* slots, int n_images, int length);
};

/// One table of functions for each instruction set, the fastest first. A source file that CMake generates defines
/// `builds_of_dense_kernels`.
std::span<const mechanics::KernelBuild<DenseKernels>> builds_of_dense_kernels();
/// The kernels that this process uses. Throws mechanics::NoKernels if no build can be chosen.
const DenseKernels& dense();

}  // namespace pseudorigid::polynomial
