// SPDX-License-Identifier: Apache-2.0
// Which frames the parts of a sequence have.
#include <gtest/gtest.h>

#include <app/sequence.hpp>
#include <core/error.hpp>

namespace brume::app {
namespace {

TEST(Sequence, Shards_CoverEveryFrameOnce) {
    for (const int count : {1, 2, 3, 7, 10, 25}) {
        const FrameRange all{11, 20};
        int next = all.first;
        for (int index = 1; index <= count; ++index) {
            const FrameRange part = framesOf(all, {index, count});
            if (part.count() == 0) continue;
            EXPECT_EQ(part.first, next);
            EXPECT_LE(part.count(), (all.count() + count - 1) / count);
            next = part.last + 1;
        }
        EXPECT_EQ(next, all.last + 1);
    }
}

TEST(Sequence, FirstFrames_AreThoseOfThePartsThatHaveAny) {
    EXPECT_EQ(firstFramesOf({11, 20}, 3), (std::vector<int>{11, 14, 17}));
    EXPECT_EQ(firstFramesOf({5, 6}, 4), (std::vector<int>{5, 6}));
}

TEST(Sequence, BadShards_AreRefused) {
    for (const char* text : {"4/3", "-1/3", "1/0", "1", "1/", "/3", "1/3x", "a/b", "1/100001"})
        EXPECT_THROW(parseShard(text), Error) << text;
    for (const char* text : {"3:2", "-1:2", "1", "1:", ":3", "1:2x", "0:1000001"})
        EXPECT_THROW(parseFrames(text), Error) << text;
}

}  // namespace
}  // namespace brume::app
