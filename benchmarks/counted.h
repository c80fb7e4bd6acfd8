#pragma once
/// A number that counts the operations on it.

namespace pseudorigid::benchmarks {

struct Counted {
  static inline long n_operations = 0;
  double v = 1;

  Counted() = default;
  Counted(double value) : v(value) {}
  static Counted counted(double value) {
    ++n_operations;
    return value;
  }
  friend Counted operator+(Counted a, Counted b) { return counted(a.v + b.v); }
  friend Counted operator-(Counted a, Counted b) { return counted(a.v - b.v); }
  friend Counted operator*(Counted a, Counted b) { return counted(a.v * b.v); }
  friend Counted operator/(Counted a, Counted b) { return counted(a.v / b.v); }
  Counted& operator+=(Counted b) { return *this = *this + b; }
  Counted& operator-=(Counted b) { return *this = *this - b; }
  friend Counted operator-(Counted a) { return counted(-a.v); }
  friend Counted min(Counted a, Counted b) { return a.v < b.v ? a : b; }
};

template <class Run>
double operations(const Run& run) {
  const long before = Counted::n_operations;
  run();
  return static_cast<double>(Counted::n_operations - before);
}

}  // namespace pseudorigid::benchmarks
