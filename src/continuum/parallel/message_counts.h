#pragma once
/// Messages that this process has sent through MPI since its start, from any library. The program defines the
/// MPI functions that send, and these call the library's functions by their second names, PMPI_… (profiling interface,
/// MPI 3.1, chapter 14). A message to the process itself, and reductions over a communicator of one process, do not
/// count.

namespace pseudorigid::continuum {

struct MessageCounts {
  double messages = 0;    ///< from this process to another one
  double bytes = 0;       ///< in them
  double reductions = 0;  ///< operations in which all processes wait for one another: sums, maxima, barriers, gathers

  MessageCounts operator-(const MessageCounts& earlier) const {
    return {messages - earlier.messages, bytes - earlier.bytes, reductions - earlier.reductions};
  }
};

MessageCounts message_counts();

}  // namespace pseudorigid::continuum
