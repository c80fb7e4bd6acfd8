#include "scene/expressions.h"

#include <fmt/format.h>
#include <muParser.h>

#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "entries/entry_kinds.h"
#include "entries/wording.h"
#include "scene/user_error.h"

namespace pseudorigid::scene {
namespace {

/// "; did you mean …", or the parameters that there are.
std::string what_is_known(std::string_view name, const ParameterValues& parameters) {
  std::vector<std::string_view> names;
  for (const auto& [parameter, value] : parameters) names.push_back(parameter);
  if (names.empty()) return "; Sweep/Parameters declares no parameter";
  return did_you_mean(name, names) + fmt::format("; the parameters of the sweep are {}", fmt::join(names, ", "));
}

double value_of(const std::string& expression, const ParameterValues& parameters) {
  double value = 0;
  try {
    thread_local mu::Parser parser;  // made once: it takes longer than an expression does
    parser.ClearConst();
    parser.DefineConst("pi", std::numbers::pi);
    for (const auto& [name, number] : parameters) parser.DefineConst(name, number);
    parser.SetExpr(expression);
    value = parser.Eval();
  } catch (const mu::Parser::exception_type& error) {
    if (error.GetCode() == mu::ecUNASSIGNABLE_TOKEN)
      throw UserError(fmt::format("{} cannot be evaluated: nothing is called {}{}", quote(expression),
                                  quote(trimmed(error.GetToken())),
                                  what_is_known(trimmed(error.GetToken()), parameters)));
    throw UserError(fmt::format("{} cannot be evaluated: {}", quote(expression), trimmed(error.GetMsg())));
  }
  if (!std::isfinite(value)) throw UserError(fmt::format("{} is not a finite number", quote(expression)));
  return value;
}

/// Past the end of the text if the parenthesis opened before `from` is not closed.
std::size_t closing_parenthesis(std::string_view text, std::size_t from) {
  int depth = 1;
  for (; from < text.size(); ++from) {
    if (text[from] == '(') ++depth;
    if (text[from] == ')' && --depth == 0) break;
  }
  return from;
}

}  // namespace

std::string evaluated(std::string_view text, const ParameterValues& parameters) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t open = std::min(text.find("$(", at), text.size());
    result += text.substr(at, open - at);
    if (open == text.size()) break;
    const std::size_t close = closing_parenthesis(text, open + 2);
    if (close == text.size()) throw UserError(fmt::format("{} has no closing parenthesis", quote(text.substr(open))));
    result += print_number(value_of(std::string(text.substr(open + 2, close - open - 2)), parameters));
    at = close + 1;
  }
  return result;
}

}  // namespace pseudorigid::scene
