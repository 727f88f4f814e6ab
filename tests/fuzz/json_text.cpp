// SPDX-License-Identifier: Apache-2.0
// Edits of effect files in place, as the viewer makes them: each value that is no list or object in
// turn becomes 7, then a member is added beside it. The text must be JSON again with just that changed.
#include <fuzz/target.hpp>
#include <view/json_text.hpp>

namespace {

void expect(bool isRight) {
    if (!isRight) std::abort();
}

}  // namespace

void brume::fuzz::parse(Bytes bytes) {
    const view::JsonText original(textOf(bytes), "a.effect.json");
    const nlohmann::json flat = original.root().flatten();
    int tried = 0;
    for (const auto& [pointer, value] : flat.items()) {
        // The viewer's pointers have no escapes, and lists of it no members like numbers.
        if (value.is_structured() || pointer.find('~') != std::string::npos) continue;
        if (++tried > 8) break;
        view::JsonText text(original.text(), "a.effect.json");
        text.set(pointer, 7);
        nlohmann::json expected = original.root();
        expected[nlohmann::json::json_pointer(pointer)] = 7;
        expect(text.root() == expected);
        const std::string parent = pointer.substr(0, pointer.rfind('/'));
        if (!expected.at(nlohmann::json::json_pointer(parent)).is_object()) continue;
        text.set(parent + "/added", 2.5);
        expected[nlohmann::json::json_pointer(parent + "/added")] = 2.5;
        expect(text.root() == expected);
    }
}
