// SPDX-License-Identifier: Apache-2.0
#include <view/preview_scale.hpp>

#include <algorithm>

namespace brume::view {

void PreviewScale::addPicture(int divisor, double timeMs) {
    const auto found = std::find(kDivisors.begin(), kDivisors.end(), divisor);
    if (found == kDivisors.end()) return;
    double& known = mTimesMs[static_cast<std::size_t>(found - kDivisors.begin())];
    // The first one compiles and allocates: it must not count for long.
    known = known == 0 ? timeMs : 0.5 * (known + timeMs);
}

// What is not known follows from the nearest finer or coarser one by the number of pixels: too
// long for what does not depend on them, which the first measurement then mends.
double PreviewScale::estimateMs(std::size_t index) const {
    for (std::size_t distance = 0; distance < kDivisors.size(); ++distance)
        for (const std::size_t other : {index - distance, index + distance}) {
            if (other >= kDivisors.size() || mTimesMs[other] == 0) continue;
            const double ratio = static_cast<double>(kDivisors[other]) / kDivisors[index];
            return mTimesMs[other] * ratio * ratio;
        }
    return 0;
}

int PreviewScale::choose(bool isMoving) {
    if (!isEnabled || !isMoving) return 1;
    // A change of size costs something itself: the last choice stays while it is about right.
    const double current = mTimesMs[mChosen];
    const bool isFine = current > 0 && current <= 1.5 * budgetMs &&
                        (mChosen == 0 || current >= 0.2 * budgetMs);
    if (!isFine) {
        mChosen = 0;
        while (mChosen + 1 < kDivisors.size() && estimateMs(mChosen) > budgetMs) ++mChosen;
    }
    return kDivisors[mChosen];
}

}  // namespace brume::view
