#pragma once
/// Recommendations in error messages. The program prints a recommendation only after a trial has shown that validate
/// accepts the scene with it.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/catalogue.h"
#include "scene/scene.h"

namespace pseudorigid::scene {

/// A function that returns whether a scene is valid.
using Accepts = std::function<bool(Scene)>;

/// The scene with the values of `settings` in their entries.
Scene with_settings(Scene scene, const std::vector<Setting>& settings);

/// The sentence of a refusal with its recommendations: "a sweep is offered for the models a, b; set Models = a, or set
/// Method = rattle or explicit-8".
std::string sentence_with_advice(const Refusal& refusal, const Scene& scene, const Accepts& accepts);

}  // namespace pseudorigid::scene
