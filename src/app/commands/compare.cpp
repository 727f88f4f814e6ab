// SPDX-License-Identifier: Apache-2.0
#include <app/commands/compare.hpp>
#include <app/session.hpp>
#include <bench/report.hpp>
#include <core/image_io.hpp>

namespace brume::app {

void runCompare(const CompareArguments& arguments, const Log&) {
    const Image test = readImage(arguments.test), reference = readImage(arguments.reference);
    const bench::Comparison comparison = bench::compareImages(test, reference);
    printMetrics(comparison.metrics);
    if (!arguments.json.empty())
        bench::writeTextFile(arguments.json, bench::toJson(comparison.metrics));
    if (!arguments.diff.empty())
        writeImage(arguments.diff,
                   bench::paintErrors(comparison.absolute, test.width, test.height));
}

}  // namespace brume::app
