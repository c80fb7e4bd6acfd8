#pragma once
/// Counts of the messages that this process has sent through MPI since its start, from all libraries. The program
/// defines its own versions of MPI functions that send. Each version counts the call, and then calls the function of
/// the library under its second name PMPI_… (profiling interface, MPI 3.1, chapter 14). Messages to the process itself
/// and collective operations of one process do not count. MPI_Gatherv, MPI_Scatterv, MPI_Exscan and other functions
/// without a version in message_counts.cpp do not count either.

namespace pseudorigid::continuum {

struct MessageCounts {
  double messages = 0;    ///< number of messages from this process to other processes
  double bytes = 0;       ///< total size of these messages
  double reductions = 0;  ///< number of reductions, broadcasts, barriers and gathers of several processes

  MessageCounts operator-(const MessageCounts& earlier) const {
    return {messages - earlier.messages, bytes - earlier.bytes, reductions - earlier.reductions};
  }
};

MessageCounts message_counts();

}  // namespace pseudorigid::continuum
