// SPDX-License-Identifier: Apache-2.0
// Gives every file of a corpus, whole and cut short at some places, to one target: the short run of
// each fuzzer. Files that a fuzzer has found are put into tests/fuzz/corpus/<target>.
#include <fuzz/target.hpp>

#include <vector>

int main(int argc, char** argv) {
    if (argc != 2 || !std::filesystem::is_directory(argv[1])) {
        std::fprintf(stderr, "usage: %s CORPUS_FOLDER\n", argv[0]);
        return 2;
    }
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(argv[1])) {
        std::ifstream stream(entry.path(), std::ios::binary);
        const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), {}};
        const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
        constexpr std::size_t kCuts = 16;
        for (std::size_t cut = 0; cut <= kCuts; ++cut)
            brume::fuzz::runOne({data, bytes.size() - bytes.size() * cut / kCuts});
        ++count;
    }
    std::printf("%d files\n", count);
    return count > 0 ? 0 : 1;
}
