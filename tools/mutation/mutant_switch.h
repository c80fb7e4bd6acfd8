#pragma once
/// Included by the source files of an instrumented copy (tools/mutation/mutate.py): mutants are compiled together
/// and the environment says which one lives,
///
///   PSEUDORIGID_MUTANT=17                    that mutant; without it the program is the original
///   PSEUDORIGID_MUTANTS_REACHED=<file>       appends the numbers of the mutants whose places were evaluated

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <type_traits>

namespace pseudorigid::mutation {

inline constexpr int largest_number = 10000;

struct Switch {
  int living = 0;
  const char* file = nullptr;
  std::array<bool, largest_number + 1> reached{};

  Switch() {
    if (const char* number = std::getenv("PSEUDORIGID_MUTANT")) living = std::atoi(number);
    file = std::getenv("PSEUDORIGID_MUTANTS_REACHED");
  }
  ~Switch() {
    if (!file) return;
    if (std::FILE* out = std::fopen(file, "a")) {
      for (int n = 1; n <= largest_number; ++n)
        if (reached[static_cast<std::size_t>(n)]) std::fprintf(out, "%d\n", n);
      std::fclose(out);
    }
  }
};
inline Switch the_switch;

/// Whether that mutant lives. Never while compiling: an expression that is evaluated then has no mutants.
constexpr bool lives(int number) {
  if (std::is_constant_evaluated()) return false;
  if (the_switch.file) the_switch.reached[static_cast<std::size_t>(number)] = true;
  return the_switch.living == number;
}

/// A factor that is exactly 1 unless its mutant lives; products and quotients with it have the type of the operand.
struct Factor {
  double value;
  friend constexpr Factor operator-(Factor f) { return {-f.value}; }
  template <class T>
  friend constexpr auto operator*(Factor f, const T& x) {
    if constexpr (std::is_integral_v<T>)
      return static_cast<decltype(+x)>(f.value * static_cast<double>(x));
    else
      return f.value * x;
  }
  template <class T>
  friend constexpr auto operator*(const T& x, Factor f) {
    if constexpr (std::is_integral_v<T>)
      return f * x;
    else
      return x * f.value;
  }
  template <class T>
  friend constexpr auto operator/(const T& x, Factor f) {
    if constexpr (std::is_integral_v<T>)
      return static_cast<decltype(+x)>(static_cast<double>(x) / f.value);
    else
      return x / f.value;
  }
};
constexpr Factor factor(int number, double mutated) { return {lives(number) ? mutated : 1.0}; }

template <int number, class T>
constexpr T max(const T& a, const T& b) {
  return lives(number) ? std::min(a, b) : std::max(a, b);
}
template <int number, class T>
constexpr T min(const T& a, const T& b) {
  return lives(number) ? std::max(a, b) : std::min(a, b);
}

}  // namespace pseudorigid::mutation
