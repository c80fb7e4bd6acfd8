#pragma once
/// Recommendations of a refusal. A recommendation is printed only after a trial has shown that the scene with it is
/// accepted.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/catalogue.h"
#include "scene/scene.h"

namespace pseudorigid::scene {

/// Whether a scene is one that can run.
using Accepts = std::function<bool(Scene)>;

/// The scene with other values of these entries.
Scene with_settings(Scene scene, const std::vector<Setting>& settings);

/// "a sweep is offered for the models a, b; set Models = a, or set Method = rattle or explicit-8": the sentence of the
/// refusal with its recommendations.
std::string sentence_with_advice(const Refusal& refusal, const Scene& scene, const Accepts& accepts);

}  // namespace pseudorigid::scene
