#pragma once
/// Selection of the samples at which a run writes pictures, or shapes for a report.

#include <algorithm>
#include <cmath>
#include <ranges>
#include <vector>

namespace pseudorigid::app {

/// Selects n_frames samples from the first to the last, at distances as equal as possible. A single frame is at the
/// last sample.
class FrameSchedule {
 public:
  FrameSchedule(long n_frames, long n_samples) : n_frames_(n_frames), n_samples_(n_samples) {}

  /// Sample of frame j, with j = 0 … n_frames − 1.
  long sample(long j) const {
    return n_frames_ == 1 ? n_samples_ : std::lround(static_cast<double>(j) * n_samples_ / (n_frames_ - 1.0));
  }
  /// Number of frames before sample k. If sample k is a frame, this number is also the index j of the frame.
  long n_before(long k) const {
    const auto frames = std::views::iota(0L, n_frames_);
    return std::ranges::partition_point(frames, [&](long j) { return sample(j) < k; }) - frames.begin();
  }
  /// True if sample k is a frame.
  bool has(long k) const {
    const long j = n_before(k);
    return j < n_frames_ && sample(j) == k;
  }

 private:
  long n_frames_, n_samples_;
};

/// Selects the samples for the shapes of a report: the first, the last, and four between them. A short run has fewer
/// shapes, because no sample is selected twice. The distances are unequal, so that the shapes of a periodic motion have
/// different phases.
class ShapeSchedule {
 public:
  explicit ShapeSchedule(long n_samples) {
    for (const double part : {0.0, 0.13, 0.29, 0.47, 0.71, 1.0}) {
      const long sample = std::lround(part * static_cast<double>(n_samples));
      if (samples_.empty() || samples_.back() < sample) samples_.push_back(sample);
    }
  }

  /// Number of selected samples before sample k.
  long n_before(long k) const { return std::lower_bound(samples_.begin(), samples_.end(), k) - samples_.begin(); }
  bool has(long k) const { return std::binary_search(samples_.begin(), samples_.end(), k); }

 private:
  std::vector<long> samples_;
};

}  // namespace pseudorigid::app
