// SPDX-License-Identifier: Apache-2.0
// How often frames are measured, and that rows say it.
#include <gpu/gpu_fixture.hpp>

#include <bench/measure.hpp>
#include <bench/scenes.hpp>

#include <fmt/format.h>

namespace brume::bench {
namespace {

class MeasureTest : public test::GpuTest {
  protected:
    Row measure(int repeats, int shortRepeats) {
        NamedScene named = makeScenes("layers_2_8x8").at(0);
        MeasureOptions options;
        options.methods = {"unordered"};
        options.repeats = repeats;
        options.shortRepeats = shortRepeats;
        options.withError = false;
        return measureScene(device(), named.name, prepareNamed(named, log()), options, log())
            .at(0)
            .row;
    }
};

TEST_F(MeasureTest, ShortFrames_AreRepeatedAndTheCommandSaysHowOften) {
    const Row row = measure(2, 4);
    EXPECT_GE(row.time.repeats, 2);
    EXPECT_LE(row.time.repeats, 4);
    // Fewer only where they have taken 50 ms.
    EXPECT_TRUE(row.time.repeats == 4 || row.time.p95 > 10) << row.time.repeats;
    EXPECT_NE(row.command.find(fmt::format("--repeats {} ", row.time.repeats)), std::string::npos)
        << row.command;
}

TEST_F(MeasureTest, AskedRepeats_AreExact) { EXPECT_EQ(measure(3, 0).time.repeats, 3); }

}  // namespace
}  // namespace brume::bench
