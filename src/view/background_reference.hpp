// SPDX-License-Identifier: Apache-2.0
// The exact image and a method's error against it, computed beside the window on a thread of its
// own.
#pragma once

#include <bench/error_metrics.hpp>
#include <render/renderer.hpp>

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace brume::view {

/// What is to be compared: a scene with camera and size, what its effects show, and images that
/// methods have made of it (with triangle hashes).
struct ReferenceJob {
    render::PreparedScene scene;
    render::EffectContents effects;
    std::vector<render::Result> frames;
};

struct ReferenceAnswer {
    /// Of one of the job's frames.
    struct Errors {
        Image painted;  ///< see bench::paintErrors()
        bench::ErrorMetrics metrics;
    };
    Image exact;
    std::vector<Errors> errors;
    std::string problem;  ///< one line; then there is nothing else
};

class BackgroundReference {
  public:
    ~BackgroundReference() { cancel(); }

    /// Begins with a job; one that runs is cancelled.
    void start(ReferenceJob job);
    /// Stops at the next 16 x 16 pixels and waits for that. No answer comes.
    void cancel();

    bool isRunning() const { return mThread.joinable() && !mIsDone; }
    double progress() const { return mProgress; }  ///< [0, 1]
    /// The answer, once.
    std::optional<ReferenceAnswer> take();

  private:
    void work(const ReferenceJob& job);

    std::jthread mThread;
    std::atomic<bool> mIsCancelled = false, mIsDone = false;
    std::atomic<double> mProgress = 0;
    std::mutex mMutex;
    std::optional<ReferenceAnswer> mAnswer;
};

}  // namespace brume::view
