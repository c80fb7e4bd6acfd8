#pragma once
/// Distribution of independent problems to ranks, for example the parity sectors of the ball. Each rank has the whole
/// octant. A problem has an owner, which solves it and sends the results to the other ranks. All ranks then have the
/// same results, bit by bit, and make the same decisions. With one rank, all problems belong to this rank.

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "continuum/parallel/gather.h"
#include "mechanics/core/status.h"

namespace pseudorigid::continuum {

struct SectorRanks {
  MPI_Comm communicator = MPI_COMM_SELF;

  std::size_t size() const { return n_ranks(communicator); }
  bool is_first() const { return this_rank(communicator) == 0; }
  /// True if this rank owns the problem with this number.
  bool owns(std::size_t problem) const { return problem % size() == this_rank(communicator); }
  /// Returns the numbers of the owner on every rank. `values` are the numbers of this rank, and `is_owner` is true on
  /// one rank. Collective.
  std::vector<double> of_owner(bool is_owner, const std::vector<double>& values) const {
    return gather_on_all(communicator, is_owner ? values : std::vector<double>());
  }
  /// Replaces `matrix` by the matrix of the owner on every rank. Collective.
  void share(bool is_owner, Eigen::MatrixXd& matrix) const {
    if (size() == 1) return;
    std::vector<double> values;
    if (is_owner) {
      values = {static_cast<double>(matrix.rows()), static_cast<double>(matrix.cols())};
      values.insert(values.end(), matrix.data(), matrix.data() + matrix.size());
    }
    values = of_owner(is_owner, values);
    matrix.resize(static_cast<Eigen::Index>(values[0]), static_cast<Eigen::Index>(values[1]));
    std::copy(values.begin() + 2, values.end(), matrix.data());
  }
  /// Replaces `vectors`, which all have the length n, by those of the owner on every rank. Collective.
  void share(bool is_owner, Eigen::Index n, std::vector<Eigen::VectorXd>& vectors) const {
    if (size() == 1) return;
    Eigen::MatrixXd columns(n, is_owner ? static_cast<Eigen::Index>(vectors.size()) : 0);
    for (Eigen::Index k = 0; k < columns.cols(); ++k) columns.col(k) = vectors[static_cast<std::size_t>(k)];
    share(is_owner, columns);
    vectors.clear();
    for (Eigen::Index k = 0; k < columns.cols(); ++k) vectors.push_back(columns.col(k));
  }
  /// Returns a failure on every rank if `mine` is a failure on any rank. The reason is that of the first such rank.
  /// Collective.
  mechanics::Status of_all(const mechanics::Status& mine) const {
    if (size() == 1) return mine;
    std::string reason = mine.ok() ? "" : mine.reason() + '\n';
    const std::vector<char> all = gather_on_all(communicator, std::vector<char>(reason.begin(), reason.end()));
    if (all.empty()) return {};
    return mechanics::Status::failure(std::string(all.begin(), std::ranges::find(all, '\n')));
  }
};

/// A division of the ranks into groups. Each group solves some of the problems, and the ranks of a group share a
/// problem.
class RankGroups {
 public:
  /// Makes as many groups as there are problems, or ranks if these are fewer. Collective.
  RankGroups(const SectorRanks& all, std::size_t n_problems)
      : n_(std::min(all.size(), n_problems)),
        n_problems_(n_problems),
        own_number_(this_rank(all.communicator) % n_),
        own_(all) {
    if (n_ == 1) return;
    MPI_Comm_split(all.communicator, static_cast<int>(own_number_), 0, &own_.communicator);
  }
  ~RankGroups() {
    if (n_ > 1) MPI_Comm_free(&own_.communicator);
  }
  RankGroups(const RankGroups&) = delete;
  RankGroups& operator=(const RankGroups&) = delete;

  std::size_t size() const { return n_; }  ///< number of groups
  /// True if the group of this rank solves the problem with this number. A group has successive problems.
  bool owns(std::size_t problem) const { return problem * n_ / n_problems_ == own_number_; }
  const SectorRanks& own() const { return own_; }  ///< the ranks of the group of this rank

 private:
  std::size_t n_, n_problems_, own_number_;
  SectorRanks own_;
};

}  // namespace pseudorigid::continuum
