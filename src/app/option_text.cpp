// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <app/option_text.hpp>
#include <charconv>
#include <core/error.hpp>
#include <optional>
#include <string_view>

namespace brume::app {
namespace {

constexpr int kMaxImageSize = 16384;

std::optional<int> parseInteger(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

}  // namespace

ivec2 parseSize(const std::string& text) {
    const std::size_t cross = text.find('x');
    const auto fail = [&] {
        return inputError("reading options", "--size " + text,
                          fmt::format("not WIDTHxHEIGHT with both in 1..{}", kMaxImageSize));
    };
    if (cross == std::string::npos) throw fail();
    const auto width = parseInteger(std::string_view(text).substr(0, cross));
    const auto height = parseInteger(std::string_view(text).substr(cross + 1));
    if (!width || !height || *width < 1 || *height < 1 || *width > kMaxImageSize ||
        *height > kMaxImageSize)
        throw fail();
    return {*width, *height};
}

scene::Settings parseSettings(const std::vector<std::string>& words) {
    scene::Settings settings;
    for (const std::string& word : words) {
        const std::size_t equals = word.find('=');
        if (equals == 0 || equals == std::string::npos)
            throw inputError("reading options", "--set " + word, "not of the form key=value");
        settings[word.substr(0, equals)] = word.substr(equals + 1);
    }
    return settings;
}

}  // namespace brume::app
