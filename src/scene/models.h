#pragma once
/// Functions that select models of the ball by their properties in the catalogue.

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/catalogue.h"
#include "scene/entries.h"
#include "scene/scene.h"

namespace pseudorigid::scene {

/// Returns true if the entry Models of the scene contains the model.
inline bool names(const Scene& scene, const ModelDescription& model) {
  return std::ranges::find(scene.models, model.name) != scene.models.end();
}

/// Returns true if the model offers the analysis. Only systems other than the ball offer manifolds and sections.
inline bool offers(const ModelDescription& model, Analysis analysis) {
  switch (analysis) {
    case Analysis::motion:
      return true;
    case Analysis::modes:
      return model.has_modes;
    case Analysis::love_numbers:
      return model.has_love_numbers;
    case Analysis::equilibrium:
      return model.has_equilibria;
    case Analysis::manifolds:
    case Analysis::section:
      return false;
  }
  return false;
}

/// The models that the scene names, in the order of the catalogue, which is by increasing number of degrees of freedom.
inline std::vector<const ModelDescription*> models_of(const Scene& scene) {
  std::vector<const ModelDescription*> models;
  for (const ModelDescription& model : catalogue_of(scene).models)
    if (names(scene, model)) models.push_back(&model);
  return models;
}

/// Returns true if a model of the scene has finite elements, and therefore a mesh.
inline bool is_discretized(const Scene& scene) {
  return std::ranges::any_of(models_of(scene), &ModelDescription::discretized);
}

/// The highest degree of a tide that the finite elements of the scene resolve. It is k 2^r for the degree k and r
/// refinements. If the scene does not set one of them, the least value k = 1 or r = 0 is used.
inline int resolved_degree(const Scene& scene) {
  return scene.continuum.degree.value_or(1) << scene.continuum.refinements.value_or(0);
}

/// The degrees of the tides for which Analysis = love numbers writes Love numbers. If the scene does not list degrees,
/// the result is 2 to 8. In a scene with finite elements, its last degree is at most resolved_degree, but at least 2.
inline std::vector<int> love_degrees(const Scene& scene) {
  if (!scene.love.degrees.empty()) return scene.love.degrees;
  constexpr int last = 8;
  std::vector<int> degrees;
  for (int n = 2; n <= (is_discretized(scene) ? std::clamp(resolved_degree(scene), 2, last) : last); ++n)
    degrees.push_back(n);
  return degrees;
}

/// Returns true if a model of the scene has motions that are not affine (ModelDescription::has_nonaffine).
inline bool has_nonaffine(const Scene& scene) {
  return std::ranges::any_of(models_of(scene), &ModelDescription::has_nonaffine);
}

/// The names of all models in the catalogue of the scene for which `holds(model)` is true.
template <class Predicate>
std::vector<std::string_view> names_where(const Scene& scene, Predicate&& holds) {
  std::vector<std::string_view> found;
  for (const ModelDescription& model : catalogue_of(scene).models)
    if (std::invoke(holds, model)) found.push_back(model.name);
  return found;
}

/// Returns "the reduced model" or "the models a, b".
inline std::string the_models(const std::vector<std::string_view>& names) {
  return names.size() == 1 ? "the " + std::string(names.front()) + " model" : "the models " + joined(names);
}

}  // namespace pseudorigid::scene
