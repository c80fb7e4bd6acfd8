#pragma once
/// A sweep runs the scene once for every combination of values of its parameters. Other entries use the parameters in
/// expressions (scene/expressions.h).
///
///     set Parameters = l: 1.1 .. 2 in 100; w: 0, 0.5, 1; g: 0.1 .. 100 in 4 logarithmic
///
/// The text `first .. last in n` means n equally spaced values from `first` to `last`. With `logarithmic`, the
/// logarithms of the values are equally spaced. From run to run, the last parameter changes first.
///
/// The text `first .. last in n latin S` makes n values for the n runs of a Latin hypercube. All parameters with
/// `latin` have the same n, and change together from run to run. The range of each parameter is divided into n parts of
/// equal length, or of equal ratio for `logarithmic latin`. Each part contains one value. The seed S determines the
/// position of the value in its part, and the run that uses the value. These n runs are repeated for each combination
/// of the other parameters. In successive runs, the parameters with `latin` vary fastest.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pseudorigid::scene {

/// A parameter of a sweep, with a list or a range of values.
struct SweepParameter {
  std::string name;
  std::vector<double> values;           ///< values of a list, or ends of a range
  std::optional<int> n_values{};        ///< number of values of a range; empty for a list
  bool logarithmic = false;             ///< true for a logarithmic range
  std::optional<std::uint32_t> seed{};  ///< seed of a parameter with `latin`; empty for other parameters

  int size() const { return n_values ? *n_values : static_cast<int>(values.size()); }
  /// Value i = 0 … size() − 1 of a parameter without `latin`.
  double operator[](int i) const;
};

using Sweep = std::vector<SweepParameter>;
using ParameterValues = std::map<std::string, double>;

inline constexpr int largest_number_of_runs = 10'000'000;

/// A part of the runs of a sweep that is divided into `n_parts` parts. The number `part` is from 1 to `n_parts`. The
/// parts may run at the same time, each in its own directory.
struct SweepPart {
  int part = 1, n_parts = 1;
};
/// Returns the index of the first run of the part, and the index after its last run. The runs of the sweep have the
/// indices 0 … n_runs − 1.
std::pair<int, int> runs_of_part(const SweepPart& part, int n_runs);

/// The number of values of each parameter with `latin`, or 1 if there is none.
int n_latin(const Sweep& sweep);
/// The number of runs of the sweep, or 0 without parameters. To avoid an overflow, numbers above
/// 2·largest_number_of_runs are reduced to this bound.
int n_runs(const Sweep& sweep);
/// The values of the parameters in run k = 0 … n_runs − 1. Without parameters, the result is empty for every k.
ParameterValues values_of_run(const Sweep& sweep, int k);

/// The kind of the entry Sweep/Parameters (entry_kinds.h).
struct SweepParameters {
  static constexpr std::string_view type = "parameters";
  std::optional<std::string> read(std::string_view text, Sweep& value) const;
  std::string print(const Sweep& value) const;
  std::string expected() const {
    return "nothing, or parameters \"name: first .. last in n\", with \"logarithmic\" or \"latin SEED\" after it if "
           "wanted, or \"name: value, value\", separated by \";\"";
  }
  std::vector<std::string_view> words() const { return {}; }
};

/// The kind of the entry Sweep/Part, with texts such as "2 of 8".
struct SweepPartKind {
  static constexpr std::string_view type = "part";
  std::optional<std::string> read(std::string_view text, SweepPart& value) const;
  std::string print(const SweepPart& value) const;
  std::string expected() const { return "a part such as \"2 of 8\""; }
  std::vector<std::string_view> words() const { return {}; }
};

}  // namespace pseudorigid::scene
