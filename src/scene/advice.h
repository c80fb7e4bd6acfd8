#pragma once
/// Recommendations in error messages. The program tries each recommendation, and prints it only if the changed scene is
/// valid.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/catalogue.h"
#include "scene/scene.h"

namespace pseudorigid::scene {

/// A function that returns whether a scene is valid.
using Accepts = std::function<bool(Scene)>;

/// Returns the scene in which the entries of `settings` have the given values. Expressions in these entries are
/// removed. If a text is not a permitted value, the entry keeps its value. After an unknown word in a list of words
/// (Switches), the value of the list must not be used.
Scene with_settings(Scene scene, const std::vector<Setting>& settings);

/// Returns the text of an error message: the sentence of the refusal, the models that accept the input if the refusal
/// lists models, and recommendations. It contains only recommendations for which `accepts` returns true for the changed
/// scene. An example is "a sweep is offered for the models a, b; set Models = a, or set Method = rattle or explicit-8".
std::string sentence_with_advice(const Refusal& refusal, const Scene& scene, const Accepts& accepts);

}  // namespace pseudorigid::scene
