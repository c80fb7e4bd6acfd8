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
using polynomial::RotationMember;

constexpr std::size_t slowest = 10;  // number of complex rates in a row of the file

/// Index of the rotation about axis 3 among the symmetries of the whole body.
constexpr int about_axis_3 = 2;

/// The ten rates s of lowest frequency |Im s| among the rates of all classes of motions, by rising frequency. If there
/// are fewer rates, the others are 0.
std::vector<mechanics::Rate> slowest_rates(const RotationMember& member) {
  std::vector<mechanics::Rate> rates;
  for (const ClassStability& of_class : member.classes)
    rates.insert(rates.end(), of_class.stability.rates.begin(), of_class.stability.rates.end());
  std::ranges::stable_sort(rates, [](const auto& a, const auto& b) {
    return std::abs(a.s.imag()) != std::abs(b.s.imag()) ? std::abs(a.s.imag()) < std::abs(b.s.imag())
                                                        : a.s.imag() > b.s.imag();
  });
  rates.resize(slowest);  // missing rates are 0
  return rates;
}

/// The number of negative directions of the energy, added over all classes of motions.
int negative_directions(const RotationMember& member) {
  int n = 0;
  for (const ClassStability& of_class : member.classes) n += of_class.stability.n_negative;
  return n;
}

/// The setup of the whole body, without symmetry planes. It has only the loads that a steady rotation can have.
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

const ClassStability* fastest_growing(const RotationMember& member) {
  const ClassStability* fastest = nullptr;
  for (const ClassStability& of_class : member.classes)
    if (of_class.stability.growth_rate > (fastest ? fastest->stability.growth_rate : 0)) fastest = &of_class;
  return fastest;
}

std::vector<scene::Column> polynomial_equilibria_columns() {
  std::vector<scene::Column> columns{
      {"index", "", "number of the row: degree by degree, by rising parameter"},
      {"degree", "", "N of the polynomial body"},
      {"kind", "",
       "0: a member of the family. Special points between two members: 1 fold (its spin has an extremum), 3 index "
       "(n_negative changes: a branch may leave, and dissipation decides), 4 instability (a growth rate begins or "
       "ends)"},
      {"parameter", "",
       "the family's: eccentricity (maclaurin) and a3 in radii at volume 1 (spheroids), from the ratio of the axes a1 "
       "and a3; spin [1/time] (spinning) or a2/a1 (jacobi)"},
      {"omega3", "1/time", "rate at which the figure turns about its axis 3"}};
  const auto vector = [&](const char* name, scene::Unit unit, const char* documentation) {
    for (int i = 1; i <= 3; ++i)
      columns.push_back({fmt::format("{}{}", name, i), unit, i == 1 ? documentation : "as for axis 1"});
  };
  vector("a", "length", "semi-axis along axis 1 of the ellipsoid x = Q X nearest in the mean");
  vector("surface", "length", "where the surface cuts axis 1");
  columns.insert(
      columns.end(),
      {{"kinetic", "mass*length^2/time^2", "kinetic energy"},
       {"potential", "mass*length^2/time^2", "potential energy"},
       {"energy", "mass*length^2/time^2", "their sum"},
       {"J3", "mass*length^2/time", "angular momentum"},
       {"Z3", "mass*length^2/time", "circulation"},
       {"multiplier", "1/time^2", "integral of the pressure per m_bar: the multiplier of the pseudo-rigid body"},
       {"nonaffine_displacement", "", "|x - Q X| / |x|, norms weighted with the mass"},
       {"min_jacobian", "", "least det F at the integration points"},
       {"growth_rate", "1/time", "largest real part of the rates; 0 if stable"},
       {"stable", "", "1: no disturbance grows; to first order, among the motions of this degree"},
       {"n_negative", "",
        "negative directions of the energy at fixed J and Z, of a fluid at fixed circulations; 0: stable even with "
        "dissipation"},
       {"odd_in_z", "",
        "of the motions in which a special point happens, or that grow fastest: 1 if odd under the reflection of axis "
        "3, otherwise 0; -1 if none grows"},
       {"m", "",
        "of the same motions: azimuthal number on a spheroid, and on an ellipsoid 0 if even under the half turn about "
        "axis 3, otherwise 1; -1 if none grows"}});
  for (std::size_t k = 1; k <= slowest; ++k) {
    columns.push_back(
        {fmt::format("rate_{}_re", k), "1/time",
         k > 1 ? "as for rate_1_re"
               : "real part of a rate s of small motions exp(s t) in the turning frame: the slowest, by rising "
                 "frequency, 0 beyond the last. Turns and exchanges of matter within a fluid are left out"});
    columns.push_back({fmt::format("rate_{}_im", k), "1/time", k > 1 ? "as for rate_1_im" : "its imaginary part"});
  }
  columns.push_back({"residual", "",
                     "residual of the equations of the figure, in their largest term; for a fluid the error of the "
                     "quadrature of gravity"});
  return columns;
}

EquilibriumRows::EquilibriumRows(const polynomial::BodySetup& setup, bool incompressible,
                                 const polynomial::RotationSpectrum& spectrum)
    : body_(incompressible ? Body(polynomial::IncompressibleBody(of_whole_body(setup, true)))
                           : Body(polynomial::CompressibleBody(of_whole_body(setup, false)))),
      spectrum_(spectrum) {}

/// Sets the observables of the figure that rotates about axis 3 with the rate `spin`, in the inertial frame.
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

mechanics::Status EquilibriumRows::row(int index, const RotationMember& member,
                                       const polynomial::SpecialRotation* special, std::vector<double>& row) const {
  const polynomial::PolynomialSpace& space = spectrum_.space();
  const Eigen::VectorXd x = spectrum_.whole(member.rotation.x);
  const double spin = std::sqrt(member.rotation.spin_squared);
  mechanics::ContinuumObservables o;
  if (auto status = observe(x, spin, o); !status) return status;
  row = {static_cast<double>(index), static_cast<double>(space.degree()),
         special ? 1.0 + static_cast<int>(special->kind) : 0.0, member.parameter, spin};
  for (int i = 0; i < 3; ++i) row.push_back(o.Q(i, i) * space.semi_axes()[i]);
  for (int i = 0; i < 3; ++i) {
    std::array<double, 3> xi{0, 0, 0};
    xi[i] = 1;
    row.push_back(space.value(space.functions_at(xi), x)[i]);
  }
  const ClassStability* growing = fastest_growing(member);
  std::optional<polynomial::MotionClass> motions;
  if (special)
    motions = special->motions;
  else if (growing)
    motions = growing->motions;
  row.insert(
      row.end(),
      {o.kinetic, o.energy() - o.kinetic, o.energy(), o.angular_momentum[2], o.circulation[2], o.multiplier,
       o.nonaffine_displacement, o.min_jacobian, growing ? growing->stability.growth_rate : 0.0, growing ? 0.0 : 1.0,
       static_cast<double>(negative_directions(member)), motions ? static_cast<double>(motions->odd_in_z) : -1.0,
       motions ? static_cast<double>(motions->m) : -1.0});
  for (const mechanics::Rate& rate : slowest_rates(member)) row.insert(row.end(), {rate.s.real(), rate.s.imag()});
  row.push_back(member.rotation.residual);
  return {};
}

}  // namespace pseudorigid::app
