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

/// What the values of an expression are printed for.
enum class Rounding {
  none,
  to_whole,  ///< a number that round-off alone keeps from being whole is that
};

/// The text with every `$(…)` replaced by its number, which reads back to the same double. Throws UserError, a clause
/// without origin, where an expression cannot be evaluated, is a list or is not finite.
std::string evaluated(std::string_view text, const ParameterValues& parameters, Rounding rounding = Rounding::none);

/// The names out of these that the expressions of the text use. Throws as `evaluated` does.
std::set<std::string> names_used(std::string_view text, const Sweep& parameters);

/// "a function", "a constant": what a name is in every expression, so that no parameter can have it; or nothing.
std::string_view meaning_in_expressions(const std::string& name);

}  // namespace pseudorigid::scene
