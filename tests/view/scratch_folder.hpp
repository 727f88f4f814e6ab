// SPDX-License-Identifier: Apache-2.0
// A folder of its own for each test, with a small scene in it.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace brume::test {

// A pane, a lit puff and rising sparks; comments as people write them.
inline constexpr const char* kScene = R"({ "version": 1,
  "camera": { "position": [0, 1, 4], "target": [0, 0.6, 0], "verticalFov": 40 },
  "image": { "width": 24, "height": 16 },
  "background": { "radiance": [0.1, 0.2, 0.3] },
  "lights": [ { "type": "ambient", "radiance": [0.4, 0.4, 0.4] },
              { "type": "directional", "direction": [0.6, -0.7, -0.39], "irradiance": [3, 3, 3], "shadow": "total",
                "shadowSettings": { "resolution": 32, "opaqueResolution": 32 } } ],
  "materials": { "floor": { "type": "opaque", "albedo": [0.5, 0.5, 0.5] },
                 "pane": { "type": "thin", "transmission": [0.9, 0.2, 0.1] } },
  "media": { "smoke": { "extinction": [4, 4, 4], "albedo": [0.9, 0.8, 0.7] } },
  "meshes": [ { "shape": "plane", "size": [6, 6], "material": "floor" },
              { "shape": "plane", "size": [1, 1], "material": "pane", "transform": { "rotate": [90, 0, 0], "translate": [0.4, 0.6, 1] } } ],
  "spheres": [ { "center": [0, 0.5, 0], "radius": 0.5, "medium": "smoke" } ],
  "effects": [ { "file": "sparks.effect.json", "seed": 7, "time": 1.5 } ] })";

inline constexpr const char* kSparks = R"({
  // What rises.
  "version": 1, "capacity": 100, "tickRate": 30, "medium": "smoke",
  "emitters": [ { "rate": 40, "shape": { "type": "sphere", "radius": 0.3 }, "speed": [0.5, 1],
                  "direction": [0, 1, 0], "spread": 30, "lifetime": [1, 2] } ],
  "modules": [
    { "type": "gravity", "acceleration": [0, -0.2, 0] }, /* and is */
    { "type": "drag",
      "rate": 0.5 }  // slowed down
  ],
  "overLife": { "radius": [[0, 0.1], [1, 0.2]] }, "profile": "smooth" })";

class ScratchFolder {
  public:
    ScratchFolder() {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        mPath = std::filesystem::temp_directory_path() /
                (std::string("brume_view_") + test->test_suite_name() + "_" + test->name());
        std::filesystem::remove_all(mPath);
        std::filesystem::create_directories(mPath);
        write("scene.json", kScene);
        write("sparks.effect.json", kSparks);
    }
    ~ScratchFolder() { std::filesystem::remove_all(mPath); }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    std::filesystem::path operator/(const std::string& name) const { return mPath / name; }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(mPath / name, std::ios::binary) << text;
    }
    std::string read(const std::string& name) const {
        std::ifstream stream(mPath / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

  private:
    std::filesystem::path mPath;
};

}  // namespace brume::test
