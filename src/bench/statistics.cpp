// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bench/statistics.hpp>
#include <cmath>
#include <limits>

namespace brume::bench {

double percentile(std::vector<double> values, double q) {
    if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
    const double rank = std::clamp(q, 0.0, 1.0) * static_cast<double>(values.size() - 1);
    const auto lower = static_cast<std::ptrdiff_t>(std::floor(rank));
    const auto position = values.begin() + lower;
    std::nth_element(values.begin(), position, values.end());
    const double fraction = rank - static_cast<double>(lower);
    if (fraction == 0 || position + 1 == values.end()) return *position;
    return *position + fraction * (*std::min_element(position + 1, values.end()) - *position);
}

TimeSummary summarise(const std::vector<double>& timesMs) {
    return {percentile(timesMs, 0.5), percentile(timesMs, 0.05), percentile(timesMs, 0.95),
            static_cast<int>(timesMs.size())};
}

}  // namespace brume::bench
