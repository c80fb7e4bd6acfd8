#pragma once
/// Which samples become pictures, and which shapes of a report.

#include <algorithm>
#include <cmath>
#include <ranges>
#include <vector>

namespace pseudorigid::app {

/// n_frames samples spread evenly from the first to the last (one frame: the last).
class FrameSchedule {
 public:
  FrameSchedule(long n_frames, long n_samples) : n_frames_(n_frames), n_samples_(n_samples) {}

  /// Sample of frame j = 0 … n_frames − 1.
  long sample(long j) const {
    return n_frames_ == 1 ? n_samples_ : std::lround(static_cast<double>(j) * n_samples_ / (n_frames_ - 1.0));
  }
  /// Frames whose sample is before k: also the number of the frame that sample k would be.
  long n_before(long k) const {
    const auto frames = std::views::iota(0L, n_frames_);
    return std::ranges::partition_point(frames, [&](long j) { return sample(j) < k; }) - frames.begin();
  }
  bool has(long k) const {
    const long j = n_before(k);
    return j < n_frames_ && sample(j) == k;
  }

 private:
  long n_frames_, n_samples_;
};

/// Which samples become shapes of a report: the first, the last, and four between them. Their distances are not
/// multiples of a period, so that they have different phases.
class ShapeSchedule {
 public:
  explicit ShapeSchedule(long n_samples) {
    for (const double part : {0.0, 0.13, 0.29, 0.47, 0.71, 1.0}) {
      const long sample = std::lround(part * static_cast<double>(n_samples));
      if (samples_.empty() || samples_.back() < sample) samples_.push_back(sample);
    }
  }

  long n_before(long k) const { return std::lower_bound(samples_.begin(), samples_.end(), k) - samples_.begin(); }
  bool has(long k) const { return std::binary_search(samples_.begin(), samples_.end(), k); }

 private:
  std::vector<long> samples_;
};

}  // namespace pseudorigid::app
