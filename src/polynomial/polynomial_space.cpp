#include "polynomial/polynomial_space.h"

#include <bit>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "polynomial/dense_kernels.h"
#include "polynomial/octant_quadrature.h"

namespace pseudorigid::polynomial {
namespace {

/// The image of ξ under the reflections of the free axes whose bits are set in `slot`. Free axes are those without a
/// symmetry plane.
std::array<double, 3> image(std::array<double, 3> xi, int slot, const std::vector<int>& free_axes) {
  for (std::size_t b = 0; b < free_axes.size(); ++b)
    if (slot >> b & 1) xi[free_axes[b]] = -xi[free_axes[b]];
  return xi;
}

std::vector<int> axes_without_plane(const std::array<bool, 3>& reflect) {
  std::vector<int> axes;
  for (int i = 0; i < 3; ++i)
    if (!reflect[i]) axes.push_back(i);
  return axes;
}

/// Appends copies of the last point with weight 0, up to a whole number of blocks of point_block points.
void fill_up(std::vector<WeightedPoint>& points) {
  WeightedPoint last = points.back();
  last.weight = 0;
  points.resize(filled_up(static_cast<int>(points.size())), last);
}

/// The points of octant_points(q), as a product of radii and directions.
PointGrid octant_grid(int q) { return {half_gauss_rule(q).nodes, octant_surface_points(q)}; }

}  // namespace

PolynomialSpace::PolynomialSpace(int degree, const std::array<bool, 3>& reflect, const Eigen::Vector3d& semi_axes,
                                 std::optional<int> n_points)
    : degree_(degree),
      grid_(octant_grid(n_points.value_or(least_points(degree)))),
      reflect_(reflect),
      semi_axes_(semi_axes),
      volume_(4.0 / 3.0 * std::numbers::pi * semi_axes.prod()),
      free_axes_(axes_without_plane(reflect)),
      n_images_(1 << free_axes_.size()),
      functions_(ball_polynomials(degree)),
      blocks_(make_blocks(3, degree, places_, n_unknowns_)),
      pressure_blocks_(make_blocks(1, degree - 1, pressure_places_, n_pressures_)),
      gradients_(make_tables(Fields::gradient, blocks_)),
      values_(make_tables(Fields::value, blocks_)),
      pressures_(make_tables(Fields::value, pressure_blocks_)) {  // ψ = φ, because ρ = 1
  inertia_ = volume_ / 5 * semi_axes.cwiseAbs2();
  std::vector<WeightedPoint> octant = octant_points(n_points_in_direction());
  fill_up(octant);
  for (int slot = 0; slot < n_images_; ++slot)
    for (const WeightedPoint& point : octant) {
      points_.push_back(image(point.xi, slot, free_axes_));
      weights_.push_back(point.weight * semi_axes.prod() * n_mirrors());
    }
  integrated_gradients_ = Eigen::MatrixXd::Zero(3, static_cast<Eigen::Index>(functions_.size()));
  for (const WeightedPoint& point : octant) {
    const std::vector<Jet> jets = functions_at(point.xi);
    for (std::size_t a = 0; a < jets.size(); ++a)
      for (int k = 0; k < 3; ++k)
        if (functions_[a].parity() == 1U << k)  // the derivatives of other functions are odd in some coordinate
          integrated_gradients_(k, static_cast<Eigen::Index>(a)) +=
              8 * point.weight * semi_axes.prod() * jets[a].gradient[k];
  }
}

std::vector<Block> PolynomialSpace::make_blocks(int n_components, int degree, std::vector<std::vector<int>>& places,
                                                int& size) const {
  std::vector<Block> blocks;
  size = 0;
  places.assign(n_components, std::vector<int>(functions_.size(), -1));
  for (int i = 0; i < n_components; ++i)
    for (int slot = 0; slot < n_images_; ++slot) {
      Parity parity = n_components == 3 && reflect_[i] ? 1U << i : 0U;
      for (std::size_t b = 0; b < free_axes_.size(); ++b)
        if (slot >> b & 1) parity |= 1U << free_axes_[b];
      Block block{i, parity, slot, size, {}};
      for (std::size_t a = 0; a < functions_.size(); ++a)
        if (functions_[a].n <= degree && functions_[a].parity() == parity) {
          places[i][a] = size++;
          block.functions.push_back(static_cast<int>(a));
        }
      blocks.push_back(std::move(block));
    }
  return blocks;
}

PointTables PolynomialSpace::make_tables(Fields fields, const std::vector<Block>& blocks) const {
  return {degree_, fields, semi_axes_, grid_, free_axes_, blocks};
}

PointTables PolynomialSpace::surface_tables(int q) const {
  return {degree_, Fields::surface, semi_axes_, {{1.0}, octant_surface_points(q)}, free_axes_, blocks_};
}

PointTables PolynomialSpace::surface_values(int q) const {
  return {degree_, Fields::value, semi_axes_, {{1.0}, octant_surface_points(q)}, free_axes_, blocks_};
}

std::vector<Jet> PolynomialSpace::functions_at(const std::array<double, 3>& xi) const {
  std::vector<Jet> jets = evaluate_ball_polynomials(degree_, xi);
  const double scale = 1 / std::sqrt(semi_axes_.prod());
  for (Jet& jet : jets) {
    jet.value *= scale;
    for (int k = 0; k < 3; ++k) jet.gradient[k] *= scale / semi_axes_[k];
  }
  return jets;
}

double PolynomialSpace::orientation(int image) const {
  return std::popcount(static_cast<unsigned int>(image)) % 2 == 0 ? 1.0 : -1.0;
}

int PolynomialSpace::linear_function(int axis) const {
  int a = 1;
  while (functions_[a].parity() != 1U << axis) ++a;
  return a;
}

void PolynomialSpace::set_affine(const Eigen::Matrix3d& A, const Eigen::Vector3d& c,
                                 Eigen::Ref<Eigen::VectorXd> x) const {
  for (int i = 0; i < 3; ++i) {
    if (const int at = place(i, 0); at >= 0) x[at] = c[i] * std::sqrt(volume_);
    for (int j = 0; j < 3; ++j)
      if (const int at = place(i, linear_function(j)); at >= 0) x[at] = A(i, j) * std::sqrt(inertia_[j]);
  }
}

Eigen::Matrix3d PolynomialSpace::affine_part(const Eigen::Ref<const Eigen::VectorXd>& x) const {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (const int at = place(i, linear_function(j)); at >= 0) A(i, j) = x[at] / std::sqrt(inertia_[j]);
  return A;
}

Eigen::Vector3d PolynomialSpace::mean(const Eigen::Ref<const Eigen::VectorXd>& x) const {
  Eigen::Vector3d c = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i)
    if (const int at = place(i, 0); at >= 0) c[i] = x[at] / std::sqrt(volume_);
  return c;
}

Eigen::Matrix3d PolynomialSpace::moment(const Eigen::Ref<const Eigen::VectorXd>& a,
                                        const Eigen::Ref<const Eigen::VectorXd>& b) const {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (std::size_t f = 0; f < functions_.size(); ++f) {
        const int at_i = places_[i][f], at_j = places_[j][f];
        if (at_i >= 0 && at_j >= 0) sum(i, j) += a[at_i] * b[at_j];
      }
  return sum;
}

void PolynomialSpace::add_uniform_stress(const Eigen::Matrix3d& P, Eigen::Ref<Eigen::VectorXd> f) const {
  for (int i = 0; i < 3; ++i)
    for (std::size_t a = 0; a < functions_.size(); ++a)
      if (const int at = places_[i][a]; at >= 0)
        f[at] += P.row(i).dot(integrated_gradients_.col(static_cast<Eigen::Index>(a)));
}

PointValues PolynomialSpace::values_at_points(const Eigen::Ref<const Eigen::VectorXd>& x) const {
  PointValues values(n_points(), 3);
  values_.evaluate(blocks_, 3, x.data(), values.data());
  return values;
}

Eigen::Vector3d PolynomialSpace::value(const std::vector<Jet>& functions,
                                       const Eigen::Ref<const Eigen::VectorXd>& x) const {
  Eigen::Vector3d u = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i)
    for (std::size_t a = 0; a < functions.size(); ++a)
      if (const int at = places_[i][a]; at >= 0) u[i] += x[at] * functions[a].value;
  return u;
}

Eigen::Matrix3d PolynomialSpace::gradient(const std::vector<Jet>& functions,
                                          const Eigen::Ref<const Eigen::VectorXd>& x) const {
  Eigen::Matrix3d F = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 3; ++i)
    for (std::size_t a = 0; a < functions.size(); ++a)
      if (const int at = places_[i][a]; at >= 0)
        for (int k = 0; k < 3; ++k) F(i, k) += x[at] * functions[a].gradient[k];
  return F;
}

}  // namespace pseudorigid::polynomial
