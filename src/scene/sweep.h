#pragma once
/// A sweep: parameters that run over values, one run of the scene for every combination of them. Other entries use the
/// parameters in expressions (scene/expressions.h).
///
///     set Parameters = l: 1.1 .. 2 in 100; w: 0, 0.5, 1
///
/// `first .. last in n` are n values at equal distances, both ends among them. The last parameter varies fastest.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pseudorigid::scene {

struct SweepParameter {
  std::string name;
  std::vector<double> values;   ///< values of a list; ends of a range
  std::optional<int> n_values;  ///< of a range

  int size() const { return n_values ? *n_values : static_cast<int>(values.size()); }
  double operator[](int i) const {
    if (!n_values) return values[static_cast<std::size_t>(i)];
    return i + 1 == *n_values ? values[1] : values[0] + (values[1] - values[0]) * i / (*n_values - 1);
  }
};

using Sweep = std::vector<SweepParameter>;
using ParameterValues = std::map<std::string, double>;

inline constexpr int largest_number_of_runs = 10'000'000;

/// 0 without parameters.
int n_runs(const Sweep& sweep);
/// The values of run k = 0 … n_runs − 1.
ParameterValues values_of_run(const Sweep& sweep, int k);

/// The kind of the entry Sweep/Parameters (entry_kinds.h).
struct SweepParameters {
  static constexpr std::string_view type = "parameters";
  std::optional<std::string> read(std::string_view text, Sweep& value) const;
  std::string print(const Sweep& value) const;
  std::string expected() const {
    return "nothing, or parameters \"name: first .. last in n\" or \"name: value, value\" separated by \";\"";
  }
  std::vector<std::string_view> words() const { return {}; }
};

}  // namespace pseudorigid::scene
