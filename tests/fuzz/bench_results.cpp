// SPDX-License-Identifier: Apache-2.0
// Results of the benchmark, as --compare reads them: a run, and behind a zero byte another one.
#include <bench/run_diff.hpp>
#include <fuzz/target.hpp>

void brume::fuzz::parse(Bytes bytes) {
    const std::string text = textOf(bytes);
    const std::size_t end = text.find('\0');
    const std::string before = text.substr(0, end);
    const std::string after = end == std::string::npos ? before : text.substr(end + 1);
    bench::formatDiff(bench::diffRuns(before, "old.json", after, "new.json", 0.1));
}
