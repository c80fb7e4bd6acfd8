#pragma once
/// Which samples become pictures: n_frames samples spread evenly from the first to the last (one frame: the last).

#include <cmath>

namespace pseudorigid::app {

class FrameSchedule {
 public:
  FrameSchedule(long n_frames, long n_samples) : n_frames_(n_frames), n_samples_(n_samples) {}

  /// Sample of frame j = 0 … n_frames − 1.
  long sample(long j) const {
    return n_frames_ == 1 ? n_samples_ : std::lround(static_cast<double>(j) * n_samples_ / (n_frames_ - 1.0));
  }
  /// Frames whose sample is before k: also the number of the frame that sample k would be.
  long n_before(long k) const {
    long j = 0;
    while (j < n_frames_ && sample(j) < k) ++j;
    return j;
  }
  bool has(long k) const {
    const long j = n_before(k);
    return j < n_frames_ && sample(j) == k;
  }

 private:
  long n_frames_, n_samples_;
};

}  // namespace pseudorigid::app
