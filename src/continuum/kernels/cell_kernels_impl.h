#pragma once
/// The kernels of local_kernels.h for one degree; the law is behind point_law.h. What happens at the points is done
/// plane by plane (sum_factorization.h); geometry and positions that come next are asked for ahead of time. In
/// reference coordinates, H = ∂x/∂ξ:
///
///   F = H (∂X/∂ξ)⁻¹,   ∫ P : ∇φ = Σ_q w P (∂X/∂ξ)⁻ᵀ : ∂φ/∂ξ,
///   ∫ λ F⁻ᵀ : ∇φ = Σ_q w λ H⁻ᵀ : ∂φ/∂ξ,   tr(F⁻¹∇v) = H⁻ᵀ : ∂v/∂ξ,   J = det H / det ∂X/∂ξ
///
/// so the constraint's operators read one scalar of geometry a point beside its position.

#include <type_traits>
#include <utility>
#include <vector>

#include "continuum/kernels/cell_batches.h"
#include "continuum/kernels/local_kernels.h"
#include "continuum/kernels/point_law.h"
#include "continuum/kernels/pressure_at_nodes.h"
#include "continuum/kernels/single_lanes.h"

namespace pseudorigid::continuum {

template <int degree, int n_lanes>
class DegreeKernels final : public LocalKernels {
  using Batches = CellBatches<degree, n_lanes>;
  using L = typename Batches::L;
  using Single = SingleLanes<n_lanes>;
  using QuadraturePoint = typename Batches::QuadraturePoint;
  using PressurePoint = typename Batches::PressurePoint;
  using Tensor = materials::Tensor<L>;
  static constexpr int n = Batches::n, plane = n * n;
  static constexpr int n_nodes = Batches::n_nodes, n_pressure = Batches::n_pressure;

 public:
  DegreeKernels(const LocalCells& cells, std::unique_ptr<PointLaw<n_lanes>> law)
      : law_(std::move(law)), batches_(cells), buffers_(std::make_unique<Buffers>()) {}

  double add_force(const double* x, double* f) const override {
    double least = HUGE_VAL;
    for (std::size_t b = 0; b < batches_.batches.size(); ++b) {
      load_layers(x, b, buffers_->x);
      L least_in_batch(HUGE_VAL);
      for (int q3 = 0; q3 < n; ++q3) {
        plane_gradient(buffers_->x, q3, buffers_->H);
        batches_.prefetch_layer(x, b, q3);
        law_->stress(batches_.points(b) + q3 * plane, plane, buffers_->H[0], least_in_batch);
        integrate_plane(buffers_->H, q3);
      }
      least = lesser(least_in_batch.least(batches_.batches[b].n_active), least);
      distribute_layers();
      batches_.scatter_add(buffers_->result, b, f);
    }
    return least;
  }

  double constraint(const double* x, double* g) const override {
    double least = HUGE_VAL;
    for (std::size_t b = 0; b < batches_.batches.size(); ++b) {
      load_layers(x, b, buffers_->x);
      L least_in_batch(HUGE_VAL), moments[n_pressure];
      for (L& m : moments) m = L(0.0);
      for (int q3 = 0; q3 < n; ++q3) {
        plane_gradient(buffers_->x, q3, buffers_->H);
        const PressurePoint* points = batches_.pressure_points(b) + q3 * plane;
        for (int q = 0; q < plane; ++q) {
          const PressurePoint& p = points[q];
          prefetch(points + plane + q);
          const L J = materials::determinant(load(buffers_->H, q)) * (batches_.unit_weights[q3 * plane + q] / p.weight);
          least_in_batch = min(J, least_in_batch);
          Batches::Monomials::add_moments(p.weight * log(J), p.position[0], p.position[1], p.position[2], moments);
        }
      }
      least = lesser(least_in_batch.least(batches_.batches[b].n_active), least);
      store(moments, b, g);
    }
    return least;
  }

  void constraint_rate(const double* x, const double* v, double* r) const override {
    pull_back(x, v, r,
              [](const Tensor& cof, const L& inverse_det, const Tensor& dv) { return dot(cof, dv) * inverse_det; });
  }

  void constraint_curvature(const double* x, const double* v, double* r) const override {
    pull_back(x, v, r, [](const Tensor& cof, const L& inverse_det, const Tensor& dv) {
      L trace_of_square(0.0);  // of H⁻¹ ∂v/∂ξ
      Tensor A;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          A(i, j) = (cof(0, i) * dv(0, j) + cof(1, i) * dv(1, j) + cof(2, i) * dv(2, j)) * inverse_det;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) trace_of_square += A(i, j) * A(j, i);
      return -trace_of_square;
    });
  }

  void add_reaction(const double* x, const double* lambda, double* f) const override {
    for (std::size_t b = 0; b < batches_.batches.size(); ++b) {
      load_layers(x, b, buffers_->x);
      batches_.load_multiplier(lambda, b, buffers_->multiplier);
      reaction_of_batch(b);
      batches_.scatter_add(buffers_->result, b, f);
    }
  }

  std::unique_ptr<ConstraintTangent> make_tangent(Precision precision) const override {
    const std::size_t n_planes = batches_.batches.size() * n;
    if (precision == Precision::single_precision) return std::make_unique<Tangent<Single>>(precision, n_planes);
    return std::make_unique<Tangent<L>>(precision, n_planes);
  }
  void set_tangent(const double* x, ConstraintTangent& tangent) const override {
    of_its_precision(tangent, [&](auto& planes) { set_planes(x, planes); });
  }
  void constraint_rate(const ConstraintTangent& at_x, const double* v, double* r) const override {
    of_its_precision(at_x, [&](const auto& planes) { rate_by_planes(planes, v, r); });
  }
  void add_reaction(const ConstraintTangent& at_x, const double* lambda, double* f) const override {
    of_its_precision(at_x, [&](const auto& planes) { add_reaction_by_planes(planes, lambda, f); });
  }

  /// In reference coordinates 2ηJ d F⁻ᵀ : ∇φ = 2η (det ∂X/∂ξ)⁻¹ d cof H : ∂φ/∂ξ, d = sym(∂v/∂ξ H⁻¹).
  double add_viscous_force(double viscosity, const double* x, const double* v, double* f) const override {
    double power = 0;
    for (std::size_t b = 0; b < batches_.batches.size(); ++b) {
      load_layers(x, b, buffers_->x);
      load_layers(v, b, buffers_->v);
      L power_of_batch(0.0);
      for (int q3 = 0; q3 < n; ++q3) {
        plane_gradient(buffers_->x, q3, buffers_->H);
        plane_gradient(buffers_->v, q3, buffers_->dv);
        for (int q = 0; q < plane; ++q) {
          const Tensor H = load(buffers_->H, q), cof = materials::cofactor(H), dv = load(buffers_->dv, q);
          const L det = materials::determinant(H, cof);
          const double strength = 2 * viscosity * batches_.unit_weights[q3 * plane + q];
          const Tensor d = symmetric_part_of_product(dv, cof, 0.5 / det);
          power_of_batch += strength * det * dot(d, d);
          for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
              buffers_->H[3 * i + j][q] = -strength * (d(i, 0) * cof(0, j) + d(i, 1) * cof(1, j) + d(i, 2) * cof(2, j));
        }
        integrate_plane(buffers_->H, q3);
      }
      power += power_of_batch.sum(batches_.batches[b].n_active);
      distribute_layers();
      batches_.scatter_add(buffers_->result, b, f);
    }
    return power;
  }

  void constraint_rows(const double* x, const UseRows& use) const override {
    constexpr std::size_t size = std::size_t{n_pressure} * 3 * n_nodes;
    std::vector<double> rows(n_lanes * size);
    for (std::size_t b = 0; b < batches_.batches.size(); ++b) {
      const auto& batch = batches_.batches[b];
      load_layers(x, b, buffers_->x);
      for (int j = 0; j < n_pressure; ++j) {
        for (int i = 0; i < n_pressure; ++i) buffers_->multiplier[i] = L(i == j ? 1.0 : 0.0);
        reaction_of_batch(b);
        for (int l = 0; l < batch.n_active; ++l)
          for (int i = 0; i < n_nodes; ++i)
            for (int c = 0; c < 3; ++c) rows[l * size + (j * n_nodes + i) * 3 + c] = buffers_->result[c][i][l];
      }
      for (int l = 0; l < batch.n_active; ++l) use(batch.first_cell + l, {rows.data() + l * size, size});
    }
  }

  CellIntegrals integrals(const double* x, const double* v) const override {
    CellIntegrals sums;
    for (std::size_t b = 0; b < batches_.batches.size(); ++b) {
      load_layers(x, b, buffers_->x);
      load_layers(v, b, buffers_->v);
      add_integrals(b, sums);
    }
    return sums;
  }

  LeastPlace locate_least(const double* x, const FunctionOfF& value) const override {
    return locate(x, [&](const QuadraturePoint* points, L* values) {
      for (int q = 0; q < plane; ++q) {
        const Tensor F = points[q].deformation_gradient(load(buffers_->H, q));
        for (int l = 0; l < n_lanes; ++l) {
          double F_l[9];
          for (int k = 0; k < 9; ++k) F_l[k] = F(k / 3, k % 3)[l];
          values[q].v[l] = value(F_l);
        }
      }
    });
  }
  LeastPlace locate_least_jacobian(const double* x) const override {
    return locate(x, [&](const QuadraturePoint* points, L* J) {
      for (int q = 0; q < plane; ++q)
        J[q] = materials::determinant(points[q].deformation_gradient(load(buffers_->H, q)));
    });
  }
  LeastPlace locate_least_reserve(const double* x) const override {
    return locate(
        x, [&](const QuadraturePoint* points, L* reserve) { law_->reserve(points, plane, buffers_->H[0], reserve); });
  }

  void multiplier_at_nodes(const double* lambda, unsigned int cell, std::span<double> values) const override {
    continuum::multiplier_at_nodes(batches_, lambda, cell, values);
  }
  void pressure_basis_at_nodes(const UseRows& use) const override { continuum::pressure_basis_at_nodes(batches_, use); }

  double reference_volume() const override {
    double sum = 0;
    for (const auto& batch : batches_.batches) sum += batch.cell_volume.sum(batch.n_active);
    return sum;
  }
  double least_cell_volume() const override {
    double least = HUGE_VAL;
    for (const auto& batch : batches_.batches) least = std::min(least, batch.cell_volume.least(batch.n_active));
    return least;
  }
  std::size_t memory() const override { return batches_.memory() + sizeof(Buffers); }

 private:
  /// s (A Bᵀ + B Aᵀ)
  static Tensor symmetric_part_of_product(const Tensor& A, const Tensor& B, const L& s) {
    Tensor AB, result;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) AB(i, j) = A(i, 0) * B(j, 0) + A(i, 1) * B(j, 1) + A(i, 2) * B(j, 2);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) result(i, j) = s * (AB(i, j) + AB(j, i));
    return result;
  }

  using Nodal = L[3][n_nodes];  ///< a vector at every node of a cell
  using Field = L[9][plane];    ///< a tensor at every point of a plane: [3·row + column][point]

  /// w H⁻ᵀ in the planes of points of all batches; Number is L or Single.
  template <class Number>
  struct PlaneOfPoints {
    Number T[9][plane];
  };
  template <class Number>
  using Planes = std::vector<PlaneOfPoints<Number>>;
  template <class Number>
  struct Tangent final : ConstraintTangent {
    Tangent(Precision precision, std::size_t n_planes) : ConstraintTangent(precision), planes(n_planes) {}
    Planes<Number> planes;
  };

  template <class AnyTangent, class Use>
  static void of_its_precision(AnyTangent& tangent, const Use& use) {
    const auto use_as = [&]<class Number>(Number) {
      using Own = std::conditional_t<std::is_const_v<AnyTangent>, const Tangent<Number>, Tangent<Number>>;
      use(static_cast<Own&>(tangent).planes);
    };
    tangent.precision() == Precision::single_precision ? use_as(Single()) : use_as(L());
  }

  template <class Number>
  void set_planes(const double* x, Planes<Number>& planes) const {
    auto plane_of_points = planes.begin();
    for (std::size_t b = 0; b < batches_.batches.size(); ++b) {
      load_layers(x, b, buffers_->x);
      for (int q3 = 0; q3 < n; ++q3, ++plane_of_points) {
        plane_gradient(buffers_->x, q3, buffers_->H);
        const PressurePoint* points = batches_.pressure_points(b) + q3 * plane;
        for (int q = 0; q < plane; ++q) {
          const Tensor H = load(buffers_->H, q), cof = materials::cofactor(H);
          const L factor = points[q].weight / materials::determinant(H, cof);
#pragma GCC unroll 9
          for (int k = 0; k < 9; ++k) plane_of_points->T[k][q] = factor * cof.a[k / 3][k % 3];
        }
      }
    }
  }

  template <class Number>
  void rate_by_planes(const Planes<Number>& planes, const double* v, double* r) const {
    auto plane_of_points = planes.begin();
    for (std::size_t b = 0; b < batches_.batches.size(); ++b) {
      load_layers(v, b, buffers_->v);
      L moments[n_pressure];
      for (L& m : moments) m = L(0.0);
      for (int q3 = 0; q3 < n; ++q3, ++plane_of_points) {
        plane_gradient(buffers_->v, q3, buffers_->dv);
        const PressurePoint* points = batches_.pressure_points(b) + q3 * plane;
        for (int q = 0; q < plane; ++q) {
          const L* X = points[q].position;
          Batches::Monomials::add_moments(dot(load(plane_of_points->T, q), load(buffers_->dv, q)), X[0], X[1], X[2],
                                          moments);
        }
      }
      store(moments, b, r);
    }
  }

  template <class Number>
  void add_reaction_by_planes(const Planes<Number>& planes, const double* lambda, double* f) const {
    auto plane_of_points = planes.begin();
    for (std::size_t b = 0; b < batches_.batches.size(); ++b) {
      batches_.load_multiplier(lambda, b, buffers_->multiplier);
      L coefficients[n_pressure];
      batches_.monomial_coefficients(buffers_->multiplier, b, coefficients);
      Field& T = buffers_->H;
      for (int q3 = 0; q3 < n; ++q3, ++plane_of_points) {
        const PressurePoint* points = batches_.pressure_points(b) + q3 * plane;
        for (int q = 0; q < plane; ++q) {
          const L* X = points[q].position;
          const L pressure = Batches::Monomials::evaluate(coefficients, X[0], X[1], X[2]);
#pragma GCC unroll 9
          for (int k = 0; k < 9; ++k) T[k][q] = pressure * L(plane_of_points->T[k][q]);
        }
        integrate_plane(T, q3);
      }
      distribute_layers();
      batches_.scatter_add(buffers_->result, b, f);
    }
  }

  template <class Number>
  [[gnu::always_inline]] static Tensor load(const Number (&T)[9][plane], int q) {
    return {{{T[0][q], T[1][q], T[2][q]}, {T[3][q], T[4][q], T[5][q]}, {T[6][q], T[7][q], T[8][q]}}};
  }

  void load_layers(const double* x, std::size_t b, Nodal& layers) const {
    batches_.gather(x, b, layers);
    for (int c = 0; c < 3; ++c) batches_.factorization.interpolate_layers(layers[c]);
  }

  /// H = ∂x/∂ξ at the points of a plane; the values themselves are left in the buffer.
  [[gnu::noinline]] void plane_gradient(const Nodal& layers, int q3, Field& H) const {
    for (int c = 0; c < 3; ++c)
      batches_.factorization.plane_gradient(layers[c], q3, buffers_->values[c], H[3 * c], H[3 * c + 1], H[3 * c + 2]);
  }

  /// result (+)= Σ_q T : ∂φ/∂ξ over the points of a plane
  [[gnu::noinline]] void integrate_plane(const Field& T, int q3) const {
    for (int c = 0; c < 3; ++c)
      batches_.factorization.integrate_plane(T[3 * c], T[3 * c + 1], T[3 * c + 2], q3, buffers_->values[c],
                                             buffers_->result[c]);
  }

  void distribute_layers() const {
    for (int c = 0; c < 3; ++c) batches_.factorization.distribute_layers(buffers_->result[c]);
  }

  struct Buffers {
    Nodal x, v, result;
    L values[3][plane];
    Field H, dv;
    L multiplier[n_pressure];
  };

  /// r_j = ∫ψ_j s(H, ∂v/∂ξ); `integrand` gets cof H, 1/det H and ∂v/∂ξ.
  template <class Integrand>
  void pull_back(const double* x, const double* v, double* r, const Integrand& integrand) const {
    for (std::size_t b = 0; b < batches_.batches.size(); ++b) {
      load_layers(x, b, buffers_->x);
      load_layers(v, b, buffers_->v);
      L moments[n_pressure];
      for (L& m : moments) m = L(0.0);
      for (int q3 = 0; q3 < n; ++q3) {
        plane_gradient(buffers_->x, q3, buffers_->H);
        plane_gradient(buffers_->v, q3, buffers_->dv);
        batches_.prefetch_layer(x, b, q3);
        batches_.prefetch_layer(v, b, q3);
        const PressurePoint* points = batches_.pressure_points(b) + q3 * plane;
        for (int q = 0; q < plane; ++q) {
          const PressurePoint& p = points[q];
          prefetch(points + plane + q);
          const Tensor H = load(buffers_->H, q);
          const Tensor cof = materials::cofactor(H);
          const L s = integrand(cof, 1.0 / materials::determinant(H, cof), load(buffers_->dv, q));
          Batches::Monomials::add_moments(p.weight * s, p.position[0], p.position[1], p.position[2], moments);
        }
      }
      store(moments, b, r);
    }
  }

  /// result ← ∫λ_h F⁻ᵀ:∇φ for the layers and the multiplier in the buffers.
  void reaction_of_batch(std::size_t b) const {
    L coefficients[n_pressure];
    batches_.monomial_coefficients(buffers_->multiplier, b, coefficients);
    Field& H = buffers_->H;
    for (int q3 = 0; q3 < n; ++q3) {
      plane_gradient(buffers_->x, q3, H);
      const PressurePoint* points = batches_.pressure_points(b) + q3 * plane;
      for (int q = 0; q < plane; ++q) {
        const PressurePoint& p = points[q];
        prefetch(points + plane + q);
        const L pressure = Batches::Monomials::evaluate(coefficients, p.position[0], p.position[1], p.position[2]);
        const Tensor H_q = load(H, q);
        const Tensor cof = materials::cofactor(H_q);
        const Tensor T = p.weight * pressure / materials::determinant(H_q, cof) * cof;
#pragma GCC unroll 9
        for (int k = 0; k < 9; ++k) H[k][q] = T.a[k / 3][k % 3];
      }
      integrate_plane(H, q3);
    }
    distribute_layers();
  }

  /// For the layers of x and v in the buffers.
  void add_integrals(std::size_t b, CellIntegrals& sums) const {
    const auto& batch = batches_.batches[b];
    L elastic(0.0), volumetric(0.0), volume(0.0), F_sum[9], pulled_back[9];
    for (int k = 0; k < 9; ++k) F_sum[k] = pulled_back[k] = L(0.0);
    for (int q3 = 0; q3 < n; ++q3) {
      const QuadraturePoint* points = batches_.points(b) + q3 * plane;
      plane_gradient(buffers_->x, q3, buffers_->H);
      plane_gradient(buffers_->v, q3, buffers_->dv);  // leaves v itself in the values
      law_->energy(points, plane, buffers_->H[0], elastic, volumetric);
      for (int q = 0; q < plane; ++q) {
        const L* position = batches_.pressure_points(b)[q3 * plane + q].position;
        const L weight = points[q].weight;
        const Tensor F = points[q].deformation_gradient(load(buffers_->H, q));
        volume += weight * materials::determinant(F);
        for (int j = 0; j < 3; ++j) {
          const auto& v = buffers_->values;
          const L w_j = weight * (F(0, j) * v[0][q] + F(1, j) * v[1][q] + F(2, j) * v[2][q]);
          for (int i = 0; i < 3; ++i) {
            F_sum[3 * i + j] += weight * F(i, j);
            pulled_back[3 * i + j] += (batch.center[i] + batch.scale * position[i]) * w_j;
          }
        }
      }
    }
    sums.elastic += elastic.sum(batch.n_active);
    sums.volumetric += volumetric.sum(batch.n_active);
    sums.volume += volume.sum(batch.n_active);
    for (int k = 0; k < 9; ++k) {
      sums.F[k / 3][k % 3] += F_sum[k].sum(batch.n_active);
      sums.X_pulled_back[k / 3][k % 3] += pulled_back[k].sum(batch.n_active);
    }
  }

  /// `evaluate(points, values)` for the points of a plane, of which the buffer has H = ∂x/∂ξ.
  template <class Evaluate>
  LeastPlace locate(const double* x, const Evaluate& evaluate) const {
    LeastPlace result;
    L values[plane];
    for (std::size_t b = 0; b < batches_.batches.size(); ++b) {
      load_layers(x, b, buffers_->x);
      for (int q3 = 0; q3 < n; ++q3) {
        plane_gradient(buffers_->x, q3, buffers_->H);
        evaluate(batches_.points(b) + q3 * plane, values);
        for (int q = 0; q < plane; ++q) take_least(values[q], b, batches_.pressure_points(b)[q3 * plane + q], result);
      }
    }
    return result;
  }

  void take_least(const L& value, std::size_t b, const PressurePoint& p, LeastPlace& result) const {
    const auto& batch = batches_.batches[b];
    for (int l = 0; l < batch.n_active; ++l) {
      std::array<double, 3> where;
      for (int c = 0; c < 3; ++c) where[c] = batch.center[c][l] + batch.scale[l] * p.position[c][l];
      result.take(value[l], where);
    }
  }

  void store(const L* moments, std::size_t b, double* g) const {
    L values[n_pressure];
    batches_.from_moments(moments, b, values);
    batches_.store_multiplier(values, b, g);
  }

  std::unique_ptr<PointLaw<n_lanes>> law_;
  Batches batches_;
  std::unique_ptr<Buffers> buffers_;
};

template <int degree>
std::unique_ptr<LocalKernels> make_local_kernels(const LocalCells& cells, const StoredEnergy& stored) {
  const auto with_lanes = [&]<int n_lanes>(std::integral_constant<int, n_lanes>) {
    return std::make_unique<DegreeKernels<degree, n_lanes>>(cells, make_point_law<n_lanes>(stored));
  };
  if (cells.nodes.size() <= few_lanes) return with_lanes(std::integral_constant<int, few_lanes>());
  return with_lanes(std::integral_constant<int, native_lanes>());
}

}  // namespace pseudorigid::continuum
