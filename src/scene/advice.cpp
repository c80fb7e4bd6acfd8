#include "scene/advice.h"

#include <fmt/format.h>

#include <utility>

#include "scene/entries.h"
#include "scene/models.h"

namespace pseudorigid::scene {
namespace {

constexpr const char* models_path = "Models";

std::string_view section_of(std::string_view path) {
  const auto slash = path.find('/');
  return slash == path.npos ? std::string_view() : path.substr(0, slash);
}

/// The name of an entry in a recommendation. The name omits the section if the refused entry is in the same section.
std::string_view name_of(std::string_view path, const Refusal& refusal) {
  const std::string_view section = section_of(path);
  return !section.empty() && section == section_of(refusal.path) ? path.substr(section.size() + 1) : path;
}

/// The settings of one recommendation in words, for example "Method = rattle and Step = auto".
std::string in_words(const std::vector<Setting>& settings, const Refusal& refusal) {
  std::string text;
  for (const auto& [path, value] : settings)
    text += fmt::format("{}{} = {}", text.empty() ? "" : " and ", name_of(path, refusal), value);
  return text;
}

Setting models(const std::vector<std::string_view>& names) { return {models_path, joined(names)}; }

/// Returns the models of `names` for which the scene is valid if it runs only this model. If there is no such model,
/// returns all of `names`.
std::vector<std::string_view> accepted_of(const std::vector<std::string_view>& names, const Scene& scene,
                                          const Accepts& accepts) {
  std::vector<std::string_view> accepted;
  for (const std::string_view name : names)
    if (accepts(with_settings(scene, {models({name})}))) accepted.push_back(name);
  return accepted.empty() ? names : accepted;
}

}  // namespace

Scene with_settings(Scene scene, const std::vector<Setting>& settings) {
  for (const Setting& setting : settings) {
    visit_entries(scene, [&](auto& member, const auto& kind, const About& about) {
      if (about.path == setting.path) (void)kind.read(setting.value, member);
    });
    scene.expressions.erase(setting.path);
  }
  return scene;
}

std::string sentence_with_advice(const Refusal& refusal, const Scene& scene, const Accepts& accepts) {
  std::string text = refusal.sentence;
  std::vector<std::vector<Setting>> remedies = refusal.remedies;
  if (!refusal.models.empty()) {
    const auto names = accepted_of(refusal.models, scene, accepts);
    text += " offered for " + the_models(names);
    // If the scene is valid with all these models together, they are recommended together. Otherwise only the first is
    // recommended.
    const Setting all = models(names);
    const bool together = accepts(with_settings(scene, {all}));
    remedies.insert(remedies.begin(), {together ? all : models({names.front()})});
  }
  const Setting* last = nullptr;
  for (const auto& settings : remedies) {
    if (!accepts(with_settings(scene, settings))) continue;
    const bool same_entry = last != nullptr && settings.size() == 1 && settings.front().path == last->path;
    text += last == nullptr ? "; set " : same_entry ? " or " : ", or set ";
    text += same_entry ? settings.front().value : in_words(settings, refusal);
    last = &settings.front();
  }
  return text;
}

}  // namespace pseudorigid::scene
