// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <scene/settings.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace brume::scene {
namespace {

/// The whole text as a number, or nothing.
template <typename T>
bool parseWhole(const std::string& text, T& value) {
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && stop == end;
}

}  // namespace

SettingsReader::SettingsReader(const Settings& settings, std::string doing)
    : mSettings(settings), mDoing(std::move(doing)) {}

const std::string* SettingsReader::find(const std::string& key) {
    mKnown.push_back(key);
    const auto it = mSettings.find(key);
    return it == mSettings.end() ? nullptr : &it->second;
}

double SettingsReader::number(const std::string& key, double fallback, double lo, double hi) {
    const std::string* text = find(key);
    if (!text) return fallback;
    double value = 0;
    if (!parseWhole(*text, value) || !(value >= lo && value <= hi))
        throw inputError(mDoing, "",
                         fmt::format("setting \"{}\" is \"{}\", must be a number from {} to {}",
                                     key, *text, lo, hi));
    return value;
}

long long SettingsReader::integer(const std::string& key, long long fallback, long long lo,
                                  long long hi) {
    const std::string* text = find(key);
    if (!text) return fallback;
    long long value = 0;
    if (!parseWhole(*text, value) || value < lo || value > hi)
        throw inputError(mDoing, "",
                         fmt::format("setting \"{}\" is \"{}\", must be an integer from {} to {}",
                                     key, *text, lo, hi));
    return value;
}

bool SettingsReader::boolean(const std::string& key, bool fallback) {
    return choice(key, fallback ? "true" : "false", {"true", "false"}) == "true";
}

std::string SettingsReader::choice(const std::string& key, const std::string& fallback,
                                   const std::vector<std::string>& allowed) {
    const std::string* text = find(key);
    if (!text) return fallback;
    if (std::find(allowed.begin(), allowed.end(), *text) == allowed.end())
        throw inputError(mDoing, "",
                         fmt::format("setting \"{}\" is \"{}\", must be one of {}", key, *text,
                                     fmt::join(allowed, ", ")));
    return *text;
}

void SettingsReader::finish() const {
    for (const auto& [key, value] : mSettings)
        if (std::find(mKnown.begin(), mKnown.end(), key) == mKnown.end())
            throw inputError(
                mDoing, "",
                fmt::format("unknown setting \"{}\", {}", key,
                            mKnown.empty() ? "there are none"
                                           : fmt::format("known are {}", fmt::join(mKnown, ", "))));
}

}  // namespace brume::scene
