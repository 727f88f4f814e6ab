// SPDX-License-Identifier: Apache-2.0
#include <bench/measure.hpp>
#include <core/error.hpp>
#include <view/background_reference.hpp>

#include <exception>
#include <utility>

#include <unistd.h>

namespace brume::view {
namespace {

/// Thrown out of the renderer's progress.
struct Cancelled {};

}  // namespace

void BackgroundReference::start(ReferenceJob job) {
    cancel();
    mIsCancelled = mIsDone = false;
    mProgress = 0;
    mThread = std::jthread([this, moved = std::move(job)] { work(moved); });
}

void BackgroundReference::cancel() {
    mIsCancelled = true;
    if (mThread.joinable()) mThread.join();
    mThread = {};
    mAnswer.reset();
}

std::optional<ReferenceAnswer> BackgroundReference::take() {
    const std::scoped_lock lock(mMutex);
    return std::exchange(mAnswer, std::nullopt);
}

void BackgroundReference::work(const ReferenceJob& job) {
    // On Linux for this thread and those that it starts: the window comes first.
    [[maybe_unused]] const int priority = ::nice(10);
    ReferenceAnswer answer;
    try {
        const reference::Result exact =
            bench::renderReference(job.scene, job.effects, [this](double fraction) {
                if (mIsCancelled) throw Cancelled();
                mProgress = fraction;
            });
        answer.exact = exact.image;
        for (const render::Result& frame : job.frames) {
            const bench::Comparison comparison = bench::compareWithReference(frame, exact);
            answer.errors.push_back(
                {bench::paintErrors(comparison.absolute, exact.image.width, exact.image.height),
                 comparison.metrics});
        }
    } catch (const Cancelled&) {
        mIsDone = true;
        return;
    } catch (const std::exception& error) {
        answer.problem = error.what();
    }
    const std::scoped_lock lock(mMutex);
    mAnswer = std::move(answer);
    mIsDone = true;
}

}  // namespace brume::view
