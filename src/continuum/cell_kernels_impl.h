#pragma once
/// The kernels of cell_kernels.h for one degree; the law is behind point_law.h. In reference coordinates, H = ∂x/∂ξ:
///
///   F = H (∂X/∂ξ)⁻¹,   ∫ P : ∇φ = Σ_q w P (∂X/∂ξ)⁻ᵀ : ∂φ/∂ξ,
///   ∫ λ F⁻ᵀ : ∇φ = Σ_q w λ H⁻ᵀ : ∂φ/∂ξ,   tr(F⁻¹∇v) = H⁻ᵀ : ∂v/∂ξ,   J = det H / det ∂X/∂ξ
///
/// so the constraint's operators read only two scalars of geometry a point.

#include <utility>

#include "continuum/cell_batches.h"
#include "continuum/cell_kernels.h"
#include "continuum/point_law.h"

namespace pseudorigid::continuum {

template <int degree>
class DegreeKernels final : public CellKernels {
  using Batches = CellBatches<degree>;
  using L = typename Batches::L;
  using Tensor = materials::Tensor<L>;
  static constexpr int n_nodes = Batches::n_nodes, n_points = Batches::n_points, n_pressure = Batches::n_pressure;

 public:
  DegreeKernels(const BallSpace& space, std::unique_ptr<PointLaw> law)
      : law_(std::move(law)),
        batches_(space),
        reference_positions_(&space.reference_positions()),
        buffers_(std::make_unique<Buffers>()) {}

  double force(const Vector& x, Vector& f) const override {
    double least = HUGE_VAL;
    f = 0.0;
    for (std::size_t b = 0; b < batches_.batches.size(); ++b) {
      reference_gradient(x, b, buffers_->H);
      L least_in_batch;
      law_->stress(batches_.points(b), n_points, buffers_->H[0], least_in_batch);
      least = lesser(least_in_batch.least(batches_.batches[b].n_active), least);
      integrate(buffers_->H);
      batches_.scatter_add(buffers_->nodal, b, f);
    }
    return least;
  }

  double constraint(const Vector& x, Vector& g) const override {
    double least = HUGE_VAL;
    for (std::size_t b = 0; b < batches_.batches.size(); ++b) {
      reference_gradient(x, b, buffers_->H);
      const auto* points = batches_.points(b);
      L least_in_batch(HUGE_VAL);
      L moments[n_pressure];
      for (L& m : moments) m = L(0.0);
      for (int q = 0; q < n_points; ++q) {
        const auto& p = points[q];
        const L J = materials::determinant(load(buffers_->H, q)) * p.inverse_determinant;
        least_in_batch = min(J, least_in_batch);
        Batches::Monomials::add_moments(p.weight * log(J), p.position[0], p.position[1], p.position[2], moments);
      }
      least = lesser(least_in_batch.least(batches_.batches[b].n_active), least);
      store(moments, b, g);
    }
    return least;
  }

  void constraint_rate(const Vector& x, const Vector& v, Vector& r) const override {
    pull_back(x, v, r,
              [](const Tensor& cof, const L& inverse_det, const Tensor& dv) { return dot(cof, dv) * inverse_det; });
  }

  void constraint_curvature(const Vector& x, const Vector& v, Vector& r) const override {
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

  void add_reaction(const Vector& x, const Vector& lambda, Vector& f) const override {
    for (std::size_t b = 0; b < batches_.batches.size(); ++b) {
      reference_gradient(x, b, buffers_->H);
      batches_.load_multiplier(lambda, b, buffers_->multiplier);
      reaction_of_batch(b, buffers_->multiplier);
      batches_.scatter_add(buffers_->nodal, b, f);
    }
  }

  /// In reference coordinates 2ηJ d F⁻ᵀ : ∇φ = 2η (det ∂X/∂ξ)⁻¹ d cof H : ∂φ/∂ξ, d = sym(∂v/∂ξ H⁻¹).
  double add_viscous_force(double viscosity, const Vector& x, const Vector& v, Vector& f) const override {
    double total = 0;
    for (std::size_t b = 0; b < batches_.batches.size(); ++b) {
      reference_gradient(x, b, buffers_->H);
      reference_gradient(v, b, buffers_->dv);
      L power(0.0);
      for (int q = 0; q < n_points; ++q) {
        const auto& p = batches_.points(b)[q];
        const Tensor H = load(buffers_->H, q), cof = materials::cofactor(H), dv = load(buffers_->dv, q);
        const L det = materials::determinant(H, cof), strength = 2 * viscosity * p.weight * p.inverse_determinant;
        const Tensor d = symmetric_part_of_product(dv, cof, 0.5 / det);
        power += strength * det * dot(d, d);
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            buffers_->H[3 * i + j][q] = -strength * (d(i, 0) * cof(0, j) + d(i, 1) * cof(1, j) + d(i, 2) * cof(2, j));
      }
      total += power.sum(batches_.batches[b].n_active);
      integrate(buffers_->H);
      batches_.scatter_add(buffers_->nodal, b, f);
    }
    return total;
  }

  void constraint_rows(const Vector& x, const UseRows& use) const override {
    std::vector<double> rows(static_cast<std::size_t>(Batches::n_lanes) * n_pressure * 3 * n_nodes);
    for (std::size_t b = 0; b < batches_.batches.size(); ++b) {
      const auto& batch = batches_.batches[b];
      for (int j = 0; j < n_pressure; ++j) {
        for (int i = 0; i < n_pressure; ++i) buffers_->multiplier[i] = L(i == j ? 1.0 : 0.0);
        reference_gradient(x, b, buffers_->H);
        reaction_of_batch(b, buffers_->multiplier);
        for (int l = 0; l < batch.n_active; ++l)
          for (int i = 0; i < n_nodes; ++i)
            for (int c = 0; c < 3; ++c)
              rows[(static_cast<std::size_t>(l) * n_pressure + j) * 3 * n_nodes + 3 * i + c] = buffers_->nodal[c][i][l];
      }
      const std::size_t size = static_cast<std::size_t>(n_pressure) * 3 * n_nodes;
      for (int l = 0; l < batch.n_active; ++l) use(batch.first_cell + l, {rows.data() + l * size, size});
    }
  }

  CellIntegrals integrals(const Vector& x, const Vector& v) const override {
    CellIntegrals sums;
    for (std::size_t b = 0; b < batches_.batches.size(); ++b) {
      reference_gradient(v, b, buffers_->dv);
      for (int c = 0; c < 3; ++c)
        for (int q = 0; q < n_points; ++q) buffers_->dv[c][q] = buffers_->point_values[c][q];  // v itself
      reference_gradient(x, b, buffers_->H);
      add_integrals(b, sums);
    }
    return sums;
  }

  LeastJacobian locate_least_jacobian(const Vector& x) const override {
    LeastJacobian result{HUGE_VAL, {}};
    for (std::size_t b = 0; b < batches_.batches.size(); ++b) {
      reference_gradient(x, b, buffers_->H);
      const auto& batch = batches_.batches[b];
      for (int q = 0; q < n_points; ++q) {
        const auto& p = batches_.points(b)[q];
        const L J = materials::determinant(load(buffers_->H, q)) * p.inverse_determinant;
        for (int l = 0; l < batch.n_active; ++l) {
          if (J[l] >= result.value || std::isnan(result.value)) continue;  // a NaN is the least of all
          result.value = J[l];
          for (int c = 0; c < 3; ++c) result.where[c] = batch.center[c][l] + batch.scale[l] * p.position[c][l];
        }
      }
    }
    return result;
  }

  void multiplier_at_nodes(const Vector& lambda, unsigned int cell, std::span<double> values) const override;

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
  using Field = L[9][n_points];  ///< a tensor at every point: [3·row + column][point]

  static Tensor load(const Field& field, int q) {
    Tensor T;
    for (int k = 0; k < 9; ++k) T(k / 3, k % 3) = field[k][q];
    return T;
  }
  /// s (A Bᵀ + B Aᵀ)
  static Tensor symmetric_part_of_product(const Tensor& A, const Tensor& B, const L& s) {
    Tensor AB, result;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) AB(i, j) = A(i, 0) * B(j, 0) + A(i, 1) * B(j, 1) + A(i, 2) * B(j, 2);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) result(i, j) = s * (AB(i, j) + AB(j, i));
    return result;
  }
  static void save(const Tensor& T, Field& field, int q) {
    for (int k = 0; k < 9; ++k) field[k][q] = T(k / 3, k % 3);
  }

  /// H = ∂x/∂ξ at the points of a batch.
  void reference_gradient(const Vector& x, std::size_t b, Field& H) const {
    batches_.gather(x, b, buffers_->nodal);
    for (int c = 0; c < 3; ++c)
      batches_.factorization.gradients(buffers_->nodal[c], buffers_->scratch, buffers_->point_values[c], H[3 * c],
                                       H[3 * c + 1], H[3 * c + 2]);
  }

  /// nodal ← Σ_q T : ∂φ/∂ξ
  void integrate(const Field& T) const {
    for (int c = 0; c < 3; ++c)
      batches_.factorization.integrate(T[3 * c], T[3 * c + 1], T[3 * c + 2], buffers_->scratch,
                                       buffers_->point_values[c], buffers_->nodal[c]);
  }

  struct Buffers {
    L nodal[3][n_nodes], point_values[3][n_points], scratch[n_points];
    Field H, dv;
    L multiplier[n_pressure];
  };

  /// r_j = ∫ψ_j s(H, ∂v/∂ξ); `integrand` gets cof H, 1/det H and ∂v/∂ξ.
  template <class Integrand>
  void pull_back(const Vector& x, const Vector& v, Vector& r, const Integrand& integrand) const {
    for (std::size_t b = 0; b < batches_.batches.size(); ++b) {
      reference_gradient(x, b, buffers_->H);
      reference_gradient(v, b, buffers_->dv);
      const auto* points = batches_.points(b);
      L moments[n_pressure];
      for (L& m : moments) m = L(0.0);
      for (int q = 0; q < n_points; ++q) {
        const auto& p = points[q];
        const Tensor H = load(buffers_->H, q);
        const Tensor cof = materials::cofactor(H);
        const L s = integrand(cof, 1.0 / materials::determinant(H, cof), load(buffers_->dv, q));
        Batches::Monomials::add_moments(p.weight * s, p.position[0], p.position[1], p.position[2], moments);
      }
      store(moments, b, r);
    }
  }

  /// nodal ← ∫λ_h F⁻ᵀ:∇φ; expects H of the batch in the buffer, and overwrites it.
  void reaction_of_batch(std::size_t b, const L* multiplier) const {
    L coefficients[n_pressure];
    batches_.monomial_coefficients(multiplier, b, coefficients);
    const auto* points = batches_.points(b);
    for (int q = 0; q < n_points; ++q) {
      const auto& p = points[q];
      const L pressure = Batches::Monomials::evaluate(coefficients, p.position[0], p.position[1], p.position[2]);
      const Tensor H = load(buffers_->H, q);
      const Tensor cof = materials::cofactor(H);
      save(p.weight * pressure / materials::determinant(H, cof) * cof, buffers_->H, q);
    }
    integrate(buffers_->H);
  }

  /// Expects H and, in the first three entries of dv, the velocity of the batch.
  void add_integrals(std::size_t b, CellIntegrals& sums) const {
    const auto& batch = batches_.batches[b];
    L elastic, volume(0.0), F_sum[9], pulled_back[9];
    law_->energy(batches_.points(b), n_points, buffers_->H[0], elastic);
    for (int k = 0; k < 9; ++k) F_sum[k] = pulled_back[k] = L(0.0);
    for (int q = 0; q < n_points; ++q) {
      const auto& p = batches_.points(b)[q];
      const Tensor F = p.deformation_gradient(load(buffers_->H, q));
      volume += p.weight * materials::determinant(F);
      for (int j = 0; j < 3; ++j) {
        const L w_j =
            p.weight * (F(0, j) * buffers_->dv[0][q] + F(1, j) * buffers_->dv[1][q] + F(2, j) * buffers_->dv[2][q]);
        for (int i = 0; i < 3; ++i) {
          F_sum[3 * i + j] += p.weight * F(i, j);
          pulled_back[3 * i + j] += (batch.center[i] + batch.scale * p.position[i]) * w_j;
        }
      }
    }
    sums.elastic += elastic.sum(batch.n_active);
    sums.volume += volume.sum(batch.n_active);
    for (int k = 0; k < 9; ++k) {
      sums.F[k / 3][k % 3] += F_sum[k].sum(batch.n_active);
      sums.X_pulled_back[k / 3][k % 3] += pulled_back[k].sum(batch.n_active);
    }
  }

  void store(const L* moments, std::size_t b, Vector& g) const {
    L values[n_pressure];
    batches_.from_moments(moments, b, values);
    batches_.store_multiplier(values, b, g);
  }

  std::unique_ptr<PointLaw> law_;
  Batches batches_;
  const Vector* reference_positions_;
  std::unique_ptr<Buffers> buffers_;
};

template <int degree>
void DegreeKernels<degree>::multiplier_at_nodes(const Vector& lambda, unsigned int cell,
                                                std::span<double> values) const {
  const std::size_t b = cell / Batches::n_lanes;
  const int lane = static_cast<int>(cell % Batches::n_lanes);
  L coefficients[n_pressure];
  batches_.load_multiplier(lambda, b, buffers_->multiplier);
  batches_.monomial_coefficients(buffers_->multiplier, b, coefficients);
  batches_.gather(*reference_positions_, b, buffers_->nodal);
  const auto& batch = batches_.batches[b];
  for (int i = 0; i < n_nodes; ++i) {
    L local[3];
    for (int c = 0; c < 3; ++c) local[c] = (buffers_->nodal[c][i] - batch.center[c]) / batch.scale;
    values[i] = Batches::Monomials::evaluate(coefficients, local[0], local[1], local[2])[lane];
  }
}

/// Defined in one source file a degree, which are compiled for the widest vectors of the machine.
template <int degree>
std::unique_ptr<CellKernels> make_kernels_of_degree(const BallSpace& space, const materials::AnyLaw& law) {
  return std::make_unique<DegreeKernels<degree>>(space, make_point_law(law));
}

}  // namespace pseudorigid::continuum
