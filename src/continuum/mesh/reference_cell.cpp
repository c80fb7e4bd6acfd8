#include "continuum/mesh/reference_cell.h"

#include <deal.II/base/quadrature_lib.h>

namespace pseudorigid::continuum {

double lagrange(const std::vector<double>& x, std::size_t i, double y) {
  double product = 1;
  for (std::size_t j = 0; j < x.size(); ++j)
    if (j != i) product *= (y - x[j]) / (x[i] - x[j]);
  return product;
}

double lagrange_derivative(const std::vector<double>& x, std::size_t i, double y) {
  double sum = 0;
  for (std::size_t m = 0; m < x.size(); ++m) {
    if (m == i) continue;
    double product = 1 / (x[i] - x[m]);
    for (std::size_t j = 0; j < x.size(); ++j)
      if (j != i && j != m) product *= (y - x[j]) / (x[i] - x[j]);
    sum += product;
  }
  return sum;
}

namespace {

void unpack(const dealii::Quadrature<1>& rule, std::vector<double>& points, std::vector<double>& weights) {
  for (const auto& p : rule.get_points()) points.push_back(p[0]);
  weights = rule.get_weights();
}

}  // namespace

ReferenceCell::ReferenceCell(int degree) : n(degree + 1) {
  unpack(dealii::QGaussLobatto<1>(n), nodes, node_weights);
  unpack(dealii::QGauss<1>(n), points, point_weights);
  for (int q = 0; q < n; ++q)
    for (int i = 0; i < n; ++i) {
      interpolate.push_back(lagrange(nodes, i, points[q]));
      differentiate.push_back(lagrange_derivative(points, i, points[q]));
      differentiate_at_nodes.push_back(lagrange_derivative(nodes, i, nodes[q]));
    }
}

}  // namespace pseudorigid::continuum
