// SPDX-License-Identifier: Apache-2.0
// How coarse pictures are while something moves, so that slow devices stay pleasant.
#pragma once

#include <array>
#include <cstddef>

namespace brume::view {

/// Pictures are drawn at 1/d of the window's pixels along each edge, d = 1, 2, 4 or 8.
class PreviewScale {
  public:
    static constexpr std::array<int, 4> kDivisors = {1, 2, 4, 8};

    /// What a picture took, on the host's clock.
    void addPicture(int divisor, double timeMs);
    /// Forgets all times: another method, size or scene.
    void forget() { mTimesMs = {}; }

    /// For the next picture; 1 where nothing moves or `isEnabled` is false.
    int choose(bool isMoving);

    bool isEnabled = true;
    double budgetMs = 60;  ///< for one picture while something moves

  private:
    double estimateMs(std::size_t index) const;

    std::array<double, kDivisors.size()> mTimesMs{};  ///< 0: unknown
    std::size_t mChosen = 0;
};

}  // namespace brume::view
