// SPDX-License-Identifier: Apache-2.0
// Order statistics of measured values.
#pragma once

#include <vector>

namespace brume::bench {

/// Value below which the share `q` in [0, 1] of `values` lies, linear between neighbours in rank (q
/// = 0.5: the median). Takes a copy because it reorders. NaN for no values.
double percentile(std::vector<double> values, double q);

/// What a repeated measurement of one time says.
struct TimeSummary {
    double median = 0;
    double p05 = 0;
    double p95 = 0;
    int repeats = 0;
};

TimeSummary summarise(const std::vector<double>& timesMs);

}  // namespace brume::bench
