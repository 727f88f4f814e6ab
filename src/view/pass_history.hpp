// SPDX-License-Identifier: Apache-2.0
// What each pass took in the last pictures, for a graph.
#pragma once

#include <render/renderer.hpp>

#include <deque>
#include <string>
#include <vector>

namespace brume::view {

class PassHistory {
  public:
    static constexpr std::size_t kLength = 120;

    /// Adds one picture. Copies to the host and to the window are left out.
    void add(const render::Result& result);
    void clear();

    /// Passes in the order in which they were seen first; they keep their place.
    const std::vector<std::string>& names() const { return mNames; }
    std::size_t pictureCount() const { return mPictures.size(); }
    /// Of pass `name` (index into names()) in a picture, the oldest first, ms.
    double timeMs(std::size_t picture, std::size_t name) const;
    double totalMs(std::size_t picture) const;
    double longestMs() const;  ///< largest total

  private:
    std::vector<std::string> mNames;
    std::deque<std::vector<double>> mPictures;  // by name, as far as they were known then
};

}  // namespace brume::view
