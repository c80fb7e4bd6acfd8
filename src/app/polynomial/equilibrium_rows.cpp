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

/// The setup of the whole body, without symmetry planes, and with only those loads that a figure has.
polynomial::BodySetup of_whole_body(const polynomial::FigureSetup& setup) {
  polynomial::BodySetup whole = polynomial::acting_setup(setup);
  whole.reflect = {};
  return whole;
}

}  // namespace

std::vector<scene::Column> polynomial_equilibria_columns() {
  return figure_columns("N of the polynomial body",
                        "of the same motions: azimuthal number on a spheroid, and on an ellipsoid 0 if even under the "
                        "half turn about axis 3, otherwise 1; -1 if none grows");
}

EquilibriumRows::EquilibriumRows(const polynomial::FigureSetup& setup, const polynomial::FigureSpectrum& spectrum)
    : body_(setup.incompressible ? Body(polynomial::IncompressibleBody(of_whole_body(setup)))
                                 : Body(polynomial::CompressibleBody(of_whole_body(setup)))),
      drive_(setup.drive),
      spectrum_(spectrum) {}

/// Sets the observables of a figure in the inertial frame. Fails if they cannot be computed.
mechanics::Status EquilibriumRows::observe(const mechanics::EquilibriumFigure& figure,
                                           mechanics::ContinuumObservables& o) const {
  mechanics::ObservableRequest request;
  request.multiplier = false;
  const Eigen::VectorXd x = spectrum_.whole(figure.x);
  return std::visit(
      [&]<class Body>(const Body& body) {
        polynomial::BodyState state{0, x, body.make_vector()};
        state.v = spectrum_.spin(figure) * polynomial::Turns(body.space()).of_space(2, x);
        auto workspace = body.make_workspace();
        if (auto status = polynomial::observe(body, state, workspace, request, o); !status) return status;
        if constexpr (std::is_same_v<Body, polynomial::IncompressibleBody>)
          o.multiplier = body.mean_multiplier(x, spectrum_.whole_multiplier(figure.lambda));
        if (drive_ == mechanics::Drive::loads) o.external *= figure.drive;
        return mechanics::Status();
      },
      body_);
}

mechanics::Status EquilibriumRows::row(int index, const FigureMember& member, const polynomial::SpecialFigure* special,
                                       std::vector<double>& row) const {
  const polynomial::PolynomialSpace& space = spectrum_.space();
  const Eigen::VectorXd x = spectrum_.whole(member.figure.x);
  mechanics::ContinuumObservables o;
  if (auto status = observe(member.figure, o); !status) return status;
  FigureNumbers numbers{
      space.degree(), spectrum_.spin(member.figure), o.Q.diagonal().cwiseProduct(space.semi_axes()), {}, o};
  for (int i = 0; i < 3; ++i) {
    std::array<double, 3> xi{0, 0, 0};
    xi[i] = 1;
    numbers.surface[i] = space.value(space.functions_at(xi), x)[i];
  }
  row = figure_row(index, member, special, numbers);
  return {};
}

}  // namespace pseudorigid::app
