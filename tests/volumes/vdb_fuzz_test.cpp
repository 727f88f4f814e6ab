// SPDX-License-Identifier: Apache-2.0
// Damaged files must give an image or an error: never a crash, a hang or a huge allocation.
#include <volumes/allocation_watch.hpp>
#include <volumes/support.hpp>
#include <volumes/vdb_writer.hpp>

#include <chrono>
#include <fstream>
#include <functional>
#include <iterator>

namespace brume::volumes::test {
namespace {

using Bytes = std::vector<unsigned char>;

Bytes readAll(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return Bytes(std::istreambuf_iterator<char>(in), {});
}

/// Damages a file in one of the ways that happen: flipped bits, wrong counts, lost and moved
/// pieces.
class Mutator {
  public:
    explicit Mutator(unsigned seed) : mRandom(seed) {}

    Bytes mutate(const Bytes& original) {
        Bytes bytes = original;
        const int count = 1 + static_cast<int>(below(4));
        for (int i = 0; i < count && !bytes.empty(); ++i) mutateOnce(bytes);
        return bytes;
    }

    std::size_t below(std::size_t n) { return n == 0 ? 0 : mRandom() % n; }

    Bytes noise(std::size_t size) {
        Bytes bytes(size);
        for (unsigned char& b : bytes) b = static_cast<unsigned char>(below(256));
        return bytes;
    }

  private:
    /// Half of the damage goes to the head, where the counts are; the rest of a file is mostly
    /// zeros.
    std::size_t place(const Bytes& bytes) {
        return below(2) == 0 ? below(std::min<std::size_t>(bytes.size(), 1500))
                             : below(bytes.size());
    }

    void mutateOnce(Bytes& bytes) {
        const std::size_t at = place(bytes);
        switch (below(6)) {
            case 0:
                bytes[at] ^= static_cast<unsigned char>(1u << below(8));
                break;
            case 1:
                bytes[at] = static_cast<unsigned char>(below(256));
                break;
            case 2:
                writeNumber(bytes, at);
                break;
            case 3:
                bytes.resize(at);
                break;
            case 4:
                bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(at));
                break;
            default: {
                const std::size_t length = below(std::min<std::size_t>(bytes.size() - at, 64));
                const std::size_t from = below(bytes.size() - length);
                std::copy_n(Bytes(bytes).begin() + static_cast<std::ptrdiff_t>(from), length,
                            bytes.begin() + static_cast<std::ptrdiff_t>(at));
            }
        }
    }

    void writeNumber(Bytes& bytes, std::size_t at) {
        constexpr std::uint64_t kNumbers[] = {0,
                                              1,
                                              0x7f,
                                              0xff,
                                              0xffff,
                                              0x7fffffff,
                                              0x80000000,
                                              0xffffffff,
                                              0x100000000,
                                              0x7fffffffffffffff,
                                              0xffffffffffffffff,
                                              0x40000000,
                                              0xfffffff0};
        const std::uint64_t number = kNumbers[below(std::size(kNumbers))];
        const std::size_t width = below(2) == 0 ? 4 : 8;
        for (std::size_t i = 0; i < width && at + i < bytes.size(); ++i)
            bytes[at + i] = static_cast<unsigned char>(number >> (8 * i));
    }

    std::mt19937 mRandom;
};

TestGrid makeSeed(const std::string& type) {
    TestGrid grid;
    grid.type = type;
    for (int i = 0; i < 40; ++i)
        grid.voxels.push_back({{(i * 7) % 19 - 9, (i * 5) % 13 - 6, i % 9}, 0.1 * i});
    if (type != "points") grid.tiles = {{{128, 0, 0}, 2, 0.5}, {{32, 0, 0}, 1, 0.25}};
    return grid;
}

class Fuzzer {
  public:
    explicit Fuzzer(const std::string& extension) : mFile(mFolder / ("fuzz" + extension)) {}

    /// Feeds the bytes to both entry points; returns whether they were accepted.
    bool tryBytes(const Bytes& bytes) {
        std::ofstream(mFile, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()),
                   static_cast<std::streamsize>(bytes.size()));
        const auto start = std::chrono::steady_clock::now();
        bool accepted = false;
        try {
            const auto infos = listGrids(mFile);
            accepted = !infos.empty();
            for (const GridInfo& info : infos) {
                if (!info.refusal.empty()) continue;
                scene::Volume volume = volumeOf(mFile, info.name);
                volume.gridIndex = info.index;
                for (const float value : loadVolume(volume, 1, Log{}).values)
                    EXPECT_TRUE(value >= 0 && value <= kGreatestValue);
            }
        } catch (const Error& e) {
            EXPECT_EQ(e.kind(), ErrorKind::Input) << e.what();
            EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
        }
        const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
        EXPECT_LT(time.count(), 5.0);
        return accepted;
    }

    std::filesystem::path file() const { return mFile; }

  private:
    TempFolder mFolder;
    std::filesystem::path mFile;
};

void fuzz(Fuzzer& fuzzer, const std::vector<Bytes>& seeds, int count) {
    resetLargestAllocation();
    Mutator mutator(2024);
    int accepted = 0;
    for (const Bytes& seed : seeds) EXPECT_TRUE(fuzzer.tryBytes(seed)) << "the undamaged file";
    for (int i = 0; i < count; ++i) {
        Bytes bytes;
        if (i % 20 == 0) {  // noise, with and without an honest start
            bytes = mutator.noise(mutator.below(4096));
            const Bytes& seed = seeds[mutator.below(seeds.size())];
            const std::size_t honest = i % 40 == 0 ? mutator.below(200) : 0;
            std::copy_n(seed.begin(), std::min(honest, bytes.size()), bytes.begin());
        } else {
            bytes = mutator.mutate(seeds[mutator.below(seeds.size())]);
        }
        accepted += fuzzer.tryBytes(bytes);
    }
    EXPECT_LT(largestAllocation(), 1ull << 30);
    printf("%d of %d damaged files were accepted, largest allocation %zu bytes\n", accepted, count,
           largestAllocation());
}

TEST(Fuzz, DamagedVdbFiles_GiveAVolumeOrAnError) {
    Fuzzer fuzzer(".vdb");
    std::vector<Bytes> seeds;
    const auto add = [&](const std::vector<TestGrid>& grids, Packing packing, bool offsets) {
        writeVdb(fuzzer.file(), grids, packing, offsets);
        seeds.push_back(readAll(fuzzer.file()));
    };
    for (const Packing packing : {Packing::ZipMask, Packing::BloscMask, Packing::BloscOnly})
        for (const char* type : {"float", "half"}) add({makeSeed(type)}, packing, true);
    add({makeSeed("double")}, Packing::ZipMask, true);
    add({makeSeed("vec3half"), makeSeed("float")}, Packing::BloscMask, true);
    add({makeSeed("float")}, Packing::BloscMask, false);
    add({makeSeed("bool"), makeSeed("mask"), makeSeed("int32")}, Packing::ZipMask, true);
    TestGrid frustum = makeSeed("float");
    frustum.frustum = true;
    frustum.name = "frustum";
    add({frustum, makeSeed("points")}, Packing::BloscMask, true);
    fuzz(fuzzer, seeds, 10000);
}

TEST(Fuzz, DamagedNvdbFiles_GiveAVolumeOrAnError) {
    Fuzzer fuzzer(".nvdb");
    std::vector<Bytes> seeds;
    for (const char* type : {"float", "fpN", "fp8"})
        for (const NanoPacking packing : {NanoPacking::Zip, NanoPacking::Blosc}) {
            writeNvdb(fuzzer.file(), makeSeed("float"), type, packing);
            seeds.push_back(readAll(fuzzer.file()));
        }
    fuzz(fuzzer, seeds, 9000);
    // Uncompressed trees are large, but only there damage reaches offsets and masks.
    seeds.clear();
    for (const char* type : {"float", "fpN"}) {
        writeNvdb(fuzzer.file(), makeSeed("float"), type, NanoPacking::None);
        seeds.push_back(readAll(fuzzer.file()));
    }
    fuzz(fuzzer, seeds, 1000);
}

}  // namespace
}  // namespace brume::volumes::test
