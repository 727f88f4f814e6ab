// SPDX-License-Identifier: Apache-2.0
// Scripts of the viewer.
#include <fuzz/target.hpp>
#include <view/script_lines.hpp>

void brume::fuzz::parse(Bytes bytes) {
    for (const view::ScriptLine& line : view::parseScript(textOf(bytes), "a.script"))
        if (line.verb == "seek" && !(view::scriptNumber(line, 0) <= 1e9)) std::abort();
}
