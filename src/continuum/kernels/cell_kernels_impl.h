#pragma once
/// The kernels of local_kernels.h for elements of one degree. point_law.h evaluates the law. The kernels process the
/// points plane by plane (sum_factorization.h). Some kernels prefetch the geometry of later points and the positions of
/// the next batch. Let H = ∂x/∂ξ at a point q, and let w be the quadrature weight of the point times det ∂X/∂ξ. In
/// reference coordinates, with a stress P, a pressure λ, a velocity v and the basis functions φ,
///
///   F = H (∂X/∂ξ)⁻¹,   ∫ P : ∇φ = Σ_q w P (∂X/∂ξ)⁻ᵀ : ∂φ/∂ξ,
///   ∫ λ F⁻ᵀ : ∇φ = Σ_q w λ H⁻ᵀ : ∂φ/∂ξ,   tr(F⁻¹∇v) = H⁻ᵀ : ∂v/∂ξ,   J = det H / det ∂X/∂ξ.
///
/// Therefore the operators of the constraint need only H, the weight w and the position at each point.

#include <cmath>
#include <utility>
#include <vector>

#include "continuum/kernels/bulk_of_cells.h"
#include "continuum/kernels/cell_branches.h"
#include "continuum/kernels/cell_planes.h"
#include "continuum/kernels/constraint_tangents.h"
#include "continuum/kernels/local_kernels.h"
#include "continuum/kernels/point_law.h"
#include "continuum/kernels/pressure_at_nodes.h"
#include "continuum/kernels/reaction_of_cells.h"
#include "continuum/kernels/stiffness_tangents.h"

namespace pseudorigid::continuum {

template <int degree, int n_lanes>
class DegreeKernels final : public LocalKernels {
  using Planes = CellPlanes<degree, n_lanes>;
  using Batches = typename Planes::Batches;
  using L = typename Planes::L;
  using PressurePoint = typename Batches::PressurePoint;
  using Tensor = typename Planes::Tensor;
  using Field = typename Planes::Field;
  static constexpr int n = Batches::n, plane = n * n;
  static constexpr int n_nodes = Batches::n_nodes, n_pressure = Batches::n_pressure;

 public:
  DegreeKernels(const DegreeKernels&) = delete;  // because members refer to other members
  DegreeKernels& operator=(const DegreeKernels&) = delete;
  DegreeKernels(const LocalCells& cells, std::unique_ptr<PointLaw<n_lanes>> law)
      : law_(std::move(law)), planes_(cells), tangents_(planes_), stiffness_(planes_), branches_(planes_) {
    law_->reserve_points(planes_.n_batches() * n * plane);
    for (std::size_t b = 0; b < planes_.n_batches(); ++b) {
      planes_.load_layers(batches_.reference_positions, b, buffers_.X);
      for (int q3 = 0; q3 < n; ++q3) {
        planes_.plane_gradient(buffers_.X, q3, buffers_.dX);
        law_->add_points(buffers_.dX[0], &batches_.unit_weights[q3 * plane], plane);
      }
    }
  }

  double add_force(const double* x, double* f) const override {
    const auto nothing = [](std::size_t, int) {};
    return add_stress(x, f, nothing, nothing);
  }

  double add_force_with_reaction(const double* x, const double* lambda, ConstraintTangent* at_x,
                                 double* f) const override {
    L coefficients[n_pressure];
    const auto tangent_plane = [&](std::size_t b, int q3) -> Field& {
      return at_x ? tangents_.plane_of(*at_x, b, q3) : buffers_.dv;
    };
    return add_stress(
        x, f,
        [&](std::size_t b, int q3) {
          if (q3 == 0) {
            batches_.load_multiplier(lambda, b, buffers_.multiplier);
            batches_.monomial_coefficients(buffers_.multiplier, b, coefficients);
          }
          tangents_.set_plane(b, q3, buffers_.H, tangent_plane(b, q3));
        },
        [&](std::size_t b, int q3) { tangents_.add_pressure(b, q3, coefficients, tangent_plane(b, q3), buffers_.H); });
  }

  double constraint(const double* x, double* g) const override {
    double least = HUGE_VAL;
    for (std::size_t b = 0; b < batches_.batches.size(); ++b) {
      planes_.load_layers(x, b, buffers_.x);
      L least_in_batch(HUGE_VAL), moments[n_pressure];
      for (L& m : moments) m = L(0.0);
      for (int q3 = 0; q3 < n; ++q3) {
        planes_.plane_gradient(buffers_.x, q3, buffers_.H);
        const PressurePoint* points = batches_.pressure_points(b) + q3 * plane;
        for (int q = 0; q < plane; ++q) {
          const PressurePoint& p = points[q];
          prefetch(points + plane + q);
          const L J =
              materials::determinant(Planes::load(buffers_.H, q)) * (batches_.unit_weights[q3 * plane + q] / p.weight);
          least_in_batch = min(J, least_in_batch);
          Batches::Monomials::add_moments(p.weight * log(J), p.position[0], p.position[1], p.position[2], moments);
        }
      }
      least = lesser(least_in_batch.least(batches_.batches[b].n_active), least);
      planes_.store_moments(moments, b, g);
    }
    return least;
  }

  double bulk(double lambda, const double* g, double* b) const override {
    return bulk_of_cells(batches_, materials::BulkEnergy{lambda}, g, b);
  }

  void constraint_rate(const double* x, const double* v, double* r) const override {
    pull_back(x, v, r,
              [](const Tensor& cof, const L& inverse_det, const Tensor& dv) { return dot(cof, dv) * inverse_det; });
  }

  void constraint_curvature(const double* x, const double* v, double* r) const override {
    pull_back(x, v, r, [](const Tensor& cof, const L& inverse_det, const Tensor& dv) {
      L trace_of_square(0.0);  // trace of (H⁻¹ ∂v/∂ξ)²
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
    add_reaction_of_cells(planes_, x, lambda, f);
  }
  void add_reaction_rate(const double* x, const double* v, const double* lambda, double* f) const override {
    add_reaction_rate_of_cells(planes_, x, v, lambda, f);
  }

  std::unique_ptr<ConstraintTangent> make_tangent(Precision precision) const override {
    return tangents_.make(precision);
  }
  void set_tangent(const double* x, ConstraintTangent& tangent) const override { tangents_.set(x, tangent); }
  void constraint_rate(const ConstraintTangent& at_x, const double* v, double* r) const override {
    tangents_.rate(at_x, v, r);
  }
  void add_reaction(const ConstraintTangent& at_x, const double* lambda, double* f) const override {
    tangents_.add_reaction(at_x, lambda, f);
  }
  std::unique_ptr<StiffnessTangent> make_stiffness(const FillCell& fill) const override {
    return stiffness_.make(fill);
  }
  void add_stiffness_product(const StiffnessTangent& tangent, const double* u, double* f) const override {
    stiffness_.add_product(tangent, u, f);
  }

  /// Subtracts ∫2ηJ d F⁻ᵀ : ∇φ dX with the viscosity η from f, and returns the dissipated power. In reference
  /// coordinates the integrand is 2η (det ∂X/∂ξ)⁻¹ d cof H : ∂φ/∂ξ with d = sym(∂v/∂ξ H⁻¹).
  double add_viscous_force(double viscosity, const double* x, const double* v, double* f) const override {
    double power = 0;
    for (std::size_t b = 0; b < batches_.batches.size(); ++b) {
      planes_.load_layers(x, b, buffers_.x);
      planes_.load_layers(v, b, buffers_.v);
      L power_of_batch(0.0);
      for (int q3 = 0; q3 < n; ++q3) {
        planes_.plane_gradient(buffers_.x, q3, buffers_.H);
        planes_.plane_gradient(buffers_.v, q3, buffers_.dv);
        for (int q = 0; q < plane; ++q) {
          const Tensor H = Planes::load(buffers_.H, q), cof = materials::cofactor(H), dv = Planes::load(buffers_.dv, q);
          const L det = materials::determinant(H, cof);
          const double strength = 2 * viscosity * batches_.unit_weights[q3 * plane + q];
          const Tensor d = symmetric_part_of_product(dv, cof, 0.5 / det);
          power_of_batch += strength * det * dot(d, d);
          for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
              buffers_.H[3 * i + j][q] = -strength * (d(i, 0) * cof(0, j) + d(i, 1) * cof(1, j) + d(i, 2) * cof(2, j));
        }
        planes_.integrate_plane(buffers_.H, q3);
      }
      power += power_of_batch.sum(batches_.batches[b].n_active);
      planes_.distribute_layers();
      batches_.scatter_add(buffers_.result, b, f);
    }
    return power;
  }

  const BranchKernels& branches() const override { return branches_; }

  void constraint_rows(const double* x, const UseRows& use) const override { tangents_.rows(x, use); }

  CellIntegrals integrals(const double* x, const double* v) const override {
    CellIntegrals sums;
    for (std::size_t b = 0; b < batches_.batches.size(); ++b) {
      planes_.load_layers(x, b, buffers_.x);
      planes_.load_layers(v, b, buffers_.v);
      planes_.load_layers(batches_.reference_positions, b, buffers_.X);
      add_integrals(b, sums);
    }
    return sums;
  }

  LeastPlace locate_least(const double* x, const FunctionOfF& value) const override {
    return locate(x, [&](const Field& F, L* values) {
      for (int q = 0; q < plane; ++q)
        for (int l = 0; l < n_lanes; ++l) {
          double F_l[9];
          for (int k = 0; k < 9; ++k) F_l[k] = F[k][q][l];
          values[q].v[l] = value(F_l);
        }
    });
  }
  LeastPlace locate_least_jacobian(const double* x) const override {
    return locate(x, [&](const Field& F, L* J) {
      for (int q = 0; q < plane; ++q) J[q] = materials::determinant(Planes::load(F, q));
    });
  }
  LeastPlace locate_least_reserve(const double* x) const override {
    return locate(x, [&](const Field& F, L* reserve) { law_->reserve(F[0], plane, reserve); });
  }

  void multiplier_at_nodes(const double* lambda, unsigned int cell, std::span<double> values) const override {
    continuum::multiplier_at_nodes(batches_, lambda, cell, values);
  }
  void multiplier_at_points(const double* lambda, unsigned int cell, std::span<double> values) const override {
    continuum::multiplier_at_points(batches_, lambda, cell, values);
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
  std::size_t memory() const override { return planes_.memory() + law_->memory(); }

 private:
  /// Returns s (A Bᵀ + B Aᵀ). If s = ½, this is the symmetric part of A Bᵀ.
  static Tensor symmetric_part_of_product(const Tensor& A, const Tensor& B, const L& s) {
    Tensor AB, result;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) AB(i, j) = A(i, 0) * B(j, 0) + A(i, 1) * B(j, 1) + A(i, 2) * B(j, 2);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) result(i, j) = s * (AB(i, j) + AB(j, i));
    return result;
  }

  /// Sets r_j to the integral ∫ψ_j s dX of a function s of H and ∂v/∂ξ. The ψ_j are the basis functions of the
  /// multiplier. The function integrand(cof H, 1/det H, ∂v/∂ξ) returns s.
  template <class Integrand>
  void pull_back(const double* x, const double* v, double* r, const Integrand& integrand) const {
    for (std::size_t b = 0; b < batches_.batches.size(); ++b) {
      planes_.load_layers(x, b, buffers_.x);
      planes_.load_layers(v, b, buffers_.v);
      L moments[n_pressure];
      for (L& m : moments) m = L(0.0);
      for (int q3 = 0; q3 < n; ++q3) {
        planes_.plane_gradient(buffers_.x, q3, buffers_.H);
        planes_.plane_gradient(buffers_.v, q3, buffers_.dv);
        batches_.prefetch_layer(x, b, q3);
        batches_.prefetch_layer(v, b, q3);
        const PressurePoint* points = batches_.pressure_points(b) + q3 * plane;
        for (int q = 0; q < plane; ++q) {
          const PressurePoint& p = points[q];
          prefetch(points + plane + q);
          const Tensor H = Planes::load(buffers_.H, q);
          const Tensor cof = materials::cofactor(H);
          const L s = integrand(cof, 1.0 / materials::determinant(H, cof), Planes::load(buffers_.dv, q));
          Batches::Monomials::add_moments(p.weight * s, p.position[0], p.position[1], p.position[2], moments);
        }
      }
      planes_.store_moments(moments, b, r);
    }
  }

  /// f ← f − ∫∂(W + U)/∂F : ∇φ. Returns the least of J and of the law's reserve. For every plane of points, the
  /// function calls at_H(batch, plane) when buffers_.H contains H. It then calls at_T(batch, plane) when buffers_.H
  /// contains T = −w ∂(W + U)/∂F (∂X/∂ξ)⁻ᵀ.
  template <class AtH, class AtT>
  double add_stress(const double* x, double* f, const AtH& at_H, const AtT& at_T) const {
    double least = HUGE_VAL;
    for (std::size_t b = 0; b < batches_.batches.size(); ++b) {
      planes_.load_layers(x, b, buffers_.x);
      L least_in_batch(HUGE_VAL);
      for (int q3 = 0; q3 < n; ++q3) {
        planes_.plane_gradient(buffers_.x, q3, buffers_.H);
        batches_.prefetch_layer(x, b, q3);
        at_H(b, q3);
        law_->stress((b * n + q3) * plane, &batches_.unit_weights[q3 * plane], plane, buffers_.H[0], least_in_batch);
        at_T(b, q3);
        planes_.integrate_plane(buffers_.H, q3);
      }
      least = lesser(least_in_batch.least(batches_.batches[b].n_active), least);
      planes_.distribute_layers();
      batches_.scatter_add(buffers_.result, b, f);
    }
    return least;
  }

  /// Adds the integrals of a batch to `sums`. The buffers must contain the layers of X, x and v.
  void add_integrals(std::size_t b, CellIntegrals& sums) const {
    const auto& batch = batches_.batches[b];
    L elastic(0.0), volumetric(0.0), volume(0.0), squared_log_J(0.0), least_negative(0.0), least(HUGE_VAL);
    L F_sum[9], pulled_back[9], reserve[plane];
    for (int k = 0; k < 9; ++k) F_sum[k] = pulled_back[k] = L(0.0);
    for (int q3 = 0; q3 < n; ++q3) {
      planes_.plane_gradient(buffers_.x, q3, buffers_.H);
      planes_.deformation_gradients(q3, buffers_.H);
      planes_.plane_gradient(buffers_.v, q3, buffers_.dv);  // this call also leaves v in the buffer `values`
      law_->energy(buffers_.H[0], buffers_.weights, plane, elastic, volumetric);
      law_->reserve(buffers_.H[0], plane, reserve);
      for (int q = 0; q < plane; ++q) {
        const L* position = batches_.pressure_points(b)[q3 * plane + q].position;
        const L weight = buffers_.weights[q];
        const Tensor F = Planes::load(buffers_.H, q);
        const L J = materials::determinant(F);
        const L log_J = log(J), squared = log_J * log_J;
        volume += weight * J;
        squared_log_J += weight * squared;
        least_negative = min(least_negative, -squared);
        least = min(least, min(J, reserve[q]));
        for (int j = 0; j < 3; ++j) {
          const auto& v = buffers_.values;
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
    sums.squared_log_J += squared_log_J.sum(batch.n_active);
    sums.largest_squared_log_J = std::max(sums.largest_squared_log_J, -least_negative.least(batch.n_active));
    sums.least = lesser(least.least(batch.n_active), sums.least);
    for (int k = 0; k < 9; ++k) {
      sums.F[k / 3][k % 3] += F_sum[k].sum(batch.n_active);
      sums.X_pulled_back[k / 3][k % 3] += pulled_back[k].sum(batch.n_active);
    }
  }

  /// Returns the least of the values at all points of this process, with its reference position. The function
  /// evaluate(F, values) computes the values at the points of a plane from F at these points.
  template <class Evaluate>
  LeastPlace locate(const double* x, const Evaluate& evaluate) const {
    LeastPlace result;
    L values[plane];
    for (std::size_t b = 0; b < batches_.batches.size(); ++b) {
      planes_.load_layers(batches_.reference_positions, b, buffers_.X);
      planes_.load_layers(x, b, buffers_.x);
      for (int q3 = 0; q3 < n; ++q3) {
        planes_.plane_gradient(buffers_.x, q3, buffers_.H);
        planes_.deformation_gradients(q3, buffers_.H);
        evaluate(buffers_.H, values);
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

  std::unique_ptr<PointLaw<n_lanes>> law_;
  Planes planes_;
  const Batches& batches_ = planes_.batches;
  typename Planes::Buffers& buffers_ = planes_.buffers();
  ConstraintTangents<degree, n_lanes> tangents_;
  StiffnessTangents<degree, n_lanes> stiffness_;
  CellBranches<degree, n_lanes> branches_;
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
