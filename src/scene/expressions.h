#pragma once
/// Arithmetic in the values of a parameter file: `$(…)` stands for the number that the expression has, by muParser:
///
///     set Deformation = $(1/sqrt(l)), 0, 0; 0, $(1/sqrt(l)), 0; 0, 0, $(l)
///
/// with + − * / ^, sqrt, sin, cos, exp, ln, … (muParser's functions), pi, and the parameters of a sweep.

#include <set>
#include <string>
#include <string_view>

#include "scene/sweep.h"

namespace pseudorigid::scene {

inline bool has_expression(std::string_view text) { return text.find("$(") != std::string_view::npos; }

/// The use of the printed values of an expression, which decides their rounding.
enum class Rounding {
  none,
  to_whole,  ///< a number that is whole up to round-off is printed as a whole number
};

/// The text with every `$(…)` replaced by its number, which reads back to the same double. Throws UserError, a clause
/// without origin, where an expression cannot be evaluated, is a list or is not finite.
std::string evaluated(std::string_view text, const ParameterValues& parameters, Rounding rounding = Rounding::none);

/// The names out of these that the expressions of the text use. Throws as `evaluated` does.
std::set<std::string> names_used(std::string_view text, const Sweep& parameters);

/// "a function" or "a constant" if the name has this meaning in every expression, so that a parameter cannot have it;
/// otherwise empty.
std::string_view meaning_in_expressions(const std::string& name);

}  // namespace pseudorigid::scene
