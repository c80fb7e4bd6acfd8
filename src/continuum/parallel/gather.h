#pragma once
/// Gathers vectors of every rank on the first one, and back. It uses MPI directly, because the packing of deal.II
/// brings Boost's serialization and compression into every file that gathers.

#include <type_traits>
#include <vector>

#include "continuum/parallel/ranks.h"

namespace pseudorigid::continuum {

/// One T, so that counts are those of entries.
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

/// Where the entries of each rank begin, and where the last ones end.
inline std::vector<int> offsets_of(const std::vector<int>& sizes) {
  std::vector<int> offsets{0};
  for (const int size : sizes) offsets.push_back(offsets.back() + size);
  return offsets;
}

/// One vector of each rank, in their order. Collective; empty on the other ranks.
template <class T>
std::vector<std::vector<T>> gather(MPI_Comm communicator, const std::vector<T>& values) {
  const unsigned int n = n_ranks(communicator);
  if (n == 1) return {values};
  const int size = static_cast<int>(values.size());
  std::vector<int> sizes(this_rank(communicator) == 0 ? n : 0);
  MPI_Gather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, 0, communicator);
  const std::vector<int> offsets = offsets_of(sizes);
  std::vector<T> all(offsets.back());
  const MpiType<T> type;
  MPI_Gatherv(values.data(), size, type, all.data(), sizes.data(), offsets.data(), type, 0, communicator);
  std::vector<std::vector<T>> of_ranks;
  for (std::size_t rank = 0; rank < sizes.size(); ++rank)
    of_ranks.emplace_back(all.begin() + offsets[rank], all.begin() + offsets[rank + 1]);
  return of_ranks;
}

/// The vectors of all ranks in their order, one after the other, on each of them. Collective.
template <class T>
std::vector<T> gather_on_all(MPI_Comm communicator, const std::vector<T>& values) {
  const unsigned int n = n_ranks(communicator);
  if (n == 1) return values;
  const int size = static_cast<int>(values.size());
  std::vector<int> sizes(n);
  MPI_Allgather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, communicator);
  const std::vector<int> offsets = offsets_of(sizes);
  std::vector<T> all(offsets.back());
  const MpiType<T> type;
  MPI_Allgatherv(values.data(), size, type, all.data(), sizes.data(), offsets.data(), type, communicator);
  return all;
}

/// The vectors of all ranks but this one, likewise. Collective.
template <class T>
std::vector<T> gather_from_others(MPI_Comm communicator, const std::vector<T>& values) {
  if (n_ranks(communicator) == 1) return {};
  const int size = static_cast<int>(values.size());
  int before = 0;
  MPI_Exscan(&size, &before, 1, MPI_INT, MPI_SUM, communicator);
  if (this_rank(communicator) == 0) before = 0;  // what MPI_Exscan leaves there is undefined
  std::vector<T> all = gather_on_all(communicator, values);
  all.erase(all.begin() + before, all.begin() + before + size);
  return all;
}

/// The reverse of gather: to each rank its vector. What the other ranks give is not looked at. Collective.
template <class T>
std::vector<T> scatter(MPI_Comm communicator, const std::vector<std::vector<T>>& of_ranks) {
  if (n_ranks(communicator) == 1) return of_ranks.at(0);
  std::vector<int> sizes;
  std::vector<T> all;
  for (const std::vector<T>& values : of_ranks) {
    sizes.push_back(static_cast<int>(values.size()));
    all.insert(all.end(), values.begin(), values.end());
  }
  int size = 0;
  MPI_Scatter(sizes.data(), 1, MPI_INT, &size, 1, MPI_INT, 0, communicator);
  std::vector<T> own(size);
  const MpiType<T> type;
  MPI_Scatterv(all.data(), sizes.data(), offsets_of(sizes).data(), type, own.data(), size, type, 0, communicator);
  return own;
}

}  // namespace pseudorigid::continuum
