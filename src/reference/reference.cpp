// SPDX-License-Identifier: Apache-2.0
#include <reference/reference.hpp>

#include <core/error.hpp>
#include <reference/tracer.hpp>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

namespace brume::reference {
namespace {

constexpr int kTileSize = 16;

int divideUp(int a, int b) { return (a + b - 1) / b; }

/// One frame being rendered: threads take tiles until none is left. A pixel depends on nothing but
/// itself, so neither their number nor their order shows.
class FrameJob {
  public:
    FrameJob(const Input& input, const Options& options)
        : mSettings(input.scene.image),
          mTracer(input, options.shadows),
          mFrame(scene::makeCameraFrame(input.scene.camera, mSettings.width * mSettings.supersample,
                                        mSettings.height * mSettings.supersample)),
          mOptions(options),
          mWidth(divideUp(mSettings.width, options.every)),
          mHeight(divideUp(mSettings.height, options.every)),
          mTilesAcross(divideUp(mWidth, kTileSize)),
          mTileCount(mTilesAcross * divideUp(mHeight, kTileSize)) {
        mResult.image = Image(mWidth, mHeight);
        mResult.triangles.resize(mResult.image.pixels.size());
    }

    Result run() {
        std::vector<std::jthread> helpers;
        for (unsigned i = 1; i < std::max(1u, std::thread::hardware_concurrency()); ++i)
            helpers.emplace_back([this] { work(false); });
        work(true);
        helpers.clear();
        if (mError) std::rethrow_exception(mError);
        return std::move(mResult);
    }

  private:
    void work(bool isCaller) {
        try {
            RayScratch scratch = mTracer.makeScratch();
            for (int tile = mNextTile++; tile < mTileCount; tile = mNextTile++) {
                renderTile(tile, scratch);
                if (isCaller && mOptions.progress)
                    mOptions.progress(std::min(1.0, double(mNextTile) / mTileCount));
            }
        } catch (...) {
            const std::scoped_lock lock(mErrorMutex);
            mError = std::current_exception();
            mNextTile = mTileCount;
        }
    }

    void renderTile(int tile, RayScratch& scratch) {
        const int x0 = tile % mTilesAcross * kTileSize, y0 = tile / mTilesAcross * kTileSize;
        for (int y = y0; y < std::min(y0 + kTileSize, mHeight); ++y)
            for (int x = x0; x < std::min(x0 + kTileSize, mWidth); ++x) renderPixel(x, y, scratch);
    }

    void renderPixel(int column, int row, RayScratch& scratch) {
        const int n = mSettings.supersample;
        const int x = pickMiddle(column, mOptions.every, mSettings.width);
        const int y = pickMiddle(row, mOptions.every, mSettings.height);
        dvec3 sum(0);
        std::uint32_t triangles = 0;
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const scene::Ray ray = mFrame.ray(x * n + i + 0.5, y * n + j + 0.5);
                const double depthPerMetre = glm::dot(ray.direction, mFrame.forward);
                const RayResult sample =
                    mTracer.integrateRay(ray, mFrame.near / depthPerMetre, scratch);
                sum += sample.radiance;
                triangles += sample.triangles;
            }
        mResult.image.at(column, row) = vec3(sum / double(n * n));
        mResult.triangles[static_cast<std::size_t>(row) * mWidth + column] = triangles;
    }

    const scene::ImageSettings mSettings;
    const Tracer mTracer;
    const scene::CameraFrame mFrame;
    const Options& mOptions;
    const int mWidth, mHeight;  // of the image
    const int mTilesAcross, mTileCount;
    Result mResult;
    std::atomic<int> mNextTile = 0;
    std::mutex mErrorMutex;
    std::exception_ptr mError;
};

}  // namespace

Result render(const Input& input, const Options& options) {
    const scene::ImageSettings& image = input.scene.image;
    if (image.width < 1 || image.height < 1 || image.supersample < 1)
        throw inputError("rendering the reference", "image",
                         "width, height and supersample must be at least 1");
    if (options.every < 1)
        throw inputError("rendering the reference", "every", "must be at least 1");
    return FrameJob(input, options).run();
}

dvec3 transmittance(const Input& input, const dvec3& from, const dvec3& to) {
    return Tracer(input).transmittance(from, to);
}

}  // namespace brume::reference
