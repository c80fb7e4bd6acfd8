#include "polynomial/point_tables.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

#include "polynomial/dense_kernels.h"
#include "polynomial/scratch.h"

namespace pseudorigid::polynomial {
namespace {

/// Direct sums are used for a parity if the number of its functions times the number of points of an octant is at most
/// this number. In measurements with vectors of 8 numbers, direct sums took 0.6 times the time of the factored sums for
/// degree 5 (product 640). For degree 7 (product 2560), both took the same time.
constexpr double cheap_directly = 1500;

double along(const Jet& jet, const std::array<double, 3>& direction) {
  return jet.gradient[0] * direction[0] + jet.gradient[1] * direction[1] + jet.gradient[2] * direction[2];
}

/// Returns a harmonic Y and its derivatives along e_θ and e_φ on the unit sphere. `jet` has Y and its gradient.
std::array<double, 3> angular_terms(const Jet& jet, const SurfacePoint& direction) {
  return {jet.value, along(jet, direction.e_theta), along(jet, direction.e_phi)};
}

std::vector<int> shifts(Fields fields, const std::vector<int>& free_axes) {
  std::vector<int> shift(fields == Fields::value ? 1 : 3, 0);
  if (fields == Fields::gradient)
    for (std::size_t b = 0; b < free_axes.size(); ++b) shift[free_axes[b]] = 1 << b;
  return shift;
}

}  // namespace

PointTables::PointTables(int degree, Fields fields, const Eigen::Vector3d& semi_axes, const PointGrid& grid,
                         const std::vector<int>& free_axes, const std::vector<Block>& blocks)
    : fields_(fields),
      degree_(degree),
      n_radii_(grid.n_radii()),
      n_directions_(grid.n_directions()),
      width_(filled_up(n_directions_)),
      stride_(filled_up(n_radii_ * n_directions_)),
      n_images_(1 << free_axes.size()),
      shift_(shifts(fields, free_axes)) {
  if (fields == Fields::gradient) set_frames(semi_axes, grid);
  const std::vector<BallPolynomial> functions = ball_polynomials(degree);
  for (const Block& block : blocks) {
    Factors& factors = factors_[block.parity];
    if (factors.n_groups > 0) continue;
    Groups groups;
    for (const int a : block.functions)
      if (functions[a].n == functions[a].l) groups.emplace_back(functions[a].l, functions[a].m);
    set_radial(block, functions, groups, grid, 1 / std::sqrt(semi_axes.prod()), factors);
    set_angular(groups, grid, factors);
    if (static_cast<double>(block.n()) * stride_ <= cheap_directly) set_rows(block, factors);
    if (fields == Fields::gradient) set_linear(block, functions, semi_axes, factors);
  }
}

void PointTables::set_rows(const Block& block, Factors& f) const {
  std::array<std::vector<double>, 3> rows;
  for (int field = 0; field < n_fields(); ++field)
    for (int a = 0; a < block.n(); ++a) {
      const std::vector<double> of_function = row(block, a, field);
      rows[field].insert(rows[field].end(), of_function.begin(), of_function.end());
    }
  f.rows = std::move(rows);
}

/// The linear function is φ = √5 X_k/(s_k √V) with the semi-axes s_k and the volume V, because ∫X_k² dX = s_k² V/5.
void PointTables::set_linear(const Block& block, const std::vector<BallPolynomial>& functions,
                             const Eigen::Vector3d& semi_axes, Factors& f) const {
  const double volume = 4.0 / 3.0 * std::numbers::pi * semi_axes.prod();
  for (int k = 0; k < block.n(); ++k) {
    if (functions[block.functions[k]].n != 1) continue;
    f.linear = k;
    f.linear_field = std::countr_zero(block.parity);
    f.linear_gradient = 1 / std::sqrt(volume / 5 * semi_axes[f.linear_field] * semi_axes[f.linear_field]);
  }
}

/// Sets the coefficients D_kt in ∂/∂X_k = Σ_t D_kt ∂_t at each direction, with the derivatives ∂_t along e_r, e_θ, e_φ.
void PointTables::set_frames(const Eigen::Vector3d& semi_axes, const PointGrid& grid) {
  frames_.assign(static_cast<std::size_t>(9) * width_, 0.0);
  for (int s = 0; s < n_directions_; ++s) {
    const SurfacePoint& direction = grid.directions[s];
    const std::array frame{direction.xi, direction.e_theta, direction.e_phi};
    for (int k = 0; k < 3; ++k)
      for (int t = 0; t < 3; ++t)
        frames_[static_cast<std::size_t>(3 * k + t) * width_ + s] = frame[t][k] / semi_axes[k];
  }
}

void PointTables::set_radial(const Block& block, const std::vector<BallPolynomial>& functions, const Groups& groups,
                             const PointGrid& grid, double scale, Factors& f) const {
  f.n_groups = static_cast<int>(groups.size());
  f.n_filled = filled_up(f.n_groups);
  for (const int a : block.functions) {
    const auto& [n, l, m] = functions[a];
    const int level = (n - l) / 2;
    const auto group = static_cast<int>(std::ranges::find(groups, std::pair(l, m)) - groups.begin());
    f.places.push_back(level * f.n_filled + group);
    f.n_levels = std::max(f.n_levels, level + 1);
  }
  for (auto& radial : f.radial) radial.assign(f.size() * n_radii_, 0.0);
  for (int k = 0; k < block.n(); ++k) {
    const auto& [n, l, m] = functions[block.functions[k]];
    if (fields_ == Fields::gradient && n == 1) continue;
    const int level = f.places[k] / f.n_filled, group = f.places[k] % f.n_filled;
    for (int j = 0; j < n_radii_; ++j) {
      const Jet R = radial_factor(n, l, grid.radii[j]);
      const std::size_t at = (static_cast<std::size_t>(level) * n_radii_ + j) * f.n_filled + group;
      f.radial[0][at] = scale * (fields_ == Fields::gradient ? R.gradient[0] : R.value);
      f.radial[1][at] = scale * R.value / grid.radii[j];
    }
  }
}

void PointTables::set_angular(const Groups& groups, const PointGrid& grid, Factors& f) const {
  for (int t = 0; t < n_fields(); ++t) {
    f.angular[t].assign(static_cast<std::size_t>(f.n_groups) * width_, 0.0);
    f.from_directions[t].assign(static_cast<std::size_t>(n_directions_) * f.n_filled, 0.0);
  }
  int degree = 0;
  for (const auto& [l, m] : groups) degree = std::max(degree, l);
  for (int s = 0; s < n_directions_; ++s) {
    const auto harmonics = solid_harmonics(degree, grid.directions[s].xi);
    for (int g = 0; g < f.n_groups; ++g) {
      const auto& [l, m] = groups[g];
      const std::array terms = angular_terms(harmonics[l][l + m], grid.directions[s]);
      for (int t = 0; t < n_fields(); ++t) {
        f.angular[t][static_cast<std::size_t>(g) * width_ + s] = terms[t];
        f.from_directions[t][static_cast<std::size_t>(s) * f.n_filled + g] = terms[t];
      }
    }
  }
}

double PointTables::n_multiplications(const Block& block) const {
  const Factors& f = factors_[block.parity];
  if (!f.rows[0].empty()) return static_cast<double>(n_fields()) * block.n() * stride_;
  const double of_frames = fields_ == Fields::gradient ? 9.0 * stride_ : 0, n_radial = radial_of(n_fields() - 1) + 1;
  return n_radii_ * (n_fields() * static_cast<double>(f.n_groups) * width_ + n_radial * static_cast<double>(f.size())) +
         of_frames;
}

void PointTables::transform(int n_components, double* y) const {
  if (n_images_ == 1) return;
  for (int k = 0; k < n_components * n_fields(); ++k)
    dense().transform_images(y + static_cast<std::size_t>(k) * n_points(), n_images_, stride_);
}

void PointTables::evaluate_sums(const Factors& f, const double* c, double* const* y) const {
  const int n_terms = n_fields(), n_points = n_radii_ * n_directions_;
  const std::size_t term = static_cast<std::size_t>(n_radii_) * width_;
  ScratchArray by_level(f.size()), u(static_cast<std::size_t>(n_radii_) * f.n_filled), z(n_terms * term);
  std::fill_n(static_cast<double*>(by_level), f.size(), 0.0);
  for (std::size_t k = 0; k < f.places.size(); ++k) by_level[f.places[k]] = c[k];
  for (int t = 0; t < n_terms; ++t) {
    if (t == 0 || radial_of(t) != radial_of(t - 1))
      dense().combine_radially(f.radial[radial_of(t)].data(), f.n_levels, n_radii_, f.n_filled, by_level, u);
    dense().multiply(u, f.n_filled, n_radii_, f.angular[t].data(), f.n_groups, width_, z + t * term, false);
  }
  if (fields_ == Fields::gradient) {
    dense().fields_of_terms(frames_.data(), n_radii_, n_directions_, width_, z, y);
  } else {
    for (int t = 0; t < n_terms; ++t)
      for (int j = 0; j < n_radii_; ++j)
        std::copy_n(z + t * term + static_cast<std::size_t>(j) * width_, n_directions_, y[t] + j * n_directions_);
  }
  for (int t = 0; t < n_terms; ++t) std::fill(y[t] + n_points, y[t] + stride_, y[t][n_points - 1]);
}

void PointTables::add_transposed_sums(const Factors& f, const double* const* y, double* c) const {
  const int n_terms = n_fields(), n_radial = radial_of(n_terms - 1) + 1;
  const std::size_t term = static_cast<std::size_t>(n_radii_) * n_directions_;
  const std::size_t sums = static_cast<std::size_t>(n_radii_) * f.n_filled;
  ScratchArray by_level(f.size()), z(n_terms * term), u(n_radial * sums);
  std::fill_n(static_cast<double*>(by_level), f.size(), 0.0);
  if (fields_ == Fields::gradient)
    dense().terms_of_fields(frames_.data(), n_radii_, n_directions_, width_, y, z);
  else
    for (int t = 0; t < n_terms; ++t) std::copy_n(y[t], term, z + t * term);
  for (int t = 0; t < n_terms; ++t) {
    const bool add = t > 0 && radial_of(t) == radial_of(t - 1);
    dense().multiply(z + t * term, n_directions_, n_radii_, f.from_directions[t].data(), n_directions_, f.n_filled,
                     u + radial_of(t) * sums, add);
  }
  for (int r = 0; r < n_radial; ++r)
    dense().contract_radially(f.radial[r].data(), f.n_levels, n_radii_, f.n_filled, u + r * sums, by_level);
  for (std::size_t k = 0; k < f.places.size(); ++k) c[k] += by_level[f.places[k]];
}

void PointTables::evaluate_octant(const Factors& f, const double* c, double* const* y) const {
  if (is_constant())
    for (int field = 0; field < n_fields(); ++field) std::fill_n(y[field], stride_, 0.0);
  else if (!f.rows[0].empty())
    for (int field = 0; field < n_fields(); ++field)
      dense().combine(f.rows[field].data(), static_cast<int>(f.places.size()), stride_, c, y[field]);
  else
    evaluate_sums(f, c, y);
  if (f.linear < 0) return;
  Eigen::Map<Eigen::VectorXd>(y[f.linear_field], stride_).array() += f.linear_gradient * c[f.linear];
}

void PointTables::add_transposed_octant(const Factors& f, const double* const* y, double* c) const {
  if (!f.rows[0].empty() && !is_constant())
    for (int field = 0; field < n_fields(); ++field)
      dense().contract(f.rows[field].data(), static_cast<int>(f.places.size()), stride_, y[field], c);
  else if (!is_constant())
    add_transposed_sums(f, y, c);
  if (f.linear < 0) return;
  const int n_points = n_radii_ * n_directions_;
  c[f.linear] += f.linear_gradient * Eigen::Map<const Eigen::VectorXd>(y[f.linear_field], n_points).sum();
}

void PointTables::evaluate(const std::vector<Block>& blocks, int n_components, const double* c, double* y) const {
  for (const Block& block : blocks) {
    std::array<double*, 3> fields{};
    for (int field = 0; field < n_fields(); ++field) fields[field] = y + place(block, field);
    evaluate_octant(factors_[block.parity], c + block.offset, fields.data());
  }
  transform(n_components, y);
}

void PointTables::add_transposed(const std::vector<Block>& blocks, int n_components, double* y, double* c) const {
  transform(n_components, y);
  for (const Block& block : blocks) {
    std::array<const double*, 3> fields{};
    for (int field = 0; field < n_fields(); ++field) fields[field] = y + place(block, field);
    add_transposed_octant(factors_[block.parity], fields.data(), c + block.offset);
  }
}

std::vector<double> PointTables::row(const Block& block, int function, int field) const {
  std::vector<double> unit(block.n(), 0.0);
  unit[function] = 1;
  std::array<std::vector<double>, 3> values;
  std::array<double*, 3> fields{};
  for (int k = 0; k < n_fields(); ++k) {
    values[k].resize(stride_);
    fields[k] = values[k].data();
  }
  evaluate_octant(factors_[block.parity], unit.data(), fields.data());
  return values[field];
}

}  // namespace pseudorigid::polynomial
