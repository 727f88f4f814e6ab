// SPDX-License-Identifier: Apache-2.0
// The scene of public samples of order-independent transparency: 1 000 spheres of triangles.
#include <bench/suites/suite.hpp>

#include <fmt/format.h>

namespace brume::bench {
namespace {

ivec2 sizeOf(Scale scale) { return scale == Scale::Full ? ivec2(1280, 720) : ivec2(320, 180); }

std::vector<Plan> plan(Scale scale) {
    return {{.scene = "mesh_spheres", .methods = listAllMethods(), .size = sizeOf(scale)}};
}

/// As many as the lists hold. (Shader invocations are more: devices shade whole blocks of pixels.)
std::uint64_t countFragments(std::span<const Measurement> rows) {
    const Row* row = findRow(rows, "mesh_spheres", "linked_list");
    if (!row) return 0;
    const auto stored = row->counters.find("stored");
    return stored == row->counters.end() ? 0 : stored->second;
}

Findings read(std::span<const Measurement> rows, Scale) {
    const std::uint64_t fragments = countFragments(rows);
    Table table{.title = "1 000 spheres of triangles, 10 x 10 x 10",
                .notes = {fmt::format("{} fragments of transparent surfaces.",
                                      fragments),
                          "Public samples on two cores of lavapipe: 5 to 7 M fragments/s with lists of "
                          "a fixed length, 14 M/s with weighted blending."},
                .header = {"method", "ms", "M fragments/s", "rmse", "bytes"}};
    for (const Measurement& m : rows) {
        if (!m.row.failure.empty()) continue;
        const auto bytes = m.row.bytes.find("total");
        table.rows.push_back(
            {m.row.method, formatMs(m.row.time.median),
             fmt::format("{:.1f}", 1e-3 * static_cast<double>(fragments) / m.row.time.median),
             m.row.error ? formatError(m.row.error->rmse) : "-",
             bytes == m.row.bytes.end() ? "-" : std::to_string(bytes->second)});
    }
    return {.tables = {table}};
}

}  // namespace

extern const Suite kPeerSuite = {"peer", "1 000 spheres of triangles, fragments per second", &plan,
                                 &read};

}  // namespace brume::bench
