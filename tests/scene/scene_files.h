#pragma once
/// Parameter files in a folder that lives as long as the test, and the message of a UserError.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "app/models/catalogue.h"
#include "scene/entries.h"
#include "scene/read_scene.h"
#include "scene/user_error.h"
#include "support/scratch_directory.h"

namespace pseudorigid::scene::test {

/// A catalogue with names of methods, the models of the program and one small system.
inline const Catalogue& test_catalogue() {
  static const Catalogue catalogue{
      .methods = {{"rattle", "order 2"}, {"rattle-4", "order 4"}, {"explicit-8", "order 8"}},
      .models = app::program_catalogue().models,
      .systems = {
          {.name = "top",
           .file = "top",
           .section = "Top",
           .documentation = "A top.",
           .entries = {{{"Top/Spin", "1/time", "Its spin."}, AnyKind::of<double>(positive), "2"},
                       {{"Top/Axis", "", "Its axis."}, AnyKind::of<std::vector<double>>(Numbers{3}), "0, 0, 1"}},
           .columns = {{"phi", "", "Angle."}},
           .columns_of = {},
           .has_equilibria = false,
           .refuses = [](const Scene& scene) -> std::optional<Refusal> {
             const auto spin = scene.system_values.find("Top/Spin");
             if (spin == scene.system_values.end() || spin->second != "13") return {};
             return Refusal{"Top/Spin", "this top does not spin at 13"};
           }}}};
  return catalogue;
}

/// The scene of defaults.
inline Scene ball_scene() { return default_scene(test_catalogue()); }

class SceneFiles : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const auto file = folder_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }

  ReadScene read(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return read_scene(write("scene.prm", text), overrides, test_catalogue());
  }

  /// What `action` complains about, with the test's folder taken out; "" if it succeeds.
  template <class Action>
  std::string complaint(const Action& action) const {
    try {
      action();
    } catch (const UserError& error) {
      std::string message = error.what();
      const std::string folder = folder_.path().string() + "/";
      for (auto at = message.find(folder); at != std::string::npos; at = message.find(folder))
        message.erase(at, folder.size());
      return message;
    }
    return "";
  }

  pseudorigid::testing::ScratchDirectory folder_;
};

}  // namespace pseudorigid::scene::test
