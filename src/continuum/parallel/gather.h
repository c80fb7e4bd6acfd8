#pragma once
/// Functions that gather the vectors of all ranks, or distribute vectors to the ranks. If there are several ranks and
/// their vectors together have more entries than an int can count, each function throws std::length_error on every
/// rank. The functions use MPI directly. The corresponding functions of deal.II would include Boost's serialization and
/// compression in every file that uses them.

#include <cstddef>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "continuum/parallel/ranks.h"

namespace pseudorigid::continuum {

/// An MPI type for one entry of type T. With this type, the counts in MPI calls are numbers of entries and not of
/// bytes.
template <class T>
requires std::is_trivially_copyable_v<T>
class MpiType {
 public:
  MpiType() {
    MPI_Type_contiguous(sizeof(T), MPI_BYTE, &type_);
    MPI_Type_commit(&type_);
  }
  ~MpiType() { MPI_Type_free(&type_); }
  MpiType(const MpiType&) = delete;
  MpiType& operator=(const MpiType&) = delete;
  operator MPI_Datatype() const { return type_; }

 private:
  MPI_Datatype type_;
};

/// The numbers of entries of all ranks as MPI counts, and the offset of the first entry of each rank. A last offset
/// follows, which is the total number. Throws std::length_error if the total exceeds the largest int, which is the type
/// of MPI counts. Every rank then throws, because all ranks have the same numbers.
struct Counts {
  explicit Counts(const std::vector<long>& n_entries) {
    long end = 0;
    for (const long n : n_entries) {
      end += n;
      if (end > std::numeric_limits<int>::max())
        throw std::length_error("vectors of all ranks have more entries together than MPI can count");
      sizes.push_back(static_cast<int>(n));
      offsets.push_back(static_cast<int>(end));
    }
  }
  std::vector<int> sizes, offsets{0};
};

/// Numbers of entries of the vectors of all ranks. Collective.
template <class T>
Counts counts_of_ranks(MPI_Comm communicator, const std::vector<T>& values) {
  const long n = static_cast<long>(values.size());
  std::vector<long> n_entries(n_ranks(communicator));
  MPI_Allgather(&n, 1, MPI_LONG, n_entries.data(), 1, MPI_LONG, communicator);
  return Counts(n_entries);
}

/// Gathers the vectors of all ranks on rank 0: element k of the result is the vector of rank k. The result is empty on
/// other ranks. Collective.
template <class T>
std::vector<std::vector<T>> gather(MPI_Comm communicator, const std::vector<T>& values) {
  if (n_ranks(communicator) == 1) return {values};
  const auto [sizes, offsets] = counts_of_ranks(communicator, values);
  const bool is_first = this_rank(communicator) == 0;
  std::vector<T> all(is_first ? offsets.back() : 0);
  const MpiType<T> type;
  MPI_Gatherv(values.data(), static_cast<int>(values.size()), type, all.data(), sizes.data(), offsets.data(), type, 0,
              communicator);
  std::vector<std::vector<T>> of_ranks;
  for (std::size_t rank = 0; is_first && rank < sizes.size(); ++rank)
    of_ranks.emplace_back(all.begin() + offsets[rank], all.begin() + offsets[rank + 1]);
  return of_ranks;
}

/// Concatenates the vectors of all ranks in the order of the ranks and returns the result on every rank. Collective.
template <class T>
std::vector<T> gather_on_all(MPI_Comm communicator, const std::vector<T>& values) {
  if (n_ranks(communicator) == 1) return values;
  const auto [sizes, offsets] = counts_of_ranks(communicator, values);
  std::vector<T> all(offsets.back());
  const MpiType<T> type;
  MPI_Allgatherv(values.data(), static_cast<int>(values.size()), type, all.data(), sizes.data(), offsets.data(), type,
                 communicator);
  return all;
}

/// Concatenates the vectors of all other ranks in the order of the ranks and returns the result on every rank.
/// Collective.
template <class T>
std::vector<T> gather_from_others(MPI_Comm communicator, const std::vector<T>& values) {
  if (n_ranks(communicator) == 1) return {};
  const auto size = static_cast<std::ptrdiff_t>(values.size());
  long n_own = size, before = 0;
  MPI_Exscan(&n_own, &before, 1, MPI_LONG, MPI_SUM, communicator);
  if (this_rank(communicator) == 0) before = 0;  // MPI_Exscan leaves `before` undefined on rank 0
  std::vector<T> all = gather_on_all(communicator, values);
  all.erase(all.begin() + before, all.begin() + before + size);
  return all;
}

/// The inverse of `gather`: returns to each rank its vector from the argument on rank 0. The function ignores the
/// arguments on other ranks. Collective.
template <class T>
std::vector<T> scatter(MPI_Comm communicator, const std::vector<std::vector<T>>& of_ranks) {
  if (n_ranks(communicator) == 1) return of_ranks.at(0);
  std::vector<long> n_entries(n_ranks(communicator));
  std::vector<T> all;
  if (this_rank(communicator) == 0)
    for (std::size_t rank = 0; rank < of_ranks.size(); ++rank) {
      n_entries[rank] = static_cast<long>(of_ranks[rank].size());
      all.insert(all.end(), of_ranks[rank].begin(), of_ranks[rank].end());
    }
  MPI_Bcast(n_entries.data(), static_cast<int>(n_entries.size()), MPI_LONG, 0, communicator);
  const auto [sizes, offsets] = Counts(n_entries);
  const int size = sizes[this_rank(communicator)];
  std::vector<T> own(size);
  const MpiType<T> type;
  MPI_Scatterv(all.data(), sizes.data(), offsets.data(), type, own.data(), size, type, 0, communicator);
  return own;
}

}  // namespace pseudorigid::continuum
