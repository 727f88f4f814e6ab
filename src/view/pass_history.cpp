// SPDX-License-Identifier: Apache-2.0
#include <view/pass_history.hpp>

#include <algorithm>
#include <numeric>

namespace brume::view {

void PassHistory::add(const render::Result& result) {
    std::vector<double> times(mNames.size());
    for (const render::PassTime& pass : result.passes) {
        if (pass.name.ends_with("_read") || pass.name == "render.composite") continue;
        const auto found = std::find(mNames.begin(), mNames.end(), pass.name);
        const auto index = static_cast<std::size_t>(found - mNames.begin());
        if (found == mNames.end()) mNames.push_back(pass.name);
        times.resize(mNames.size());
        times[index] += pass.timeMs;
    }
    mPictures.push_back(std::move(times));
    if (mPictures.size() > kLength) mPictures.pop_front();
}

void PassHistory::clear() {
    mNames.clear();
    mPictures.clear();
}

double PassHistory::timeMs(std::size_t picture, std::size_t name) const {
    const std::vector<double>& times = mPictures[picture];
    return name < times.size() ? times[name] : 0;
}

double PassHistory::totalMs(std::size_t picture) const {
    const std::vector<double>& times = mPictures[picture];
    return std::accumulate(times.begin(), times.end(), 0.0);
}

double PassHistory::longestMs() const {
    double longest = 0;
    for (std::size_t i = 0; i < mPictures.size(); ++i) longest = std::max(longest, totalMs(i));
    return longest;
}

}  // namespace brume::view
