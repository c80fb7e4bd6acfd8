#include "scene/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "entries/entry_kinds.h"
#include "entries/wording.h"
#include "scene/expressions.h"

namespace pseudorigid::scene {
namespace {

bool is_name(std::string_view text) {
  return !text.empty() && !std::isdigit(static_cast<unsigned char>(text.front())) &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

/// "first .. last in n" or "value, value".
Problem read_values(std::string_view text, SweepParameter& parameter) {
  const auto dots = text.find("..");
  if (dots == std::string_view::npos) return Numbers{}.read(text, parameter.values);
  const auto in = text.find(" in ", dots);
  if (in == std::string_view::npos) return got(text);
  const auto first = finite_number(trimmed(text.substr(0, dots)));
  const auto last = finite_number(trimmed(text.substr(dots + 2, in - dots - 2)));
  int n = 0;
  if (!first || !last) return got(text);
  if (Integer{2, largest_number_of_runs}.read(trimmed(text.substr(in + 4)), n))
    return fmt::format("{}, where the number of values is not a whole number from 2 to {}", got(text),
                       largest_number_of_runs);
  parameter.values = {*first, *last};
  parameter.n_values = n;
  return std::nullopt;
}

}  // namespace

int n_runs(const Sweep& sweep) {
  if (sweep.empty()) return 0;
  long n = 1;
  for (const SweepParameter& parameter : sweep) n = std::min(n * parameter.size(), 2L * largest_number_of_runs);
  return static_cast<int>(n);
}

ParameterValues values_of_run(const Sweep& sweep, int k) {
  ParameterValues values;
  for (auto parameter = sweep.rbegin(); parameter != sweep.rend(); ++parameter) {
    values[parameter->name] = (*parameter)[k % parameter->size()];
    k /= parameter->size();
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
  if (n_runs(value) > largest_number_of_runs)
    return fmt::format("{}, which are more than {} runs", got(text), largest_number_of_runs);
  return std::nullopt;
}

std::string SweepParameters::print(const Sweep& value) const {
  std::string text;
  for (const SweepParameter& p : value) {
    text += fmt::format("{}{}: ", text.empty() ? "" : "; ", p.name);
    text += p.n_values
                ? fmt::format("{} .. {} in {}", print_number(p.values[0]), print_number(p.values[1]), *p.n_values)
                : print_row(p.values);
  }
  return text;
}

}  // namespace pseudorigid::scene
