#include "app/polynomial/equilibrium_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "polynomial/observe.h"

namespace pseudorigid::app {
namespace {

using polynomial::ClassStability;
using polynomial::FigureMember;

/// Index of the rotation about axis 3 among the rotations of space that are symmetries of the whole body.
constexpr int about_axis_3 = 2;

/// The setup of the whole body, without symmetry planes, and with only those loads that a steady rotation can have.
polynomial::BodySetup of_whole_body(polynomial::BodySetup setup, bool incompressible) {
  setup = polynomial::conservative_setup(std::move(setup), incompressible);
  setup.reflect = {};
  return setup;
}

}  // namespace

std::string name_of(const polynomial::MotionClass& motions, polynomial::Figure figure) {
  const char* in_z = motions.odd_in_z ? "odd" : "even";
  if (figure == polynomial::Figure::spheroid) return fmt::format("{} in z, m = {}", in_z, motions.m);
  return fmt::format("{} in z, {} under the half turn", in_z, motions.m == 0 ? "even" : "odd");
}

std::vector<scene::Column> polynomial_equilibria_columns() {
  return figure_columns("N of the polynomial body",
                        "of the same motions: azimuthal number on a spheroid, and on an ellipsoid 0 if even under the "
                        "half turn about axis 3, otherwise 1; -1 if none grows");
}

EquilibriumRows::EquilibriumRows(const polynomial::BodySetup& setup, bool incompressible,
                                 const polynomial::RotationSpectrum& spectrum)
    : body_(incompressible ? Body(polynomial::IncompressibleBody(of_whole_body(setup, true)))
                           : Body(polynomial::CompressibleBody(of_whole_body(setup, false)))),
      spectrum_(spectrum) {}

/// Sets the observables of a figure in the inertial frame. The vector x has the coefficients of the positions, and
/// `spin` is the rate of rotation about axis 3. Fails if the observables cannot be computed.
mechanics::Status EquilibriumRows::observe(const Eigen::VectorXd& x, double spin,
                                           mechanics::ContinuumObservables& observables) const {
  return std::visit(
      [&](const auto& body) {
        polynomial::BodyState state{0, x, body.make_vector()};
        Eigen::VectorXd unused = body.make_vector();
        const Eigen::VectorXd rest = body.make_vector();
        body.symmetry(about_axis_3, x, rest, state.v, unused);
        state.v *= spin;
        auto workspace = body.make_workspace();
        return polynomial::observe(body, state, workspace, {}, observables);
      },
      body_);
}

mechanics::Status EquilibriumRows::row(int index, const FigureMember& member, const polynomial::SpecialFigure* special,
                                       std::vector<double>& row) const {
  const polynomial::PolynomialSpace& space = spectrum_.space();
  const Eigen::VectorXd x = spectrum_.whole(member.figure.x);
  const double spin = std::sqrt(member.figure.drive);
  mechanics::ContinuumObservables o;
  if (auto status = observe(x, spin, o); !status) return status;
  FigureNumbers numbers{space.degree(), spin, o.Q.diagonal().cwiseProduct(space.semi_axes()), {}, o};
  for (int i = 0; i < 3; ++i) {
    std::array<double, 3> xi{0, 0, 0};
    xi[i] = 1;
    numbers.surface[i] = space.value(space.functions_at(xi), x)[i];
  }
  row = figure_row(index, member, special, numbers);
  return {};
}

}  // namespace pseudorigid::app
