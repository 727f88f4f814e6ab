// SPDX-License-Identifier: Apache-2.0
#include <view/json_text.hpp>
#include <view/setting_range.hpp>

#include <charconv>

namespace brume::view {
namespace {

constexpr const char* kDoing = "editing";

scene::JsonDocument parse(const std::string& text, const std::string& name) {
    return scene::JsonDocument::parse(text, {.doing = kDoing, .name = name});
}

std::vector<std::string> splitPointer(const std::string& pointer) {
    std::vector<std::string> keys;
    for (std::size_t at = 0; at < pointer.size();) {
        const std::size_t next = std::min(pointer.find('/', at + 1), pointer.size());
        keys.push_back(pointer.substr(at + 1, next - at - 1));
        at = next;
    }
    return keys;
}

/// What stands at a key of an object or an index of an array; null if nothing does.
const scene::PlaceTree* findChild(const scene::PlaceTree& tree, const std::string& key) {
    if (const auto member = tree.members.find(key); member != tree.members.end())
        return &member->second;
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), index);
    const bool isIndex = error == std::errc() && end == key.data() + key.size();
    return isIndex && index < tree.items.size() ? &tree.items[index] : nullptr;
}

}  // namespace

std::string writeJson(const nlohmann::json& value) {
    if (value.is_number_float()) return formatNumber(value.get<double>());
    if (!value.is_array() && !value.is_object()) return value.dump();
    std::string text;
    for (const auto& [key, item] : value.items()) {
        text += text.empty() ? "" : ", ";
        if (value.is_object()) text += nlohmann::json(key).dump() + ": ";
        text += writeJson(item);
    }
    return value.is_array() ? "[" + text + "]" : "{ " + text + " }";
}

JsonText::JsonText(std::string text, std::string name)
    : mText(std::move(text)), mName(std::move(name)), mDocument(parse(mText, mName)) {}

void JsonText::replaceText(std::string text) {
    mDocument.emplace(parse(text, mName));
    mText = std::move(text);
}

std::size_t JsonText::offsetOf(const scene::TextPlace& place) const {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";  // is in no column
    std::size_t at = mText.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
    for (std::uint32_t line = 1; line < place.line; ++line) at = mText.find('\n', at) + 1;
    return at + place.column - 1;
}

// Over blanks and comments.
std::size_t JsonText::skipBlank(std::size_t at) const {
    for (;;) {
        at = std::min(mText.find_first_not_of(" \t\r\n", at), mText.size());
        if (mText.compare(at, 2, "//") == 0)
            at = std::min(mText.find_first_of("\r\n", at), mText.size());
        else if (mText.compare(at, 2, "/*") == 0)
            at = std::min(mText.find("*/", at + 2), mText.size() - 2) + 2;  // "/*/" is no end
        else
            return at;
    }
}

// The text is valid JSON: brackets balance, and only strings and comments can hold others.
std::size_t JsonText::endOfValue(std::size_t start) const {
    int depth = 0;
    std::size_t at = start;
    do {
        at = skipBlank(at);
        const char c = mText[at];
        if (c == '"') {
            do at += mText[at] == '\\' ? 2 : 1;
            while (mText[at] != '"');
            ++at;
        } else if (c == '{' || c == '[') {
            ++depth, ++at;
        } else if (c == '}' || c == ']') {
            --depth, ++at;
        } else if (c == ',' || c == ':') {
            ++at;
        } else {
            at = std::min(mText.find_first_of(" \t\r\n,]}/", at), mText.size());
        }
    } while (depth > 0);
    return at;
}

void JsonText::set(const std::string& pointer, const nlohmann::json& value) {
    const std::vector<std::string> keys = splitPointer(pointer);
    const scene::PlaceTree* tree = &mDocument->places();
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const scene::PlaceTree* child = findChild(*tree, keys[i]);
        if (!child) {
            if (i + 1 < keys.size() || mText[offsetOf(tree->value)] != '{')
                throw inputError(kDoing, mName, "there is no " + pointer);
            return addMember(*tree, keys[i], writeJson(value));
        }
        tree = child;
    }
    const std::size_t start = offsetOf(tree->value), end = endOfValue(start);
    replaceText(mText.substr(0, start) + writeJson(value) + mText.substr(end));
}

// Behind the last member, on a line of its own if that has one.
void JsonText::addMember(const scene::PlaceTree& object, const std::string& key,
                         const std::string& value) {
    const std::string member = nlohmann::json(key).dump() + ": " + value;
    std::size_t last = 0, lastKey = 0;
    for (const auto& [name, tree] : object.members)
        if (offsetOf(tree.value) > last) {
            last = offsetOf(tree.value);
            lastKey = offsetOf(tree.key);
        }
    if (object.members.empty()) {
        const std::size_t at = offsetOf(object.value) + 1;
        return replaceText(mText.substr(0, at) + " " + member + " " + mText.substr(at));
    }
    const std::size_t end = endOfValue(last);
    const std::size_t lineStart = mText.rfind('\n', lastKey) + 1;  // npos + 1: 0
    const std::string indent = mText.substr(lineStart, lastKey - lineStart);
    const bool isOwnLine =
        lineStart > 0 && indent.find_first_not_of(" \t") == std::string::npos;
    replaceText(mText.substr(0, end) + (isOwnLine ? ",\n" + indent : ", ") + member +
                mText.substr(end));
}

}  // namespace brume::view
