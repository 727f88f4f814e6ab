// SPDX-License-Identifier: Apache-2.0
// What each shadow store costs on a scene and how wrong it is, at points.
#pragma once

#include <bench/statistics.hpp>
#include <bench/table.hpp>
#include <core/log.hpp>
#include <gpu/device.hpp>
#include <render/renderer.hpp>

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace brume::bench {

/// Of transmittances, store minus exact, over all points and channels.
struct ShadowError {
    double rms = 0;
    double p999 = 0;  ///< 99.9th percentile of the largest difference of each point
    double max = 0;
    double bias = 0;
    double hue = 0;  ///< rms difference of the channels' shares of their sum
};

/// Against the exact value at the point, and against its average over the store's filter footprint
/// (what is left is the store's own error).
struct ShadowErrors {
    ShadowError atPoint, footprint;
};

struct ShadowRow {
    std::string scene;
    std::string store;
    scene::Settings settings;
    std::string device, driver, commit;
    TimeSummary build;    ///< ms, of the map, on the device
    double sampleNs = 0;  ///< per point, on the device
    double bytesPerTexel = 0;
    ShadowErrors inside;  ///< points in the box around the casters
    ShadowErrors behind;  ///< points behind all of them
    std::string command;  ///< that measures this row again, for a shell
    std::string failure;  ///< why there is no measurement, or empty
};

struct ShadowMeasureOptions {
    std::vector<std::string> stores;
    scene::Settings settings;  ///< each store gets those it knows
    int points = 2000;         ///< inside; half as many behind
    int repeats = 3;
    std::function<void(double fraction)> progress;
};

/// Measures the stores, in turn, on the first directional light of the scene, which gets a shadow if it has
/// none. Throws an input Error if there is none, or nothing translucent, or for an unknown setting.
std::vector<ShadowRow> measureShadows(gpu::Device& device, const std::string& sceneName,
                                      const render::PreparedScene& scene,
                                      const ShadowMeasureOptions& options, const Log& log);

Table makeShadowTable(std::span<const ShadowRow> rows);
nlohmann::ordered_json describe(const ShadowRow& row);

}  // namespace brume::bench
