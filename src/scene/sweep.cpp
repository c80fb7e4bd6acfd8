#include "scene/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "entries/entry_kinds.h"
#include "entries/wording.h"
#include "scene/expressions.h"

namespace pseudorigid::scene {
namespace {

/// Returns true if the text is not empty, consists of letters, digits and underscores, and does not begin with a digit.
bool is_name(std::string_view text) {
  return !text.empty() && !std::isdigit(static_cast<unsigned char>(text.front())) &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

/// Reads the words after "in", such as "5", "5 logarithmic", "5 latin 7" or "5 logarithmic latin 7", into `parameter`.
/// Returns the error, or nothing.
Problem read_number_of_values(std::string_view text, SweepParameter& parameter) {
  std::vector<std::string_view> words;
  for (const std::string_view word : parts_of(text, ' '))
    if (!trimmed(word).empty()) words.push_back(trimmed(word));
  int n = 0;
  if (words.empty() || Integer{2, largest_number_of_runs}.read(words[0], n))
    return fmt::format("where the number of values is not a whole number from 2 to {}", largest_number_of_runs);
  parameter.n_values = n;
  std::size_t i = 1;
  if (i < words.size() && words[i] == "logarithmic") {
    parameter.logarithmic = true;
    ++i;
  }
  if (i + 1 < words.size() && words[i] == "latin") {
    int seed = 0;
    if (Integer{0, 1'000'000'000}.read(words[i + 1], seed))
      return "where the seed after latin is not a whole number from 0 to 1000000000";
    parameter.seed = static_cast<std::uint32_t>(seed);
    i += 2;
  }
  if (i < words.size()) return fmt::format("where {} is not understood", quote(words[i]));
  return std::nullopt;
}

/// Reads "first .. last in n …" or "value, value" into `parameter`. Returns the error, or nothing.
Problem read_values(std::string_view text, SweepParameter& parameter) {
  const auto dots = text.find("..");
  if (dots == std::string_view::npos) return Numbers{}.read(text, parameter.values);
  const auto in = text.find(" in ", dots);
  if (in == std::string_view::npos) return got(text);
  const auto first = finite_number(trimmed(text.substr(0, dots)));
  const auto last = finite_number(trimmed(text.substr(dots + 2, in - dots - 2)));
  if (!first || !last) return got(text);
  if (const Problem problem = read_number_of_values(trimmed(text.substr(in + 4)), parameter))
    return fmt::format("{}, {}", got(text), *problem);
  parameter.values = {*first, *last};
  if (parameter.logarithmic && !(*first * *last > 0))
    return fmt::format("{}, where a logarithmic range is not on one side of 0", got(text));
  return std::nullopt;
}

/// A 64-bit hash of x, the same on every machine (SplitMix64; G. Steele, D. Lea, C. Flood, OOPSLA 2014).
std::uint64_t mixed(std::uint64_t x) {
  std::uint64_t z = x + 0x9e3779b97f4a7c15;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

/// Converts the upper 53 of the 64 bits to a number in [0, 1).
double uniform(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

/// The image of j under a permutation of 0 … n − 1 that depends on the key. A Feistel network permutes the numbers
/// below 4ᵐ ≥ n. The network is applied repeatedly until the result is below n.
int permuted(int j, int n, std::uint64_t key) {
  int m = 1;
  while ((1L << (2 * m)) < n) ++m;
  const std::uint64_t mask = (1UL << m) - 1;
  std::uint64_t x = static_cast<std::uint64_t>(j);
  do {
    std::uint64_t left = x >> m, right = x & mask;
    for (std::uint64_t round = 0; round < 4; ++round)
      left = std::exchange(right, left ^ (mixed(key + (round << 60) + right) & mask));
    x = (left << m) | right;
  } while (x >= static_cast<std::uint64_t>(n));
  return static_cast<int>(x);
}

/// A value of a range. `part` = 0 gives its first value, and `part` = 1 its last value. Between them, the value is
/// linear in `part`. In a logarithmic range, the logarithm of the value is linear in `part`.
double at(const SweepParameter& p, double part) {
  const double first = p.values[0], last = p.values[1];
  return p.logarithmic ? first * std::pow(last / first, part) : first + (last - first) * part;
}

/// The value of the parameter p in run j of its Latin hypercube. `number` is the index of p in the sweep. The key
/// contains this index, so that parameters with the same seed have different values.
double latin_value(const SweepParameter& p, std::size_t number, int j) {
  const std::uint64_t key = mixed(*p.seed + (std::uint64_t{number} << 32));
  const double within = uniform(mixed(key + static_cast<std::uint64_t>(j)));
  return at(p, (permuted(j, p.size(), key) + within) / p.size());
}

}  // namespace

double SweepParameter::operator[](int i) const {
  if (!n_values) return values[static_cast<std::size_t>(i)];
  if (i + 1 == *n_values) return values[1];
  if (logarithmic) return i == 0 ? values[0] : at(*this, static_cast<double>(i) / (*n_values - 1));
  return values[0] + (values[1] - values[0]) * i / (*n_values - 1);
}

std::pair<int, int> runs_of_part(const SweepPart& part, int n_runs) {
  const auto begin = [&](long k) { return static_cast<int>(k * n_runs / part.n_parts); };
  return {begin(part.part - 1), begin(part.part)};
}

int n_latin(const Sweep& sweep) {
  const auto latin = std::ranges::find_if(sweep, [](const SweepParameter& p) { return p.seed.has_value(); });
  return latin == sweep.end() ? 1 : latin->size();
}

int n_runs(const Sweep& sweep) {
  if (sweep.empty()) return 0;
  long n = n_latin(sweep);
  for (const SweepParameter& parameter : sweep)
    if (!parameter.seed) n = std::min(n * parameter.size(), 2L * largest_number_of_runs);
  return static_cast<int>(n);
}

ParameterValues values_of_run(const Sweep& sweep, int k) {
  ParameterValues values;
  const int of_latin = n_latin(sweep), j = k % of_latin;
  k /= of_latin;
  for (std::size_t i = sweep.size(); i-- > 0;) {
    const SweepParameter& parameter = sweep[i];
    if (parameter.seed) {
      values[parameter.name] = latin_value(parameter, i, j);
      continue;
    }
    values[parameter.name] = parameter[k % parameter.size()];
    k /= parameter.size();
  }
  return values;
}

std::optional<std::string> SweepParameters::read(std::string_view text, Sweep& value) const {
  value.clear();
  for (const std::string_view part : parts_of(text, ';')) {
    const auto colon = part.find(':');
    const std::string_view name = trimmed(part.substr(0, std::min(colon, part.size())));
    if (colon == std::string_view::npos || !is_name(name)) return got(part);
    for (const SweepParameter& other : value)
      if (other.name == name) return fmt::format("{}, where {} occurs twice", got(text), quote(name));
    SweepParameter parameter{std::string(name), {}, {}};
    if (const auto meaning = meaning_in_expressions(parameter.name); !meaning.empty())
      return fmt::format("{}, where {} is {} of expressions", got(part), quote(name), meaning);
    if (auto problem = read_values(trimmed(part.substr(colon + 1)), parameter)) return problem;
    value.push_back(std::move(parameter));
  }
  for (const SweepParameter& parameter : value)
    if (parameter.seed && parameter.size() != n_latin(value))
      return fmt::format("{}, where the parameters of a Latin hypercube have different numbers of values", got(text));
  if (n_runs(value) > largest_number_of_runs)
    return fmt::format("{}, which are more than {} runs", got(text), largest_number_of_runs);
  return std::nullopt;
}

std::string SweepParameters::print(const Sweep& value) const {
  std::string text;
  for (const SweepParameter& p : value) {
    text += fmt::format("{}{}: ", text.empty() ? "" : "; ", p.name);
    if (!p.n_values) {
      text += print_row(p.values);
      continue;
    }
    text += fmt::format("{} .. {} in {}", print_number(p.values[0]), print_number(p.values[1]), *p.n_values);
    if (p.logarithmic) text += " logarithmic";
    if (p.seed) text += fmt::format(" latin {}", *p.seed);
  }
  return text;
}

std::optional<std::string> SweepPartKind::read(std::string_view text, SweepPart& value) const {
  const auto of = text.find(" of ");
  if (of == std::string_view::npos) return got(text);
  SweepPart part;
  const Integer kind{1, largest_number_of_runs};
  if (kind.read(trimmed(text.substr(0, of)), part.part) || kind.read(trimmed(text.substr(of + 4)), part.n_parts) ||
      part.part > part.n_parts)
    return got(text);
  value = part;
  return std::nullopt;
}

std::string SweepPartKind::print(const SweepPart& value) const {
  return fmt::format("{} of {}", value.part, value.n_parts);
}

}  // namespace pseudorigid::scene
