// SPDX-License-Identifier: Apache-2.0
// Texts of options: the first byte chooses which.
#include <app/option_text.hpp>
#include <app/sequence.hpp>
#include <bench/method_word.hpp>
#include <fuzz/target.hpp>

void brume::fuzz::parse(Bytes bytes) {
    if (bytes.empty()) return;
    const std::string text = textOf(bytes.subspan(1));
    switch (bytes[0]) {
        case 'm':
            bench::parseMethodWord(text);
            break;
        case 's':
            app::parseSettings({text});
            break;
        case 'x': {
            const ivec2 size = app::parseSize(text);
            if (size.x < 1 || size.y < 1) std::abort();
            break;
        }
        case 'f':
            if (app::parseFrames(text).count() < 1) std::abort();
            break;
        default: {
            const app::Shard shard = app::parseShard(text);
            const app::FrameRange part = app::framesOf({3, 1000}, shard);
            if (part.count() < 0 || part.count() > 998) std::abort();
        }
    }
}
