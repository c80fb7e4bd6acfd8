#pragma once
/// What one core of this machine can do, measured: the limits of a roofline.

namespace pseudorigid::benchmarks {

struct MachineLimits {
  int lanes;                ///< doubles in the widest SIMD vector
  double flops_per_second;  ///< fused multiply-adds on independent registers, two operations each
  double bytes_per_second;  ///< a ← b + s c on vectors larger than the caches: 24 bytes a number (what the write reads
                            ///< is not counted)
};

MachineLimits measure_machine_limits();

}  // namespace pseudorigid::benchmarks
