// SPDX-License-Identifier: Apache-2.0
#include <shadows/blue_noise.hpp>

#include <cmath>
#include <cstdint>

namespace brume::shadows {
namespace {

constexpr double kSigma = 1.5;  // texels, Ulichney's

/// Points on a torus and how crowded each place is.
class Pattern {
  public:
    explicit Pattern(int size)
        : mSize(size), mIsSet(size * size), mEnergy(size * size), mKernel(size * size) {
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const double dx = std::min(x, size - x), dy = std::min(y, size - y);
                mKernel[y * size + x] = std::exp(-(dx * dx + dy * dy) / (2 * kSigma * kSigma));
            }
    }

    void toggle(int index) {
        const double sign = mIsSet[index] ? -1 : 1;
        mIsSet[index] = !mIsSet[index];
        const int px = index % mSize, py = index / mSize;
        for (int y = 0; y < mSize; ++y)
            for (int x = 0; x < mSize; ++x)
                mEnergy[y * mSize + x] +=
                    sign * mKernel[(y - py + mSize) % mSize * mSize + (x - px + mSize) % mSize];
    }

    /// The set place with most energy, or the free one with least.
    int find(bool isSet) const {
        int best = -1;
        for (int i = 0; i < mSize * mSize; ++i) {
            if (mIsSet[i] != isSet) continue;
            if (best < 0 || (isSet ? mEnergy[i] > mEnergy[best] : mEnergy[i] < mEnergy[best]))
                best = i;
        }
        return best;
    }

    bool isSet(int index) const { return mIsSet[index]; }

  private:
    int mSize;
    std::vector<bool> mIsSet;
    std::vector<double> mEnergy, mKernel;
};

/// A tenth of the places, moved from clusters to voids until they are even.
Pattern makePrototype(int size, int count) {
    Pattern pattern(size);
    std::uint32_t state = 1;
    for (int placed = 0; placed < count;) {
        state = state * 1664525u + 1013904223u;
        const int index = static_cast<int>((state >> 8) % (size * size));
        if (pattern.isSet(index)) continue;
        pattern.toggle(index);
        ++placed;
    }
    for (int moves = 0; moves < size * size; ++moves) {
        const int cluster = pattern.find(true);
        pattern.toggle(cluster);
        const int hole = pattern.find(false);
        pattern.toggle(hole);
        if (hole == cluster) break;
    }
    return pattern;
}

}  // namespace

std::vector<float> makeBlueNoise(int size) {
    const int total = size * size, count = total / 10;
    const Pattern prototype = makePrototype(size, count);
    std::vector<float> values(total);
    const auto setRank = [&](int index, int rank) {
        values[index] = (static_cast<float>(rank) + 0.5f) / static_cast<float>(total);
    };
    // Ranks below the prototype's by taking points away, those above by adding.
    Pattern pattern = prototype;
    for (int rank = count - 1; rank >= 0; --rank) {
        const int cluster = pattern.find(true);
        pattern.toggle(cluster);
        setRank(cluster, rank);
    }
    pattern = prototype;
    for (int rank = count; rank < total; ++rank) {
        const int hole = pattern.find(false);
        pattern.toggle(hole);
        setRank(hole, rank);
    }
    return values;
}

}  // namespace brume::shadows
