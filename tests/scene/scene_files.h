#pragma once
/// Parameter files in a folder that lives as long as the test, and the message of a UserError.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "scene/read_scene.h"
#include "scene/user_error.h"

namespace pseudorigid::scene::test {

class SceneFiles : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("pseudorigid_") + info->test_suite_name() + "_" + info->name();
    for (char& c : name) c = c == '/' ? '_' : c;
    folder_ = std::filesystem::temp_directory_path() / name;
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const auto file = folder_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }

  ReadScene read(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return read_scene(write("scene.prm", text), overrides);
  }

  /// What `action` complains about, with the test's folder taken out; "" if it succeeds.
  template <class Action>
  std::string complaint(const Action& action) const {
    try {
      action();
    } catch (const UserError& error) {
      std::string message = error.what();
      const std::string folder = folder_.string() + "/";
      for (auto at = message.find(folder); at != std::string::npos; at = message.find(folder))
        message.erase(at, folder.size());
      return message;
    }
    return "";
  }

  std::filesystem::path folder_;
};

}  // namespace pseudorigid::scene::test
