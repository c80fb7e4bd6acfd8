#include "continuum/parallel/message_counts.h"

#include <mpi.h>

#include <map>

namespace pseudorigid::continuum {
namespace {

MessageCounts counts;

/// Persistent requests to send, with the size in bytes of the message of each request. The size is −1 if the message is
/// not for another process.
std::map<MPI_Request, double>& persistent_sends() {
  static std::map<MPI_Request, double> sends;
  return sends;
}

/// Returns the size of a message in bytes, or −1 if the message is not for another process.
double bytes_to(int destination, int n, MPI_Datatype type, MPI_Comm communicator) {
  int own = 0, size = 0;
  PMPI_Comm_rank(communicator, &own);
  PMPI_Type_size(type, &size);
  return destination == own || destination == MPI_PROC_NULL ? -1 : static_cast<double>(n) * size;
}

void add(double bytes) {
  if (bytes < 0) return;
  ++counts.messages;
  counts.bytes += bytes;
}

void add_reduction(MPI_Comm communicator) {
  int size = 0;
  PMPI_Comm_size(communicator, &size);
  if (size > 1) ++counts.reductions;
}

void add_started(MPI_Request request) {
  if (const auto found = persistent_sends().find(request); found != persistent_sends().end()) add(found->second);
}

}  // namespace

MessageCounts message_counts() { return counts; }

}  // namespace pseudorigid::continuum

namespace counted = pseudorigid::continuum;

// The types of the parameters are those of mpi.h. A macro defines the functions MPI_Send … MPI_Irsend, because they
// have the same form.
extern "C" {

#define PSEUDORIGID_COUNT_SEND(name)                                                                              \
  int MPI_##name(const void* buffer, int n, MPI_Datatype type, int destination, int tag, MPI_Comm communicator) { \
    counted::add(counted::bytes_to(destination, n, type, communicator));                                          \
    return PMPI_##name(buffer, n, type, destination, tag, communicator);                                          \
  }
PSEUDORIGID_COUNT_SEND(Send)
PSEUDORIGID_COUNT_SEND(Ssend)
PSEUDORIGID_COUNT_SEND(Rsend)
#undef PSEUDORIGID_COUNT_SEND

#define PSEUDORIGID_COUNT_SEND(name)                                                                            \
  int MPI_##name(const void* buffer, int n, MPI_Datatype type, int destination, int tag, MPI_Comm communicator, \
                 MPI_Request* request) {                                                                        \
    counted::add(counted::bytes_to(destination, n, type, communicator));                                        \
    return PMPI_##name(buffer, n, type, destination, tag, communicator, request);                               \
  }
PSEUDORIGID_COUNT_SEND(Isend)
PSEUDORIGID_COUNT_SEND(Issend)
PSEUDORIGID_COUNT_SEND(Irsend)
#undef PSEUDORIGID_COUNT_SEND

int MPI_Send_init(const void* buffer, int n, MPI_Datatype type, int destination, int tag, MPI_Comm communicator,
                  MPI_Request* request) {
  const int result = PMPI_Send_init(buffer, n, type, destination, tag, communicator, request);
  counted::persistent_sends()[*request] = counted::bytes_to(destination, n, type, communicator);
  return result;
}
int MPI_Start(MPI_Request* request) {
  counted::add_started(*request);
  return PMPI_Start(request);
}
int MPI_Startall(int n, MPI_Request requests[]) {
  for (int i = 0; i < n; ++i) counted::add_started(requests[i]);
  return PMPI_Startall(n, requests);
}
int MPI_Request_free(MPI_Request* request) {
  counted::persistent_sends().erase(*request);
  return PMPI_Request_free(request);
}

int MPI_Allreduce(const void* mine, void* result, int n, MPI_Datatype type, MPI_Op operation, MPI_Comm communicator) {
  counted::add_reduction(communicator);
  return PMPI_Allreduce(mine, result, n, type, operation, communicator);
}
int MPI_Iallreduce(const void* mine, void* result, int n, MPI_Datatype type, MPI_Op operation, MPI_Comm communicator,
                   MPI_Request* request) {
  counted::add_reduction(communicator);
  return PMPI_Iallreduce(mine, result, n, type, operation, communicator, request);
}
int MPI_Reduce(const void* mine, void* result, int n, MPI_Datatype type, MPI_Op operation, int root,
               MPI_Comm communicator) {
  counted::add_reduction(communicator);
  return PMPI_Reduce(mine, result, n, type, operation, root, communicator);
}
int MPI_Bcast(void* buffer, int n, MPI_Datatype type, int root, MPI_Comm communicator) {
  counted::add_reduction(communicator);
  return PMPI_Bcast(buffer, n, type, root, communicator);
}
int MPI_Barrier(MPI_Comm communicator) {
  counted::add_reduction(communicator);
  return PMPI_Barrier(communicator);
}
int MPI_Gather(const void* mine, int n, MPI_Datatype type, void* all, int n_each, MPI_Datatype type_of_all, int root,
               MPI_Comm communicator) {
  counted::add_reduction(communicator);
  return PMPI_Gather(mine, n, type, all, n_each, type_of_all, root, communicator);
}
int MPI_Allgather(const void* mine, int n, MPI_Datatype type, void* all, int n_each, MPI_Datatype type_of_all,
                  MPI_Comm communicator) {
  counted::add_reduction(communicator);
  return PMPI_Allgather(mine, n, type, all, n_each, type_of_all, communicator);
}
int MPI_Allgatherv(const void* mine, int n, MPI_Datatype type, void* all, const int n_each[], const int places[],
                   MPI_Datatype type_of_all, MPI_Comm communicator) {
  counted::add_reduction(communicator);
  return PMPI_Allgatherv(mine, n, type, all, n_each, places, type_of_all, communicator);
}

}  // extern "C"
