#pragma once
/// Arithmetic in the values of a parameter file: `$(…)` stands for the number that the expression has, by muParser:
///
///     set Deformation = $(1/sqrt(l)), 0, 0; 0, $(1/sqrt(l)), 0; 0, 0, $(l)
///
/// with + − * / ^, sqrt, sin, cos, exp, ln, … (muParser's functions), pi, and the parameters of a sweep.

#include <string>
#include <string_view>

#include "scene/sweep.h"

namespace pseudorigid::scene {

inline bool has_expression(std::string_view text) { return text.find("$(") != std::string_view::npos; }

/// The text with every `$(…)` replaced by its number, which reads back to the same double. Throws UserError, a clause
/// without origin, where an expression cannot be evaluated or is not finite.
std::string evaluated(std::string_view text, const ParameterValues& parameters);

}  // namespace pseudorigid::scene
