#pragma once
/// Operations on one batch of cells, one plane of points after the other (sum_factorization.h). They compute H = ∂x/∂ξ
/// at the points from values of x at the nodes. They also compute the sums Σ_q T : ∂φ/∂ξ over the points q for the
/// basis functions φ, from a tensor T at the points. The planes of a batch must be processed in ascending order.

#include <memory>

#include "continuum/kernels/cell_batches.h"
#include "materials/tensor.h"

namespace pseudorigid::continuum {

template <int degree, int lanes>
class CellPlanes {
 public:
  using Batches = CellBatches<degree, lanes>;
  using L = typename Batches::L;
  using Tensor = materials::Tensor<L>;
  static constexpr int n = Batches::n, plane = n * n, n_lanes = lanes;
  static constexpr int n_nodes = Batches::n_nodes, n_pressure = Batches::n_pressure;

  using Nodal = L[3][n_nodes];  ///< a vector at every node of a cell
  using Field = L[9][plane];    ///< a tensor at every point of a plane: [3·row + column][point]

  /// Workspace of one batch. X, x and v contain nodal values, interpolated to the points in the first two directions
  /// (load_layers). `result` contains sums for the nodes (integrate_plane). `values`, dX, H, dv and `weights` contain
  /// numbers at the points of one plane. `multiplier` contains the coefficients λ_j of the cells.
  struct Buffers {
    Nodal X, x, v, result;
    L values[3][plane];
    Field dX, H, dv;
    L weights[plane];
    L multiplier[n_pressure];
  };

  explicit CellPlanes(const LocalCells& cells) : batches(cells), buffers_(std::make_unique<Buffers>()) {}

  /// The workspace for one batch. Most of the following functions overwrite a part of the workspace.
  Buffers& buffers() const { return *buffers_; }
  std::size_t n_batches() const { return batches.batches.size(); }
  std::size_t memory() const { return batches.memory() + sizeof(Buffers); }

  /// `load` returns the tensor at point q of a plane. `store` sets this tensor.
  template <class Number>
  [[gnu::always_inline]] static Tensor load(const Number (&T)[9][plane], int q) {
    return {{{T[0][q], T[1][q], T[2][q]}, {T[3][q], T[4][q], T[5][q]}, {T[6][q], T[7][q], T[8][q]}}};
  }
  [[gnu::always_inline]] static void store(const Tensor& T, int q, Field& field) {
#pragma GCC unroll 9
    for (int k = 0; k < 9; ++k) field[k][q] = T.a[k / 3][k % 3];
  }

  /// Sets `layers` to the nodal values of x in a batch, interpolated to the points in the first two directions.
  void load_layers(const double* x, std::size_t b, Nodal& layers) const {
    batches.gather(x, b, layers);
    for (int c = 0; c < 3; ++c) batches.factorization.interpolate_layers(layers[c]);
  }

  /// H = ∂x/∂ξ at the points of a plane. The values of x at these points remain in the buffer `values`.
  [[gnu::noinline]] void plane_gradient(const Nodal& layers, int q3, Field& H) const {
    for (int c = 0; c < 3; ++c)
      batches.factorization.plane_gradient(layers[c], q3, buffers_->values[c], H[3 * c], H[3 * c + 1], H[3 * c + 2]);
  }

  /// Replaces H = ∂x/∂ξ at the points of a plane by F = H (∂X/∂ξ)⁻¹. Sets the buffer dX to ∂X/∂ξ, and the buffer
  /// `weights` to ŵ det ∂X/∂ξ with the quadrature weights ŵ on the reference cell. The buffer X must contain the layers
  /// of X. The inverse is computed at each call, because storing it would take much memory.
  void deformation_gradients(int q3, Field& H) const {
    plane_gradient(buffers_->X, q3, buffers_->dX);
    for (int q = 0; q < plane; ++q) {
      const Tensor H_q = load(H, q), dX = load(buffers_->dX, q), cof = materials::cofactor(dX);
      const L det = materials::determinant(dX, cof), inverse_det = 1.0 / det;
      const auto entry = [&](int i, int j) {
        return inverse_det * (H_q(i, 0) * cof(j, 0) + H_q(i, 1) * cof(j, 1) + H_q(i, 2) * cof(j, 2));
      };
      for (int k = 0; k < 9; ++k) H[k][q] = entry(k / 3, k % 3);
      buffers_->weights[q] = batches.unit_weights[q3 * plane + q] * det;
    }
  }

  /// result ← result + Σ_q T : ∂φ/∂ξ over the points of a plane. For the first plane, the sum overwrites `result`.
  /// After the last plane, distribute_layers turns `result` into nodal values.
  [[gnu::noinline]] void integrate_plane(const Field& T, int q3) const {
    for (int c = 0; c < 3; ++c)
      batches.factorization.integrate_plane(T[3 * c], T[3 * c + 1], T[3 * c + 2], q3, buffers_->values[c],
                                            buffers_->result[c]);
  }

  /// Turns the sums of all planes in `result` into nodal values.
  void distribute_layers() const {
    for (int c = 0; c < 3; ++c) batches.factorization.distribute_layers(buffers_->result[c]);
  }

  /// Stores the integrals ∫ψ_j s of a function s over the cells of the batch in g. `moments` contains the integrals of
  /// s times each monomial.
  void store_moments(const L* moments, std::size_t b, double* g) const {
    L values[n_pressure];
    batches.from_moments(moments, b, values);
    batches.store_multiplier(values, b, g);
  }

  Batches batches;

 private:
  std::unique_ptr<Buffers> buffers_;
};

}  // namespace pseudorigid::continuum
