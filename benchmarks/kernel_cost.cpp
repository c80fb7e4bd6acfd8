#include "kernel_cost.h"

#include <memory>
#include <stdexcept>

#include "continuum/kernels/local_kernels.h"
#include "continuum/kernels/pressure_basis.h"
#include "continuum/kernels/stress_points.h"
#include "continuum/kernels/sum_factorization.h"
#include "counted.h"
#include "materials/ciarlet_geymonat.h"

namespace pseudorigid::benchmarks {
namespace {

using Tensor = materials::Tensor<Counted>;
using Law = materials::CiarletGeymonat;
using StressPoint = continuum::StressPoint<Law, Counted>;
constexpr double bytes_of_geometry = sizeof(continuum::StressPoint<Law, double>);
constexpr double log_operations = 34;  // lanes.h: quotient, powers, eleven terms, sums

template <int degree>
struct Cost {
  static constexpr int n = degree + 1, n_points = n * n * n;
  using Monomials = continuum::PressureMonomials<degree - 1>;
  static constexpr double n_pressure = Monomials::size;

  continuum::SumFactorization<n> factorization{continuum::ReferenceCell(degree)};
  std::unique_ptr<Counted[]> buffer = std::make_unique<Counted[]>(n_points + 4 * n * n);
  Counted *nodal = buffer.get(), *plane = nodal + n_points;
  static constexpr int p = n * n;

  /// From nodes to gradients, and back.
  double gradient() {
    return 3 * operations([&] {
             factorization.interpolate_layers(nodal);
             for (int q3 = 0; q3 < n; ++q3)
               factorization.plane_gradient(nodal, q3, plane, plane + p, plane + 2 * p, plane + 3 * p);
           });
  }
  double integration() {
    return 3 * operations([&] {
             for (int q3 = 0; q3 < n; ++q3)
               factorization.integrate_plane(plane, plane + p, plane + 2 * p, q3, plane + 3 * p, nodal);
             factorization.distribute_layers(nodal);
           });
  }

  static double stress_at_point() {
    const StressPoint point(Tensor{}, 1);
    return operations([&] {
      Counted least;
      point.stress(Law{1, 0}, 0, 1, Tensor{}, least);
    });
  }
  static double inverse_at_point() {
    return operations([] {
      const Tensor H{}, cof = cofactor(H);
      Counted(1) / determinant(H, cof);
    });
  }
  static double moments_at_point() {
    return operations([] {
      Counted moments[Monomials::size];
      Monomials::add_moments(Counted(1) * Counted(1), Counted(), Counted(), Counted(), moments);
    });
  }
  static double pressure_at_point() {
    return operations([] {
      const Counted coefficients[Monomials::size];
      Monomials::evaluate(coefficients, Counted(), Counted(), Counted());
    });
  }

  CellCost of(const std::string& kernel) {
    constexpr double indices = 4.0 * n_points, basis = 8 * n_pressure * (n_pressure + 1) / 2 + 8 * n_pressure;
    constexpr double pressure_points = 8 * 4 * n_points, basis_operations = n_pressure * (n_pressure + 1);
    if (kernel == "force")
      return {gradient() + integration() + n_points * stress_at_point(), indices + bytes_of_geometry * n_points};
    if (kernel == "constraint")
      return {gradient() + basis_operations + n_points * (inverse_at_point() + 1 + log_operations + moments_at_point()),
              indices + pressure_points + basis};
    if (kernel == "rate")
      return {2 * gradient() + basis_operations + n_points * (inverse_at_point() + 18 + moments_at_point()),
              indices + pressure_points + basis};
    if (kernel == "reaction")
      return {
          gradient() + integration() + basis_operations + n_points * (inverse_at_point() + 10 + pressure_at_point()),
          indices + pressure_points + basis};
    if (kernel == "stiffness") {  // a symmetric 9×9 matrix in single precision, times a vector
      constexpr double entries = continuum::StiffnessTangent::n_entries, operations_of_entries = 2 * 81;
      return {gradient() + integration() + n_points * operations_of_entries, indices + 4 * entries * n_points};
    }
    throw std::invalid_argument("no cost known of " + kernel);
  }
};

template <int degree>
CellCost cost_up_to(const std::string& kernel, int wanted) {
  if (wanted == degree) return Cost<degree>().of(kernel);
  if constexpr (degree > 2) return cost_up_to<degree - 1>(kernel, wanted);
  throw std::invalid_argument("no cost known of that degree");
}

}  // namespace

CellCost cell_cost(const std::string& kernel, int degree) { return cost_up_to<8>(kernel, degree); }

}  // namespace pseudorigid::benchmarks
