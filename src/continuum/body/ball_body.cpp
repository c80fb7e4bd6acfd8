#include "continuum/body/ball_body.h"

#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <utility>
#include <variant>

#include "continuum/body/companion_sums.h"
#include "continuum/parallel/ranks.h"
#include "observables/whole_body.h"

namespace pseudorigid::continuum {
namespace {

/// Number of energies that are integrated with the motion. It is 0 if there is no dissipation, no load depends on time
/// and no plane moves. Otherwise the energies are the dissipated energy, the energy that loads give, and the energy
/// that each branch dissipates.
unsigned int n_accounts(const loads::Loads& loads) {
  const loads::Forcing constant = loads::constant_forcing(loads);
  if (!loads::depend_on_time(loads) && !constant.dissipative()) return 0;
  return 2 + static_cast<unsigned int>(constant.branches.list.size());
}

}  // namespace

BallBody::BallBody(const Sector& sector, int degree, int n_refinements, const StoredEnergy& stored,
                   const loads::Loads& loads, MPI_Comm communicator)
    : BallBody(BallMesh(sector, n_refinements, communicator), degree, stored, loads) {}

BallBody::BallBody(BallMesh mesh, int degree, const StoredEnergy& stored, const loads::Loads& loads,
                   std::optional<int> n_points, std::optional<int> contact_points)
    : space_(std::move(mesh), degree, n_accounts(loads),
             static_cast<unsigned int>(loads::constant_forcing(loads).companions.size())),
      law_(stored.law),
      limit_(materials::limit_of(stored.law)),
      is_fluid_(std::holds_alternative<materials::Fluid>(stored.law)),
      projected_bulk_(stored.projected_bulk),
      kernels_(make_cell_kernels(space_, stored)),
      loads_(loads, space_, *kernels_),
      branches_(loads::constant_forcing(loads).branches),
      volume_(space_.mesh().sector().n_images() * sum_over_ranks(kernels_->reference_volume(), space_.communicator())) {
  if (const double G = loads::constant_forcing(loads).gravity_constant; G > 0)
    gravity_.emplace(G, space_, n_points.value_or(n_gravity_points(space_, is_fluid_)));
  if (const auto planes = loads::constant_forcing(loads).planes; !planes.empty())
    contact_.emplace(planes, space_, contact_points.value_or(n_contact_points(space_)));
  if (const auto forcing = loads::constant_forcing(loads); !forcing.companions.empty())
    orbit_ = mechanics::Orbit(forcing.companions, forcing.gravity_constant, mass());
  if (!loads_.time_dependent())
    free_ = loads::free_motions(loads::constant_forcing(loads), space_.mesh().sector().reflect);
  E0_ = nodal_moment(space_.reference_positions(), space_.reference_positions());
}

namespace {

std::string at(const LeastPlace& place) {
  char text[80];
  std::snprintf(text, sizeof text, " at X/r = (%.3f, %.3f, %.3f)", place.where[0], place.where[1], place.where[2]);
  return text;
}

}  // namespace

std::string in_words(const LeastPlace& jacobian) {
  char text[40];
  std::snprintf(text, sizeof text, "det F = %.3g", jacobian.value);
  return text + at(jacobian);
}

mechanics::Status BallBody::judge(double least, const Vector& x) const {
  least = least_over_ranks(least, space_.communicator());
  if (least > 0 && std::isfinite(least)) return {};
  const LeastPlace jacobian = least_jacobian(x);
  if (!limit_.empty() && jacobian.value > 0)
    return mechanics::Status::failure(materials::beyond_limit(limit_) + at(least_reserve(x)));
  const char* reason = is_fluid_ ? "the mesh of the fluid has tangled, as nothing resists shear: " : "";
  return mechanics::Status::failure(reason + ("an element is turned inside out: " + in_words(jacobian)));
}

double BallBody::bulk_energy(const Vector& x) const {
  if (projected_bulk_ == 0) return 0;
  Vector g = space_.make_multiplier(), b = g;
  const double least = kernels_->constraint(x, g);
  const double energy = least > 0 ? kernels_->bulk(projected_bulk_, g, b) : NAN;
  return space_.mesh().sector().n_images() * sum_over_ranks(energy, space_.communicator());
}

double BallBody::kinetic_energy(const Vector& v) const {
  Vector momentum = v;
  apply_mass(v, momentum);
  return 0.5 * (momentum * v);
}

double BallBody::potential_energy(const Vector& x) const {
  const CellIntegrals sums = integrals(x, make_vector());
  if (!(sums.least > 0)) return HUGE_VAL;
  const int n_images = space_.mesh().sector().n_images();
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> F(&sums.F[0][0]);
  const double of_loads =
      loads_.potential(0, nodal_moment(x, x), mass() * mean(x), whole_ball(F), n_images * sums.volume);
  const double of_whole = bulk_energy(x) + energy_of_branches(x) + of_loads + contact(0, x).energy;
  return sums.elastic + sums.volumetric + (gravity_ ? gravity_->energy(x) : 0) + of_whole / n_images;
}

void BallBody::symmetry(int i, const Vector& x, const Vector& v, Vector& dx, Vector& dv) const {
  const int n_turns = static_cast<int>(free_.turns.size());
  if (i >= n_turns) {
    dx = affine_field(Eigen::Matrix3d::Zero(), Eigen::Vector3d::Unit(free_.translations[i - n_turns]));
    dv = 0.0;
    return;
  }
  const unsigned int axis = free_.turns[i], j = (axis + 1) % 3, k = (axis + 2) % 3;  // (ê×x)_j = −x_k, (ê×x)_k = x_j
  const Eigen::Vector3d x_c = mean(x), v_c = mean(v);
  dx = dv = 0.0;
  for (unsigned int n = 0; n < 3 * space_.n_nodes(); n += 3) {
    dx.local_element(n + j) = x_c[k] - x.local_element(n + k);
    dx.local_element(n + k) = x.local_element(n + j) - x_c[j];
    dv.local_element(n + j) = v_c[k] - v.local_element(n + k);
    dv.local_element(n + k) = v.local_element(n + j) - v_c[j];
  }
}

mechanics::Status BallBody::applied_force(double t, const Vector& x, const Vector& v, const Vector* held_at,
                                          Vector& f) const {
  return complete_force(t, x, v, kernels_->force(x, f), held_at, f);
}

mechanics::Status BallBody::complete_force(double t, const Vector& x, const Vector& v, double least,
                                           const Vector* held_at, Vector& f) const {
  if (auto status = judge(least, x); !status) return status;
  loads_.add(t, x, v, f);
  if (relaxes()) kernels_->add_branch_force(branches_.list, x, f);
  if (gravity_)
    if (auto status = gravity_->add(x, f); !status) return status;
  if (orbit_.n() > 0) add_companions(x, f);
  if (!contact_) return {};
  if (held_at) {
    contact_->add_holding(x, *held_at, f);
    return {};
  }
  const double given = contact_->add(t, x, f);
  const loads::ContactPower power = contact_->add_dissipation(t, x, v, f);
  add_taken(power.taken, f);
  add_given(given + power.given, f);
  return {};
}

void BallBody::apply_inverse_mass(const Vector& f, Vector& a) const {
  if (&a != &f) a = f;
  scale_by(space_.inverse_mass(), a);
}

void BallBody::apply_mass(const Vector& v, Vector& f) const {
  f = v;
  const Vector& inverse = space_.inverse_mass();
  for (unsigned int i = 0; i < f.locally_owned_size(); ++i)
    f.local_element(i) = inverse.local_element(i) > 0 ? v.local_element(i) / inverse.local_element(i) : 0;
}

Vector BallBody::affine_field(const Eigen::Matrix3d& A, const Eigen::Vector3d& c) const {
  const Vector& X = space_.reference_positions();
  Vector x = make_vector();
  for (unsigned int i = 0; i < x.locally_owned_size(); i += 3) {
    if (i >= 3 * space_.n_nodes()) break;
    for (int r = 0; r < 3; ++r) {
      x.local_element(i + r) = c[r];
      for (int j = 0; j < 3; ++j) x.local_element(i + r) += A(r, j) * X.local_element(i + j);
    }
  }
  return x;
}

void BallBody::transform(const Eigen::Matrix3d& D, Vector& x) const {
  for (unsigned int i = 0; i < 3 * space_.n_nodes(); i += 3) {
    const Eigen::Vector3d before(x.local_element(i), x.local_element(i + 1), x.local_element(i + 2)),
        after = D * before;
    for (int c = 0; c < 3; ++c) x.local_element(i + c) = after[c];
  }
}

Eigen::Vector3d BallBody::mean(const Vector& x) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double mass = 0;
  for (unsigned int i = 0; i < x.locally_owned_size(); i += 3) {
    const double m = space_.mass().local_element(i);
    mass += m;
    for (int c = 0; c < 3; ++c) sum[c] += m * x.local_element(i + c);
  }
  for (int c = 0; c < 3; ++c)
    if (space_.mesh().sector().reflect[c]) sum[c] = 0;
  return sum_over_ranks(sum, space_.communicator()) / sum_over_ranks(mass, space_.communicator());
}

double BallBody::mass() const { return space_.mesh().sector().n_images() * space_.mass().l1_norm() / 3; }

void BallBody::add_to_account(double energy, unsigned int component, Vector& v) const {
  if (const auto entry = space_.account())
    v.local_element(*entry + component) += space_.mesh().sector().n_images() * energy;
}

void BallBody::relax(double h, const Vector& before, Vector& x, Vector& v) const {
  const materials::BranchEnergies lost =
      sum_over_ranks(kernels_->relax_branches(branches_.list, h, before, x), space_.communicator());
  for (unsigned int b = 0; b < branches_.list.size(); ++b) {
    add_taken(lost[b], v);
    add_to_account(lost[b], first_branch_account + b, v);
  }
}

double BallBody::energy_of_branches(const Vector& x) const {
  if (!relaxes()) return 0;
  return space_.mesh().sector().n_images() *
         sum_over_ranks(kernels_->branch_energy(branches_.list, x), space_.communicator());
}

double BallBody::dissipated(const Vector& v) const { return account_entry(v, 0); }
double BallBody::given(const Vector& v) const { return account_entry(v, 1); }

materials::BranchEnergies BallBody::dissipated_by_branches(const Vector& v) const {
  materials::BranchEnergies energies{};
  for (unsigned int b = 0; b < branches_.list.size(); ++b) energies[b] = account_entry(v, first_branch_account + b);
  return energies;
}

double BallBody::account_entry(const Vector& v, unsigned int component) const {
  const auto entry = space_.account();
  return sum_over_ranks(entry ? v.local_element(*entry + component) : 0, space_.communicator());
}

mechanics::Orbit::Columns BallBody::companions(const Vector& x) const {
  mechanics::Orbit::Columns s = mechanics::Orbit::Columns::Zero(3, orbit_.n());
  const auto first = space_.companions();
  for (int k = 0; k < orbit_.n(); ++k) {
    for (int c = 0; first && c < 3; ++c) s(c, k) = x.local_element(*first + 3 * k + c);
    s.col(k) = sum_over_ranks(Eigen::Vector3d(s.col(k)), space_.communicator());
  }
  return s;
}

void BallBody::set_companions(const mechanics::Orbit::Columns& s, Vector& x) const {
  if (const auto first = space_.companions())
    for (Eigen::Index i = 0; i < s.size(); ++i) x.local_element(*first + static_cast<unsigned int>(i)) = s(i);
}

Eigen::Matrix3d BallBody::second_moment(const Vector& x) const {
  const Eigen::Vector3d center = mean(x);
  return nodal_moment(x, x) - mass() * center * center.transpose();
}

/// Adds the forces of the companions on the nodes to f, and sets the forces on the coordinates of the companions. The
/// resultant of the forces on the nodes is zero.
void BallBody::add_companions(const Vector& x, Vector& f) const {
  const mechanics::Orbit::Columns s = companions(x);
  if (orbit_.full_potential()) {
    const mechanics::Orbit::Columns r = orbit_.relative(s);
    const Eigen::Vector3d center = mean(x);
    const CompanionSums sums = companion_sums(orbit_, space_, x, center, r);
    add_companion_forces(orbit_, space_, x, center, r, sums, mass(), f);
    return set_companions(orbit_.force_on_coordinates(r, sums.on_companions), f);
  }
  const Eigen::Matrix3d T = orbit_.tide(s);
  const Eigen::Vector3d at_center = T * mean(x);
  const Vector& mass = space_.mass();
  for (unsigned int i = 0; i < 3 * space_.n_nodes(); i += 3)
    for (int r = 0; r < 3; ++r) {
      double acceleration = at_center[r];
      for (int c = 0; c < 3; ++c) acceleration -= T(r, c) * x.local_element(i + c);
      f.local_element(i + r) += mass.local_element(i) * acceleration;
    }
  set_companions(orbit_.force(second_moment(x), s), f);
}

Eigen::Matrix3d BallBody::nodal_moment(const Vector& a, const Vector& b) const {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (unsigned int i = 0; i < a.locally_owned_size(); i += 3)
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        sum(r, c) += space_.mass().local_element(i) * a.local_element(i + r) * b.local_element(i + c);
  return whole_ball(sum_over_ranks(sum, space_.communicator()));
}

LeastPlace BallBody::least_jacobian(const Vector& x) const { return of_all_ranks(kernels_->locate_least_jacobian(x)); }
LeastPlace BallBody::least(const Vector& x, const std::function<double(const Eigen::Matrix3d& F)>& value) const {
  using RowByRow = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
  return of_all_ranks(kernels_->locate_least(x, [&value](const double* F) { return value(RowByRow(F)); }));
}
LeastPlace BallBody::least_reserve(const Vector& x) const { return of_all_ranks(kernels_->locate_least_reserve(x)); }

LeastPlace BallBody::of_all_ranks(LeastPlace least) const { return least_over_ranks(least, space_.communicator()); }

CellIntegrals BallBody::integrals(const Vector& x, const Vector& v) const {
  CellIntegrals sums = kernels_->integrals(x, v);
  const MPI_Comm communicator = space_.communicator();
  if (n_ranks(communicator) == 1) return sums;
  sums.elastic = sum_over_ranks(sums.elastic, communicator);
  sums.volumetric = sum_over_ranks(sums.volumetric, communicator);
  sums.volume = sum_over_ranks(sums.volume, communicator);
  sums.squared_log_J = sum_over_ranks(sums.squared_log_J, communicator);
  sums.largest_squared_log_J = -least_over_ranks(-sums.largest_squared_log_J, communicator);
  sums.least = least_over_ranks(sums.least, communicator);
  for (CellIntegrals::Matrix* matrix : {&sums.F, &sums.X_pulled_back})
    for (auto& row : *matrix) row = sum_over_ranks(row, communicator);
  return sums;
}

void BallBody::fill_irregular(Vector& x) const {
  const Vector& X = space_.reference_positions();
  for (unsigned int i = 0; i < x.locally_owned_size(); ++i) {
    const unsigned int node = i - i % 3;
    // The numbers are the values of a sine wave at the nodes. The wavelength is much smaller than the elements, so
    // values at neighbouring nodes are not correlated. The phase differs between the components. The round-off of X
    // changes the numbers by about 1e-12.
    const double phase =
        1e3 * (X.local_element(node) + 1.7 * X.local_element(node + 1) + 2.9 * X.local_element(node + 2));
    x.local_element(i) = std::sin(phase + i % 3);
  }
}

Eigen::Matrix3d BallBody::whole_ball(const Eigen::Matrix3d& sector_integral) const {
  const Sector& sector = space_.mesh().sector();
  return mechanics::without_odd_entries(sector.n_images() * sector_integral, sector.reflect);
}

Eigen::Matrix3d BallBody::mass_moment(const Vector& x) const {
  return nodal_moment(x, space_.reference_positions()) * E0_.inverse();
}

}  // namespace pseudorigid::continuum
