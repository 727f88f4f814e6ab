// SPDX-License-Identifier: Apache-2.0
#include <view/timeline.hpp>

#include <algorithm>
#include <cmath>

namespace brume::view {
namespace {

/// A picture that took longer slows time down: leaps are harder to watch than slow motion.
constexpr double kLongestStep = 0.1;

constexpr double kShortestEnd = 1e-3, kLongestEnd = 1e5;

}  // namespace

void Timeline::setEnd(double seconds) {
    mEnd = std::clamp(seconds, kShortestEnd, kLongestEnd);
    seek(mNow);
}

void Timeline::seek(double seconds) { mNow = std::clamp(seconds, 0.0, mEnd); }

void Timeline::step(int frames) {
    isPlaying = false;
    seek((frame() + frames) / frameRate);
}

bool Timeline::advance(double secondsPassed) {
    if (!isPlaying) return false;
    const double before = mNow;
    double next = mNow + speed * (showsEveryFrame ? 1 / frameRate
                                                  : std::clamp(secondsPassed, 0.0, kLongestStep));
    if (next > mEnd) {
        next = isLooping ? std::fmod(next, mEnd) : mEnd;
        if (!isLooping) isPlaying = false;
    }
    mNow = next;
    return mNow != before;
}

// Times are sums and quotients: a whole frame shall not miss its number by a rounding.
int Timeline::frame() const { return static_cast<int>(std::floor(mNow * frameRate + 1e-6)); }

}  // namespace brume::view
