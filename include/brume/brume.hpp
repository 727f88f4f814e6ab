// SPDX-License-Identifier: Apache-2.0
// The C functions of brume.h for C++: handles that clean up after themselves and errors that throw.
// Nothing else; use brume.h's structures as they are.
#pragma once

#include <brume/brume.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace brume {

/// What a call has refused or failed at.
class ApiError : public std::runtime_error {
  public:
    /// With the text of brumeLastError().
    explicit ApiError(BrumeResult result)
        : std::runtime_error(std::string(brumeResultName(result)) + ": " + brumeLastError()),
          mResult(result) {}
    /// Never BRUME_SUCCESS.
    BrumeResult result() const { return mResult; }

  private:
    BrumeResult mResult;
};

/// Throws an ApiError unless `result` is BRUME_SUCCESS.
inline void check(BrumeResult result) {
    if (result != BRUME_SUCCESS) throw ApiError(result);
}

/// A structure of brume.h with its size set and everything else at its default.
template <typename Struct>
Struct init() {
    Struct value{};
    value.structSize = sizeof(Struct);
    return value;
}

/// Owns a BrumeContext. Scenes must go before it.
class Context {
  public:
    Context() = default;
    /// As brumeCreateContext().
    explicit Context(const BrumeContextCreateInfo& info) {
        check(brumeCreateContext(&info, &mHandle));
    }
    /// Moves the handle.
    Context(Context&& other) noexcept : mHandle(std::exchange(other.mHandle, nullptr)) {}
    /// Swaps the handles.
    Context& operator=(Context&& other) noexcept {
        std::swap(mHandle, other.mHandle);
        return *this;
    }
    ~Context() { brumeDestroyContext(mHandle); }

    /// The handle for the C functions.
    BrumeContext get() const { return mHandle; }
    /// As brumeBeginFrame().
    void beginFrame(uint64_t frameIndex) { check(brumeBeginFrame(mHandle, frameIndex)); }

  private:
    BrumeContext mHandle = nullptr;
};

/// Owns a BrumeScene.
class Scene {
  public:
    Scene() = default;
    /// As brumeCreateScene().
    Scene(const Context& context, const BrumeSceneCreateInfo& info) {
        check(brumeCreateScene(context.get(), &info, &mHandle));
    }
    /// Moves the handle.
    Scene(Scene&& other) noexcept : mHandle(std::exchange(other.mHandle, nullptr)) {}
    /// Swaps the handles.
    Scene& operator=(Scene&& other) noexcept {
        std::swap(mHandle, other.mHandle);
        return *this;
    }
    ~Scene() { brumeDestroyScene(mHandle); }

    /// A scene from a file.
    static Scene load(const Context& context, const char* file, const char* method = nullptr) {
        auto info = init<BrumeSceneCreateInfo>();
        info.file = file;
        info.method = method;
        return Scene(context, info);
    }

    /// The handle for the C functions.
    BrumeScene get() const { return mHandle; }
    /// As brumePrepare().
    void prepare(const BrumeView& view) { check(brumePrepare(mHandle, &view)); }
    /// As brumeCmdSimulate().
    void cmdSimulate(VkCommandBuffer commands, double seconds) {
        auto step = init<BrumeStep>();
        step.seconds = seconds;
        check(brumeCmdSimulate(mHandle, commands, &step));
    }
    /// As brumeCmdShadow().
    void cmdShadow(VkCommandBuffer commands, const BrumeView& view) {
        check(brumeCmdShadow(mHandle, commands, &view));
    }
    /// As brumeCmdRender().
    void cmdRender(VkCommandBuffer commands, const BrumeView& view) {
        check(brumeCmdRender(mHandle, commands, &view));
    }
    /// As brumeReloadScene(); returns the number of files read.
    uint32_t reload() {
        uint32_t changed = 0;
        check(brumeReloadScene(mHandle, &changed));
        return changed;
    }
    /// As brumeGetCounters().
    BrumeCounters counters() const {
        auto counters = init<BrumeCounters>();
        check(brumeGetCounters(mHandle, &counters));
        return counters;
    }

  private:
    BrumeScene mHandle = nullptr;
};

}  // namespace brume
