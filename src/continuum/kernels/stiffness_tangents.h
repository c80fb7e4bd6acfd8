#pragma once
/// Products of the stiffness of the cells with displacements u. At every Gauss point q, there is a matrix c
/// (modes/cell_stiffness.h). It has the rows (i, d) and the columns (k, e), with components i, k and local directions
/// d, e. It is symmetric, and its 45 numbers are stored in single precision. The product is
///
///   (K u)_(a,i) = Σ_q Σ_d T_id ∂_dφ_a,   T_id = Σ_ke c_(id)(ke) ∂_e u_k.

#include <array>
#include <vector>

#include "continuum/kernels/cell_planes.h"
#include "continuum/kernels/local_kernels.h"
#include "continuum/kernels/single_lanes.h"
#include "mechanics/core/huge_pages.h"

namespace pseudorigid::continuum {

template <int degree, int n_lanes>
class StiffnessTangents {
  using Planes = CellPlanes<degree, n_lanes>;
  using L = typename Planes::L;
  using Single = SingleLanes<n_lanes>;
  static constexpr int n = Planes::n, plane = Planes::plane, n_points = n * plane;
  static constexpr int n_entries = StiffnessTangent::n_entries;

 public:
  explicit StiffnessTangents(const Planes& planes) : planes_(planes) {}

  /// `fill(cell, values)` must set values[entry · n_points + point] to the entry of c at a point of the cell.
  std::unique_ptr<StiffnessTangent> make(const FillCell& fill) const {
    auto result = std::make_unique<Tangent>(planes_.n_batches() * n);
    std::vector<double> values(n_lanes * n_entries * n_points);
    for (std::size_t b = 0; b < planes_.n_batches(); ++b) {
      const auto& batch = planes_.batches.batches[b];
      for (int l = 0; l < batch.n_active; ++l)
        fill(batch.first_cell + l, {values.data() + l * n_entries * n_points, n_entries * n_points});
      for (int q3 = 0; q3 < n; ++q3)
        for (int k = 0; k < n_entries; ++k)
          for (int q = 0; q < plane; ++q)
            result->planes[b * n + q3].c[q][k] = L::of([&](int l) {
              return values[((l < batch.n_active ? l : 0) * n_entries + k) * n_points + q3 * plane + q];
            });
    }
    return result;
  }

  /// f ← f + K u
  void add_product(const StiffnessTangent& tangent, const double* u, double* f) const {
    const auto& stored = static_cast<const Tangent&>(tangent).planes;
    auto& buffers = planes_.buffers();
    for (std::size_t b = 0; b < planes_.n_batches(); ++b) {
      planes_.load_layers(u, b, buffers.v);
      for (int q3 = 0; q3 < n; ++q3) {
        planes_.plane_gradient(buffers.v, q3, buffers.dv);
        planes_.batches.prefetch_layer(u, b, q3);
        multiply(stored[b * n + q3], buffers.dv);
        planes_.integrate_plane(buffers.dv, q3);
      }
      planes_.distribute_layers();
      planes_.batches.scatter_add(buffers.result, b, f);
    }
  }

 private:
  struct PlaneOfPoints {
    Single c[plane][n_entries];
  };
  struct Tangent final : StiffnessTangent {
    explicit Tangent(std::size_t n_planes) : planes(n_planes) {}
    mechanics::HugePageVector<PlaneOfPoints> planes;
  };

  /// T ← c T at the points of a plane.
  [[gnu::noinline]] static void multiply(const PlaneOfPoints& at, typename Planes::Field& T) {
    for (int q = 0; q < plane; ++q) {
      prefetch_part<sizeof(at.c[0])>(&at + 1, q);
      L gradient[9], sum[9];
#pragma GCC unroll 9
      for (int k = 0; k < 9; ++k) gradient[k] = T[k][q], sum[k] = L(0.0);
      const Single* entry = at.c[q];
#pragma GCC unroll 9
      for (int row = 0; row < 9; ++row)
#pragma GCC unroll 9
        for (int column = row; column < 9; ++column) {
          const L c = *entry++;
          sum[row] += c * gradient[column];
          if (column != row) sum[column] += c * gradient[row];
        }
#pragma GCC unroll 9
      for (int k = 0; k < 9; ++k) T[k][q] = sum[k];
    }
  }

  const Planes& planes_;
};

}  // namespace pseudorigid::continuum
