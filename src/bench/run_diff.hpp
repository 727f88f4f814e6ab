// SPDX-License-Identifier: Apache-2.0
// What has changed between two runs of the benchmark, beyond noise.
#pragma once

#include <bench/table.hpp>

#include <string>

namespace brume::bench {

struct RunDiff {
    std::vector<std::string> regressions;  ///< one line each
    std::vector<std::string> gains;
    std::vector<std::string> notes;  ///< rows of one run only, other devices, other images
    int comparedRows = 0;
    /// Standard deviation of the logarithm of how times have changed, about the change that all rows
    /// have in common: as they are, and by the yardstick. 0 where rows are few.
    double scatter = 0, scaledScatter = 0;
};

/// Two documents of toJson(Results). Times are compared in units of the yardstick that was measured
/// in the same rounds, which takes out most of what else the machine did. A row is a regression if
/// * its time has grown by more than the share `threshold` and by more than three times what rows
///   scatter (a factor of 2 at most), both as it is and by the yardstick, and the ranges p05..p95 of both runs do not overlap even
///   when widened by half the threshold; unless so have the times of half of its scene's methods, at
///   least four, by less than a factor of 2, in not more than a twentieth of all scenes: these, which
///   were measured within the same seconds, were disturbed, which is noted, or
/// * its rmse or its bytes have grown by more than the threshold, or
/// * it has failed, or has pixels that are not finite, where it had not.
/// Throws an input Error for text that is not such a document; `oldName` and `newName` are for it.
RunDiff diffRuns(const std::string& oldJson, const std::string& oldName,
                 const std::string& newJson, const std::string& newName, double threshold);

std::string formatDiff(const RunDiff& diff);

}  // namespace brume::bench
