#include "analysis/space_error.h"

#include <cmath>
#include <limits>

namespace pseudorigid::analysis {

double space_error(double d, double N, double N_other, double rate) {
  return d / std::abs(std::pow(N / N_other, rate) - 1);
}

double SpaceErrorLadder::rate() const {
  if (runs_.size() < 3) return assumed_space_rate;
  const Run *last = &runs_.back(), &three = last[0], &two = last[-1], &one = last[-2];
  // In the model of space_error.h, the quotient d₁₂/d₂₃ of the differences increases with the rate p, so bisection
  // finds p.
  const auto quotient = [&](double p) {
    return (std::pow(one.N / two.N, -p) - 1) / (1 - std::pow(three.N / two.N, -p));
  };
  double low = least_rate_, high = largest_space_rate;
  for (int i = 0; i < 50; ++i) {
    const double p = (low + high) / 2;
    (two.d > quotient(p) * three.d ? low : high) = p;
  }
  return (low + high) / 2;
}

double SpaceErrorLadder::error() const {
  if (runs_.size() < 2) return std::numeric_limits<double>::infinity();
  const Run& last = runs_.back();
  return space_error(last.d, last.N, runs_[runs_.size() - 2].N, rate());
}

double SpaceErrorLadder::predicted_error(double N) const {
  return runs_.empty() ? error() : error() * std::pow(N / runs_.back().N, -rate());
}

}  // namespace pseudorigid::analysis
