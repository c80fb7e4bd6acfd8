#include <deal.II/matrix_free/tensor_product_kernels.h>

#include <stdexcept>
#include <vector>

#include "counted.h"
#include "kernel_cost.h"
#include "materials/ciarlet_geymonat.h"

namespace pseudorigid::benchmarks {
namespace {

/// The operations of the sweeps of one component. They are those of FEEvaluationImplTransformToCollocation: three
/// sweeps change the basis to the Lagrange polynomials of the Gauss points, and three differentiate. Integration has
/// the transposed sweeps.
template <int n>
double sweeps_of_component() {
  using Sweeps = dealii::internal::EvaluatorTensorProduct<dealii::internal::evaluate_evenodd, 3, n, n, Counted, double>;
  dealii::AlignedVector<double> shapes(n * ((n + 1) / 2), 1.0);
  const Sweeps sweeps(shapes, shapes, shapes);
  std::vector<Counted> nodal(n * n * n), at_points(n * n * n), gradient(3 * n * n * n);
  const double evaluation = operations([&] {
    sweeps.template values<0, true, false>(nodal.data(), at_points.data());
    sweeps.template values<1, true, false>(at_points.data(), at_points.data());
    sweeps.template values<2, true, false>(at_points.data(), at_points.data());
    sweeps.template gradients<0, true, false>(at_points.data(), gradient.data());
    sweeps.template gradients<1, true, false>(at_points.data(), gradient.data() + n * n * n);
    sweeps.template gradients<2, true, false>(at_points.data(), gradient.data() + 2 * n * n * n);
  });
  const double integration = operations([&] {
    sweeps.template gradients<0, false, false>(gradient.data(), at_points.data());
    sweeps.template gradients<1, false, true>(gradient.data() + n * n * n, at_points.data());
    sweeps.template gradients<2, false, true>(gradient.data() + 2 * n * n * n, at_points.data());
    sweeps.template values<2, false, false>(at_points.data(), at_points.data());
    sweeps.template values<1, false, false>(at_points.data(), at_points.data());
    sweeps.template values<0, false, false>(at_points.data(), nodal.data());
  });
  return evaluation + integration;
}

/// The operations at a point: the gradient in space by a stored matrix, the stress, its sign, and the product with this
/// matrix and the weight.
double operations_at_point() {
  constexpr double gradient = 9 * (3 + 2), submitted = 9 * (3 + 2 + 1), signs = 9;
  const double stress = operations([] { materials::CiarletGeymonat{1, 0}.stress(materials::Tensor<Counted>{}); });
  return gradient + stress + signs + submitted;
}

template <int degree>
CellCost fe_cost_up_to(int wanted) {
  constexpr int n = degree + 1, n_points = n * n * n;
  if (wanted == degree)
    return {3 * sweeps_of_component<n>() + n_points * operations_at_point(), n_points * (10 * 8.0 + 3 * 4.0)};
  if constexpr (degree > 2) return fe_cost_up_to<degree - 1>(wanted);
  throw std::invalid_argument("no cost known of that degree");
}

}  // namespace

CellCost fe_evaluation_cost(int degree) { return fe_cost_up_to<8>(degree); }

}  // namespace pseudorigid::benchmarks
