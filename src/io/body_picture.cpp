#include "io/body_picture.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <array>
#include <cmath>
#include <utility>

#include "io/block_cells.h"
#include "mechanics/core/principal_axes.h"
#include "mechanics/core/von_mises.h"

namespace pseudorigid::io {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/// The rotation nearest to M in the Frobenius norm. The rotation is U diag(1, 1, ±1) Vᵀ with the singular value
/// decomposition M = U diag(σ) Vᵀ and the sign that gives the determinant 1.
Matrix3d rotation_of(const Matrix3d& M) {
  const Eigen::JacobiSVD<Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  return svd.matrixU() * Vector3d(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
}

std::vector<double> scaled(std::vector<double> values, double unit) {
  for (double& value : values) value *= unit;
  return values;
}

/// Adds fields over the points of a body to a grid. The argument `value_at` is a function that returns the value at
/// point i, in the units of the user.
class Fields {
 public:
  Fields(const mechanics::BodyFields& body, UnstructuredGrid& grid) : body_(body), grid_(grid) {}

  void add(const char* name, int n_components, std::vector<double> values) {
    grid_.fields.push_back({name, n_components, std::move(values)});
  }
  template <class Value>
  void add_scalar(const char* name, Value&& value_at) {
    std::vector<double> values(body_.n_points());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = value_at(i);
    add(name, 1, std::move(values));
  }
  template <class Value>
  void add_vector(const char* name, Value&& value_at) {
    std::vector<double> values(3 * body_.n_points());
    for (std::size_t i = 0; i < body_.n_points(); ++i) Vector3d::Map(&values[3 * i]) = value_at(i);
    add(name, 3, std::move(values));
  }

 private:
  const mechanics::BodyFields& body_;
  UnstructuredGrid& grid_;
};

/// Calls visit(point) for the points of the surface: of all block faces whose four corners are on the ellipsoid of the
/// reference surface. The other points of such a face need not be on the ellipsoid, because a polynomial may
/// approximate the ellipsoid. `X` has the reference positions. A point that several faces share is visited several
/// times.
template <class Visit>
void for_points_on_surface(const mechanics::PointBlocks& blocks, const std::vector<double>& X,
                           const Vector3d& semi_axes, Visit&& visit) {
  constexpr double nearly_one = 1 - 1e-9;
  const int m = blocks.degree, n = m + 1;
  for (std::size_t block = 0; block < blocks.n_blocks(); ++block)
    for (int d = 0; d < 3; ++d)
      for (const int end : {0, m}) {
        const auto point = [&](int a, int b) {
          const std::array<int, 3> at = d == 0   ? std::array{end, a, b}
                                        : d == 1 ? std::array{b, end, a}
                                                 : std::array{a, b, end};
          return blocks.points[block * blocks.points_per_block() + (at[2] * n + at[1]) * n + at[0]];
        };
        bool on_surface = true;
        for (const int a : {0, m})
          for (const int b : {0, m})
            on_surface = on_surface && Vector3d::Map(&X[3 * point(a, b)]).cwiseQuotient(semi_axes).norm() > nearly_one;
        if (!on_surface) continue;
        for (int a = 0; a < n; ++a)
          for (int b = 0; b < n; ++b) visit(static_cast<std::size_t>(point(a, b)));
      }
}

/// The sum of the pressures of the planes at each point, in internal units. The pressure is 0 at points that are not on
/// the surface.
std::vector<double> contact_pressure(const mechanics::PointBlocks& blocks, const mechanics::BodyFields& body,
                                     const PicturedContact& contact) {
  std::vector<double> pressure(body.n_points(), 0.0);
  for_points_on_surface(blocks, body.X, contact.semi_axes, [&](std::size_t i) {
    pressure[i] = 0;  // the point may have been visited before
    for (const loads::Plane& plane : contact.planes)
      pressure[i] += plane.pressure(Vector3d::Map(&body.x[3 * i]), Vector3d::Map(&body.v[3 * i]));
  });
  return pressure;
}

}  // namespace

UnstructuredGrid body_picture(const mechanics::PointBlocks& blocks, const mechanics::BodyFields& body, double time,
                              const Units& units, const scene::Fields& wanted, scene::Cells cells,
                              const PicturedContact& contact) {
  const Matrix3d R = rotation_of(body.moment);
  const auto X = [&](std::size_t i) { return Vector3d::Map(&body.X[3 * i]); };
  const auto x = [&](std::size_t i) { return Vector3d::Map(&body.x[3 * i]); };
  const auto F = [&](std::size_t i) { return RowMajor::Map(&body.F[9 * i]); };
  const auto stress = [&](std::size_t i) { return RowMajor::Map(&body.stress[9 * i]); };

  UnstructuredGrid grid;
  grid.points = scaled(body.x, units.length);
  set_cells(grid, blocks, cells);
  const Vector3d center = units.length * body.center;
  const RowMajor rotation = R;
  grid.constants = {{"TimeValue", 1, {time}},
                    {"center_of_mass", 3, {center.begin(), center.end()}},
                    {"rotation", 9, {rotation.data(), rotation.data() + rotation.size()}}};

  Fields fields(body, grid);
  if (wanted.displacement) {
    fields.add_vector("displacement", [&](std::size_t i) { return units.length * (x(i) - X(i)); });
    fields.add_vector("displacement_without_rotation",
                      [&](std::size_t i) { return units.length * (x(i) - body.center - R * X(i)); });
    fields.add("reference_coordinates", 3, scaled(body.X, units.length));
  }
  if (wanted.velocity) fields.add("velocity", 3, scaled(body.v, units.velocity()));
  if (wanted.stress) {
    fields.add("cauchy_stress", 9, scaled(body.stress, units.stress()));
    fields.add_scalar("pressure", [&](std::size_t i) { return -units.stress() * stress(i).trace() / 3; });
    fields.add_scalar("von_mises", [&](std::size_t i) { return units.stress() * mechanics::von_mises(stress(i)); });
    if (!contact.planes.empty())
      fields.add("contact_pressure", 1, scaled(contact_pressure(blocks, body, contact), units.stress()));
  }
  if (wanted.deformation) {
    fields.add("deformation_gradient", 9, body.F);
    fields.add_scalar("jacobian", [&](std::size_t i) { return F(i).determinant(); });
    fields.add_vector("principal_stretches", [&](std::size_t i) { return mechanics::singular_values(F(i)); });
  }
  if (wanted.energy) {
    fields.add("energy_density", 1, scaled(body.energy, units.stress()));
    if (!body.potential.empty())
      fields.add("gravity_potential", 1, scaled(body.potential, units.velocity() * units.velocity()));
  }
  return grid;
}

}  // namespace pseudorigid::io
