// SPDX-License-Identifier: Apache-2.0
// A host's device as Brume uses it, and the pace of its frames.
#pragma once

#include <brume/brume.h>
#include <gpu/device.hpp>

#include <memory>
#include <vector>

namespace brume::host {

class Scene;

/// What a host lends for reading files.
struct Readers {
    BrumeResult (*readImage)(void*, const char*, const void*, std::uint64_t,
                             BrumePixels*) = nullptr;
    BrumeResult (*readVolume)(void*, const char*, const char*, std::int32_t,
                              BrumeDensity*) = nullptr;
    void* user = nullptr;
};

class Context {
  public:
    explicit Context(const BrumeContextCreateInfo& info);
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    gpu::Device& device() const { return *mDevice; }
    const Log& log() const { return mLog; }
    const Readers& readers() const { return mReaders; }
    std::uint32_t framesInFlight() const { return static_cast<std::uint32_t>(mSerials.size()); }
    std::uint64_t maxTicksPerFrame() const { return mMaxTicks; }
    std::uint32_t shadowPairs() const { return mShadowPairs; }

    void beginFrame(std::uint64_t frameIndex);
    /// Counts begun frames from 1; 0: none yet.
    std::uint64_t frame() const { return mFrame; }
    /// Which of the frames in flight this is.
    std::uint32_t slot() const { return mSlot; }
    /// Throws an input Error unless a frame has begun.
    void requireFrame(const char* call) const;

    /// As Scene::forgetFrame(), of all scenes.
    void forgetFrame();

    Scene& addScene(std::unique_ptr<Scene> scene);
    void removeScene(const Scene* scene);

  private:
    Log mLog;
    Readers mReaders;
    std::uint64_t mMaxTicks;
    std::uint32_t mShadowPairs;
    std::unique_ptr<gpu::Device> mDevice;
    std::vector<std::uint64_t> mSerials;  // of the device's frames, by slot
    std::uint64_t mFrame = 0;
    std::uint64_t mFrameIndex = 0;
    std::uint32_t mSlot = 0;
    std::vector<std::unique_ptr<Scene>> mScenes;
};

}  // namespace brume::host
