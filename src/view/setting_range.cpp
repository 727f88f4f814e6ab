// SPDX-License-Identifier: Apache-2.0
#include <view/setting_range.hpp>

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace brume::view {
namespace {

std::string_view trim(std::string_view text) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
    return text;
}

/// Takes a number off the front.
std::optional<double> takeNumber(std::string_view& text) {
    text = trim(text);
    // "1..64": from_chars would take the first point.
    const std::size_t dots = text.find("..");
    const std::string_view head = text.substr(0, dots);
    double value = 0;
    const auto [end, error] = std::from_chars(head.data(), head.data() + head.size(), value);
    if (error != std::errc()) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - head.data()));
    return value;
}

std::vector<std::string> splitChoices(std::string_view text) {
    std::vector<std::string> choices;
    while (!text.empty()) {
        const std::size_t comma = text.find(',');
        choices.emplace_back(trim(text.substr(0, comma)));
        text = comma == std::string_view::npos ? "" : text.substr(comma + 1);
    }
    return choices;
}

bool isWhole(double value) { return value == std::floor(value); }

/// Units are short words; longer texts are sentences.
bool looksLikeUnit(std::string_view text) {
    return !text.empty() && text.size() <= 8 && text.find(' ') == std::string_view::npos;
}

}  // namespace

std::optional<double> leadingNumber(std::string_view text) { return takeNumber(text); }

std::string formatNumber(double value) { return fmt::format("{:.6g}", value); }

SettingRange readRange(const scene::SettingInfo& info) {
    SettingRange range;
    std::string_view rest = info.values;
    const std::optional<double> fallback = leadingNumber(info.defaultValue);
    if (rest.find("..") != std::string_view::npos) {
        const std::optional<double> lo = takeNumber(rest);
        rest = trim(rest);
        if (!lo || !rest.starts_with("..")) return range;
        rest.remove_prefix(2);
        const std::optional<double> hi = takeNumber(rest);
        if (!hi) return range;
        range.kind = SettingRange::Kind::Number;
        range.lo = *lo;
        range.hi = *hi;
        range.unit = trim(rest.substr(0, rest.find(',')));
        range.isWhole = isWhole(*lo) && isWhole(*hi) && *hi - *lo > 1 && fallback &&
                        isWhole(*fallback);
        range.isWide = *hi > 1e4 * std::max(*lo, 1.0) || (*lo > 0 && *hi > 1e4 * *lo);
        return range;
    }
    if (rest.find(',') != std::string_view::npos) {
        range.choices = splitChoices(rest);
        const bool isFlag = range.choices == std::vector<std::string>{"true", "false"};
        range.kind = isFlag ? SettingRange::Kind::Flag : SettingRange::Kind::Choice;
        return range;
    }
    if (!fallback || !looksLikeUnit(rest)) return range;
    range.kind = SettingRange::Kind::Number;
    range.unit = rest;
    return range;
}

}  // namespace brume::view
