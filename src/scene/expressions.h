#pragma once
/// Expressions in the values of a parameter file. The library muParser evaluates each `$(…)` to a number:
///
///     set Deformation = $(1/sqrt(l)), 0, 0; 0, $(1/sqrt(l)), 0; 0, 0, $(l)
///
/// The operators are those of muParser, for example + − * / ^. An expression may contain muParser's functions (sqrt,
/// sin, cos, exp, ln, …), pi, and the parameters of a sweep.

#include <set>
#include <string>
#include <string_view>

#include "scene/sweep.h"

namespace pseudorigid::scene {

inline bool has_expression(std::string_view text) { return text.find("$(") != std::string_view::npos; }

/// Rounding of the printed value of an expression. Entries for integers need `to_whole`, because the value of an
/// expression has round-off.
enum class Rounding {
  none,
  to_whole,  ///< prints an integer if the value is an integer up to round-off
};

/// The text, in which every `$(…)` is replaced by its value for the given parameters. Without rounding, the printed
/// value reads back as the same double. Throws UserError if an expression cannot be evaluated, is a list of numbers, is
/// not finite, or has no closing parenthesis. The caller adds the origin of the text to the message.
std::string evaluated(std::string_view text, const ParameterValues& parameters, Rounding rounding = Rounding::none);

/// The names of the parameters in the expressions of `text`. Names that `parameters` does not contain are included.
/// Throws UserError for an error of syntax.
std::set<std::string> names_used(std::string_view text, const Sweep& parameters);

/// Returns "a function" if muParser has a function of this name. Returns "a constant" for pi, e, _pi and _e, of which
/// expressions can use only pi. The result is empty for other names. A parameter cannot have the name of a function or
/// a constant.
std::string_view meaning_in_expressions(const std::string& name);

}  // namespace pseudorigid::scene
