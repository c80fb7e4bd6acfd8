#pragma once
/// Functions of scalars that laws use, for the scalars that the standard library leaves out; SIMD types bring their
/// own.

#include <cmath>
#include <complex>

namespace pseudorigid::materials {

inline double log1p(double x) { return std::log1p(x); }
inline std::complex<double> log1p(std::complex<double> z) { return std::log(1.0 + z); }

}  // namespace pseudorigid::materials
