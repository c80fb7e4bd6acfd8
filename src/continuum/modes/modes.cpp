#include "continuum/modes/modes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <functional>
#include <limits>

#include "continuum/modes/block_lanczos.h"
#include "mechanics/equilibria/mode_groups.h"

namespace pseudorigid::continuum {
namespace {

/// Relative residual of eigenvectors. The relative error of frequencies is of the order of its square.
constexpr double eigenvector_tolerance = 1e-7;
/// Relative margin for round-off. The bound complete_below() of a sector is lower by this fraction.
constexpr double round_off = 1e-9;

/// A parity sector to solve. `number` is the argument of parity_of_sector. n_sectors is the number of sectors with the
/// same spectrum, including this sector.
struct SectorClass {
  int number, n_sectors;
};

/// True if the cyclic permutation (X_x, X_y, X_z) ↦ (X_y, X_z, X_x) maps nodes to nodes. Sectors whose signs differ
/// only by this permutation then have the same frequencies.
bool has_threefold_axis(const BallSpace& space) {
  using Place = std::array<long, 3>;
  const auto place = [&](unsigned int node, unsigned int turn) {
    Place p;
    for (unsigned int c = 0; c < 3; ++c)
      p[c] = std::lround(1e9 * space.reference_positions().local_element(3 * node + (c + turn) % 3));
    return p;
  };
  std::vector<Place> places, turned;
  for (unsigned int node = 0; node < space.n_nodes(); ++node) {
    places.push_back(place(node, 0));
    turned.push_back(place(node, 1));
  }
  std::ranges::sort(places);
  std::ranges::sort(turned);
  return std::ranges::equal(places, turned, [](const Place& a, const Place& b) {
    return std::abs(a[0] - b[0]) <= 1 && std::abs(a[1] - b[1]) <= 1 && std::abs(a[2] - b[2]) <= 1;
  });
}

/// The sectors to solve: one sector of each spectrum if the mesh has the threefold axis, and otherwise all eight.
std::vector<SectorClass> sector_classes(const BallSpace& space) {
  if (has_threefold_axis(space)) return {{0, 1}, {1, 3}, {3, 3}, {7, 1}};
  std::vector<SectorClass> all;
  for (int number = 0; number < 8; ++number) all.push_back({number, 1});
  return all;
}

/// A mode that the iteration in a sector has found. `kind` is the class of its surface displacement, and u is its
/// displacement on the octant.
struct SectorMode {
  double omega_squared;
  ModeClass kind;
  Parity parity;
  int n_copies;  ///< number of sectors with the same spectrum, which all have this mode
  Vector u;
};

/// Finds the modes of one parity sector, the lowest first. After a call of `extend`, all modes with frequencies below
/// complete_below() are known.
class SectorSpectrum {
 public:
  /// `is_mine` is true if this rank owns the sector (SectorRanks).
  SectorSpectrum(const RestProblem& problem, const SectorClass& sector_class, int max_degree, bool is_mine)
      : problem_(problem),
        sector_(problem, parity_of_sector(sector_class.number)),
        harmonics_(problem.space, sector_.parity(), max_degree),
        lanczos_([this](const auto& y, auto& z) { return sector_.apply(y, z); },
                 static_cast<Eigen::Index>(sector_.n_unknowns())),
        n_copies_(sector_class.n_sectors),
        is_mine_(is_mine) {}

  bool is_mine() const { return is_mine_; }
  mechanics::Status factorize() { return sector_.factorize(); }

  /// Computes the modes of n more eigenpairs and improves the others. If the sector has no other eigenpair,
  /// complete_below() becomes infinite. Fails if an eigenpair or a mode cannot be computed. Only the owner calls this
  /// function, and then all ranks call `publish`.
  mechanics::Status extend(int n) {
    const Eigen::Index n_before = lanczos_.n_found();
    if (auto s = lanczos_.find(n_before + n, eigenvector_tolerance); !s) return s;
    if (lanczos_.n_found() == n_before) {
      complete_below_ = std::numeric_limits<double>::infinity();
      return {};
    }
    ParitySector::Modes modes;
    if (auto s = sector_.modes_of(lanczos_.vectors(), modes); !s) return s;
    modes_.clear();
    for (Eigen::Index k = 0; k < modes.u.cols(); ++k) {
      Vector u = sector_.field_of(modes.u.col(k));
      if (is_rigid(u)) continue;
      const ModeClass kind = harmonics_.classify(u);
      modes_.push_back({modes.omega_squared[k], kind, sector_.parity(), n_copies_, std::move(u)});
    }
    const double least = lanczos_.values()[lanczos_.n_found() - 1];
    complete_below_ = std::sqrt(std::max(0.0, 1 / least - problem_.shift)) * (1 - round_off);
    return {};
  }

  /// Gives the modes of the owner to all ranks, and adds the new counts to `report`. Collective.
  void publish(const SectorRanks& ranks, ModesReport& report) {
    std::vector<double> numbers{complete_below_, static_cast<double>(lanczos_.n_products()),
                                static_cast<double>(lanczos_.n_found())};
    std::vector<Eigen::VectorXd> shapes;
    for (const SectorMode& mode : modes_) {
      numbers.insert(numbers.end(), {mode.omega_squared, mode.kind.kind == ModeKind::spheroidal ? 1.0 : 0.0,
                                     static_cast<double>(mode.kind.degree), mode.kind.share});
      shapes.push_back(sector_.entries_of(mode.u));
    }
    numbers = ranks.of_owner(is_mine_, numbers);
    ranks.share(is_mine_, sector_.mass().size(), shapes);
    complete_below_ = numbers[0];
    report.n_applications += static_cast<long>(numbers[1]) - n_published_applications_;
    report.n_eigenpairs += static_cast<int>(numbers[2]) - n_published_pairs_;
    n_published_applications_ = static_cast<long>(numbers[1]);
    n_published_pairs_ = static_cast<int>(numbers[2]);
    modes_.clear();
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      const double* of_mode = numbers.data() + 3 + 4 * i;
      const ModeClass kind{of_mode[1] == 1 ? ModeKind::spheroidal : ModeKind::toroidal, static_cast<int>(of_mode[2]),
                           of_mode[3]};
      modes_.push_back({of_mode[0], kind, sector_.parity(), n_copies_, sector_.field_of(shapes[i])});
    }
  }
  const std::vector<SectorMode>& modes() const { return modes_; }

  double complete_below() const { return complete_below_; }

 private:
  /// True if u is the rigid motion of the sector. If the parity has one negative sign, this motion is the translation
  /// along the axis of this sign. If the parity has two negative signs, it is the rotation about the axis of the
  /// positive sign. Other sectors do not have a rigid motion. The other modes of the sector are orthogonal to the rigid
  /// motion, in the inner product of the mass. The share of the rigid motion in u is therefore nearly 1 or nearly 0,
  /// and the test does not need ω².
  bool is_rigid(const Vector& u) const {
    const auto& sign = sector_.parity().sign;
    const auto n_negative = std::ranges::count(sign, -1);
    if (n_negative != 1 && n_negative != 2) return false;
    const auto axis = static_cast<unsigned int>(std::ranges::find(sign, n_negative == 1 ? -1 : 1) - sign.begin());
    const Vector &X = problem_.space.reference_positions(), &mass = problem_.space.mass();
    double with_motion = 0, of_motion = 0, whole = 0;
    for (unsigned int i = 0; i < 3 * problem_.space.n_nodes(); ++i) {
      const unsigned int node = i - i % 3, c = i % 3;
      double motion = c == axis ? 1 : 0;
      if (n_negative == 2)  // the rotation ê×X about the axis
        motion = c == (axis + 1) % 3   ? -X.local_element(node + (axis + 2) % 3)
                 : c == (axis + 2) % 3 ? X.local_element(node + (axis + 1) % 3)
                                       : 0;
      with_motion += mass.local_element(i) * motion * u.local_element(i);
      of_motion += mass.local_element(i) * motion * motion;
      whole += mass.local_element(i) * u.local_element(i) * u.local_element(i);
    }
    return with_motion * with_motion > 0.5 * of_motion * whole;
  }

  const RestProblem& problem_;
  ParitySector sector_;
  SurfaceHarmonics harmonics_;
  BlockLanczos lanczos_;
  int n_copies_;
  bool is_mine_;
  std::vector<SectorMode> modes_;
  long n_published_applications_ = 0;
  int n_published_pairs_ = 0;
  double complete_below_ = 0;
};

double root(double square) { return std::copysign(std::sqrt(std::abs(square)), square); }

/// Groups the modes with ω < `bound` into frequencies, which are ordered by their lowest modes. Omits the other modes.
std::vector<mechanics::ModeGroup> sort_modes(const std::vector<const SectorMode*>& modes, double bound) {
  std::vector<mechanics::ClassifiedMode> known;
  for (const SectorMode* mode : modes) {
    const bool counts = root(mode->omega_squared) < bound;
    known.push_back(
        {mode->omega_squared, mode->kind.kind == ModeKind::spheroidal, mode->kind.degree, counts ? mode->n_copies : 0});
  }
  return mechanics::group_modes(known);
}

/// The frequency of a group of modes. Its shape is that of the first mode of the group.
BallFrequency frequency_of(const std::vector<const SectorMode*>& modes, const mechanics::ModeGroup& group) {
  const SectorMode& shown = *modes[group.modes.front()];
  BallFrequency f{.omega = group.omega,
                  .least = group.least,
                  .largest = group.largest,
                  .kind = shown.kind.kind,
                  .degree = group.degree,
                  .overtone = group.overtone,
                  .multiplicity = static_cast<int>(group.modes.size()),
                  .share = 1,
                  .parity = shown.parity,
                  .shape = shown.u};
  for (const std::size_t mode : group.modes) f.share = std::min(f.share, modes[mode]->kind.share);
  double largest = 0;
  for (unsigned int i = 0; i < f.shape.locally_owned_size(); i += 3)
    largest = std::max(
        largest, std::hypot(f.shape.local_element(i), f.shape.local_element(i + 1), f.shape.local_element(i + 2)));
  f.shape *= 1 / largest;
  return f;
}

}  // namespace

mechanics::Status ball_modes(const RestProblem& problem, int n_frequencies, std::vector<BallFrequency>& frequencies,
                             ModesReport& report, const std::function<bool()>& give_up, const SectorRanks& ranks) {
  const auto interrupted = [&] { return give_up && give_up(); };
  const auto stopped = [] { return mechanics::Status::failure("interrupted while looking for the modes"); };
  // The fundamental frequencies of the sphere rise by about 1 per degree, in internal units
  // (analysis/sphere_frequencies.h). Among the lowest n frequencies, no degree is therefore above n + 2. Degrees above
  // 30 are not considered.
  const int max_degree = std::min(n_frequencies + 2, 30);
  std::deque<SectorSpectrum> sectors;  // a deque does not move its elements
  for (const SectorClass& sector_class : sector_classes(problem.space))
    sectors.emplace_back(problem, sector_class, max_degree, ranks.owns(sectors.size()));
  // Each rank calls `work` for its own sectors. Between two sectors, it may find that the run is interrupted.
  const auto for_own_sectors = [&](auto&& work) {
    mechanics::Status status;
    for (std::size_t first = 0; first < sectors.size(); first += ranks.size()) {
      if (interrupted()) return stopped();
      for (std::size_t i = first; i < std::min(first + ranks.size(), sectors.size()); ++i)
        if (status && sectors[i].is_mine()) status = work(sectors[i]);
    }
    return ranks.of_all(status);
  };
  const int n_first = 2 + n_frequencies / 2, n_more = 2 + n_frequencies / 4;
  frequencies.clear();
  auto status = for_own_sectors([](SectorSpectrum& sector) { return sector.factorize(); });
  if (status) status = for_own_sectors([&](SectorSpectrum& sector) { return sector.extend(n_first); });
  if (!status) return status;
  for (SectorSpectrum& sector : sectors) sector.publish(ranks, report);
  while (true) {
    std::vector<const SectorMode*> modes;
    for (const SectorSpectrum& sector : sectors)
      for (const SectorMode& mode : sector.modes()) modes.push_back(&mode);
    SectorSpectrum& last = *std::ranges::min_element(sectors, {}, &SectorSpectrum::complete_below);
    const auto sorted = sort_modes(modes, last.complete_below());
    const auto n = static_cast<std::size_t>(n_frequencies);
    if (sorted.size() >= n &&
        std::all_of(sorted.begin(), sorted.begin() + n_frequencies, std::mem_fn(&mechanics::ModeGroup::complete))) {
      for (std::size_t i = 0; i < n; ++i) frequencies.push_back(frequency_of(modes, sorted[i]));
      std::ranges::sort(frequencies, {}, &BallFrequency::omega);
      return {};
    }
    if (interrupted()) return stopped();
    if (std::isinf(last.complete_below())) break;  // all modes of the mesh are known
    if (report.n_eigenpairs > 200 * (n_frequencies + 1)) break;
    if (status = ranks.of_all(last.is_mine() ? last.extend(n_more) : mechanics::Status()); !status) return status;
    last.publish(ranks, report);
  }
  return mechanics::Status::failure(
      "the modes cannot be sorted by kind and degree, as the mesh is too coarse for so many of them; raise "
      "Continuum/Degree or Continuum/Refinements");
}

std::vector<double> mode_displacement(const BallSpace& space, const Parity& parity, const Vector& shape) {
  std::vector<double> values;
  values.reserve(8 * 3 * static_cast<std::size_t>(space.n_cells()) * space.nodes_per_cell());
  for (int bits = 0; bits < 8; ++bits) {  // bit d: x_d is mirrored; this is the order of nodal_blocks
    double sign = 1;
    for (int j = 0; j < 3; ++j)
      if (bits >> j & 1) sign *= parity.sign[j];
    for (unsigned int cell = 0; cell < space.n_cells(); ++cell)
      for (const unsigned int node : space.cell_nodes(cell))
        for (int c = 0; c < 3; ++c)
          values.push_back((bits >> c & 1 ? -sign : sign) * shape.local_element(3 * node + c));
  }
  return values;
}

}  // namespace pseudorigid::continuum
