// SPDX-License-Identifier: Apache-2.0
// Rendering a scene with several methods and saying what each cost and how wrong it was.
#pragma once

#include <bench/machine.hpp>
#include <bench/row.hpp>
#include <core/log.hpp>
#include <deque>
#include <functional>
#include <memory>
#include <gpu/device.hpp>
#include <reference/reference.hpp>
#include <render/renderer.hpp>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace brume::bench {

using ProgressCallback = std::function<void(double fraction)>;

/// Collects the frames of one method and summarises them.
class FrameSamples {
  public:
    void add(render::Result frame);

    /// Writes time, passes, bytes, image hash and counters (with `distinctImages`) into the row.
    void summariseInto(Row& row) const;

    /// Fragments per pass, from a frame that counted them and is not a sample itself.
    void setFragments(const render::Result& counted) { mCounted = counted.passes; }

    const render::Result& last() const { return mLast; }
    bool isEmpty() const { return mTimesMs.empty(); }
    int count() const { return static_cast<int>(mTimesMs.size()); }
    double totalMs() const;

  private:
    std::vector<double> mTimesMs, mWallMs;
    std::vector<std::vector<double>> mPassTimesMs;  ///< per pass, per frame
    std::set<std::uint64_t> mHashes;  ///< of the images: one, where a method is deterministic
    std::vector<render::PassTime> mCounted;
    render::Result mLast;
};

/// A row that says what is measured and where, without a measurement yet.
Row describeRun(const std::string& sceneName, const scene::Scene& scene,
                const render::Options& options, const gpu::DeviceInfo& device);

/// Names of the shadow stores that the lights ask for, joined by '+'; "none" without any.
std::string describeShadows(const scene::Scene& scene);

/// Makes every light that casts shadows use that store ("none": no shadows).
void overrideShadows(scene::Scene& scene, const std::string& shadow);

/// The exact image of the scene with these particles, at `every` nth pixel (reference::Options).
reference::Result renderReference(const render::PreparedScene& scene,
                                  const render::EffectContents& effects,
                                  const ProgressCallback& progress = {}, int every = 1);

/// Compares a frame with the exact image of every nth of its pixels; where the two see different
/// triangles (if the frame has hashes) the pixel is excluded.
Comparison compareWithReference(const render::Result& frame, const reference::Result& exact,
                                int every = 1);

struct MeasureOptions {
    std::vector<std::string> methods;  ///< names of oit::listMethods(), each perhaps with settings
                                       ///< of its own: "stochastic:samples=16:mask=naive"
    scene::Settings settings;          ///< each method gets those it knows
    int repeats = 20;
    /// Frames are repeated up to so often, if that is more, until they have taken 50 ms: where a
    /// frame takes two, a few of them may all be twice as slow by chance.
    int shortRepeats = 0;
    int warmups = 1;
    bool withError = true;  ///< compare with the reference
    int errorEvery = 1;     ///< at the middle one of each n x n pixels
    /// What errors are against, with its name for the rows; null: the scene itself.
    std::shared_ptr<const render::PreparedScene> truth;
    std::string truthName;
    bool keepImages = true;
    std::string suite;     ///< for the rows
    std::string shadow;    ///< the store that overrideShadows() was given, for the rows; or empty
    int layerCount = 0;    ///< full-screen layers, for layer-pixels per second
    Yardstick* yardstick = nullptr;  ///< measured in every round, if given; rows get roofs
    ProgressCallback progress;
};

/// One method on one scene.
struct Measurement {
    Row row;
    Image image;                  ///< empty after a failure
    std::vector<float> absolute;  ///< per pixel error, empty unless compared
    std::shared_ptr<const Image> reference;  ///< of the scene, shared; null unless compared
};

/// Least time of each pass, by the machine's rates.
void addRoofs(const Machine& machine, Row& row);

/// A scene with its methods, in a race with others.
struct Entrant {
    std::string sceneName;
    render::PreparedScene scene;
    MeasureOptions options;
};

/// Renders every scene with its methods, all of them in turn, frame by frame; rounds, yardstick and
/// progress are those of the first entrant. Else as measureScene().
std::vector<Measurement> measureScenes(gpu::Device& device, const std::deque<Entrant>& entrants,
                                       const Log& log);

/// Renders the scene with every method, taking turns frame by frame so that drift of clocks and
/// load hits all alike. A method that fails gives a row that says why. Throws an input Error for an
/// unknown method or a setting that no method knows.
std::vector<Measurement> measureScene(gpu::Device& device, const std::string& sceneName,
                                      const render::PreparedScene& scene,
                                      const MeasureOptions& options, const Log& log);

}  // namespace brume::bench
