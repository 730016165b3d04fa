#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace grove::cli {

/// A scene that is soon prepared, in a file that goes when this goes.
class SmallScene {
 public:
  SmallScene() {
    std::ofstream(path_) << "name = 'stones'\nspawn = [0, 0, 9]\n"
                            "[[object]]\ntype = 'mesh'\nshape = 'stone'\nposition = [-3, 0, 0]\n"
                            "[[object]]\ntype = 'fluid'\ngrid = 16\nsize = 8\n";
  }
  ~SmallScene() { std::filesystem::remove(path_); }
  SmallScene(const SmallScene&) = delete;
  SmallScene& operator=(const SmallScene&) = delete;

  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  const std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / ("grove_small_scene_" + std::to_string(getpid()) + ".toml");
};

}  // namespace grove::cli
