#include "scene/expressions.h"

#include <fmt/format.h>
#include <muParser.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "entries/entry_kinds.h"
#include "entries/wording.h"
#include "scene/user_error.h"

namespace pseudorigid::scene {
namespace {

/// End of the message for an unknown name. If there are parameters, the text proposes a parameter with a similar name
/// and lists all parameters. Otherwise the text states that the sweep does not declare parameters.
std::string what_is_known(std::string_view name, const ParameterValues& parameters) {
  std::vector<std::string_view> names;
  for (const auto& [parameter, value] : parameters) names.push_back(parameter);
  if (names.empty()) return "; Sweep/Parameters declares no parameter";
  return did_you_mean(name, names) + fmt::format("; the parameters of the sweep are {}", fmt::join(names, ", "));
}

/// Returns the parser of this thread, without variables and with pi as its only constant. Each thread constructs its
/// parser once, because the construction takes longer than the evaluation of an expression.
mu::Parser& cleared_parser() {
  thread_local mu::Parser parser;
  parser.ClearVar();
  parser.ClearConst();
  parser.DefineConst("pi", std::numbers::pi);
  return parser;
}

/// Throws UserError with the expression and the error of muParser. For an unknown name, the message contains the text
/// of what_is_known instead of this error.
[[noreturn]] void refuse(const std::string& expression, const mu::Parser::exception_type& error,
                         const ParameterValues& parameters) {
  const std::string token(trimmed(error.GetToken()));
  if (error.GetCode() == mu::ecUNASSIGNABLE_TOKEN)
    throw UserError(fmt::format("{} cannot be evaluated: nothing is called {}{}", quote(expression), quote(token),
                                what_is_known(token, parameters)));
  throw UserError(fmt::format("{} cannot be evaluated: {}", quote(expression), trimmed(error.GetMsg())));
}

/// The value of an expression, without `$(` and `)`. Throws UserError if it cannot be evaluated, is a list or is not
/// finite.
double value_of(const std::string& expression, const ParameterValues& parameters) {
  double value = 0;
  int n_values = 1;
  try {
    mu::Parser& parser = cleared_parser();
    for (const auto& [name, number] : parameters) parser.DefineConst(name, number);
    parser.SetExpr(expression);
    value = parser.Eval(n_values)[n_values - 1];
  } catch (const mu::Parser::exception_type& error) {
    refuse(expression, error, parameters);
  }
  if (n_values > 1)
    throw UserError(fmt::format("{} is a list of {} numbers and not one; a decimal point is written \".\"",
                                quote(expression), n_values));
  if (!std::isfinite(value)) throw UserError(fmt::format("{} is not a finite number", quote(expression)));
  return value;
}

/// The text of a value. With Rounding::to_whole, a value that is an integer up to round-off is printed as this integer.
/// Values of absolute value 10¹⁵ and above are not rounded.
std::string printed(double value, Rounding rounding) {
  const double whole = std::round(value);
  const bool is_whole = std::abs(value - whole) <= 8 * std::numeric_limits<double>::epsilon() * std::abs(whole);
  return rounding == Rounding::to_whole && is_whole && std::abs(whole) < 1e15 ? fmt::format("{:.0f}", whole)
                                                                              : print_number(value);
}

/// The position of the parenthesis that closes a parenthesis before the position `from`. If there is none, the result
/// is the length of the text.
std::size_t closing_parenthesis(std::string_view text, std::size_t from) {
  int depth = 1;
  for (; from < text.size(); ++from) {
    if (text[from] == '(') ++depth;
    if (text[from] == ')' && --depth == 0) break;
  }
  return from;
}

/// Calls use(expression) for each `$(…)` of the text, and keep(part) for the parts of the text between the expressions.
/// Throws UserError if a closing parenthesis is missing.
template <class Keep, class Use>
void visit_expressions(std::string_view text, const Keep& keep, const Use& use) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t open = std::min(text.find("$(", at), text.size());
    keep(text.substr(at, open - at));
    if (open == text.size()) break;
    const std::size_t close = closing_parenthesis(text, open + 2);
    if (close == text.size()) throw UserError(fmt::format("{} has no closing parenthesis", quote(text.substr(open))));
    use(std::string(text.substr(open + 2, close - open - 2)));
    at = close + 1;
  }
}

}  // namespace

std::string evaluated(std::string_view text, const ParameterValues& parameters, Rounding rounding) {
  std::string result;
  visit_expressions(
      text, [&](std::string_view kept) { result += kept; },
      [&](const std::string& expression) { result += printed(value_of(expression, parameters), rounding); });
  return result;
}

std::set<std::string> names_used(std::string_view text, const Sweep& parameters) {
  std::set<std::string> names;
  const auto note = [&](const std::string& expression) {
    double any = 1;
    try {
      mu::Parser& parser = cleared_parser();
      for (const SweepParameter& parameter : parameters) parser.DefineVar(parameter.name, &any);
      parser.SetExpr(expression);
      for (const auto& [name, variable] : parser.GetUsedVar()) names.insert(name);
    } catch (const mu::Parser::exception_type& error) {
      refuse(expression, error, {});
    }
  };
  visit_expressions(
      text, [](std::string_view) {}, note);
  return names;
}

std::string_view meaning_in_expressions(const std::string& name) {
  if (name == "pi" || name == "e" || name == "_pi" || name == "_e") return "a constant";
  return cleared_parser().GetFunDef().contains(name) ? "a function" : "";
}

}  // namespace pseudorigid::scene
