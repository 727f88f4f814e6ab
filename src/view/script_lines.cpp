// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <view/script_lines.hpp>
#include <view/window.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

namespace brume::view {
namespace {

/// How many words follow a verb.
const std::map<std::string, std::size_t> kVerbs = {
    {"wait", 1},   {"frames", 1}, {"play", 0},     {"pause", 0},   {"seek", 1},    {"end", 1},
    {"method", 1}, {"right", 1},  {"set", 1},      {"shadow", 1},  {"split", 1},   {"show", 1},
    {"turn", 2},   {"shift", 2},  {"zoom", 1},     {"exposure", 1}, {"preview", 1}, {"key", 1},
    {"resolution", 1},
    {"mouse", 2},  {"press", 2},  {"picture", 1},  {"window", 1},  {"record", 1},  {"quit", 0}};

const std::set<std::string> kWithNumbers = {"frames", "seek",  "end",      "turn",  "shift",
                                            "zoom",   "mouse", "exposure", "press",
                                            "resolution"};

const std::map<std::string, std::set<std::string>> kWords = {
    {"wait", {"settled", "compared", "reference", "recorded"}},
    {"show", {"picture", "reference", "errors", "layers", "fragments"}},
    {"preview", {"on", "off"}}};

const std::map<std::string, int> kKeys = {{"Space", kKeySpace}, {"Left", kKeyLeft},
                                          {"Right", kKeyRight}, {"Home", kKeyHome},
                                          {"End", kKeyEnd},     {"F1", kKeyF1}};

Error refuse(const ScriptLine& line, const std::string& problem) {
    return inputError("reading script", fmt::format("{}:{}", line.file, line.number), problem);
}

void check(const ScriptLine& line) {
    const auto verb = kVerbs.find(line.verb);
    if (verb == kVerbs.end()) {
        std::vector<std::string> known;
        for (const auto& [name, count] : kVerbs) known.push_back(name);
        throw refuse(line, fmt::format("unknown command {}, allowed are {}", line.verb,
                                       fmt::join(known, ", ")));
    }
    if (line.words.size() != verb->second)
        throw refuse(line, fmt::format("{} takes {} words", line.verb, verb->second));
    if (kWithNumbers.contains(line.verb))
        for (std::size_t i = 0; i < line.words.size(); ++i) scriptNumber(line, i);
    if (const auto words = kWords.find(line.verb);
        words != kWords.end() && !words->second.contains(line.words[0]))
        throw refuse(line, fmt::format("unknown word {}, allowed are {}", line.words[0],
                                       fmt::join(words->second, ", ")));
    if (line.verb == "key" && scriptKey(line.words[0]) == 0)
        throw refuse(line, fmt::format("unknown key {}", line.words[0]));
    if (line.verb == "set" && line.words[0].find('=') == std::string::npos)
        throw refuse(line, "not of the form key=value");
}

}  // namespace

int scriptKey(const std::string& name) {
    if (const auto found = kKeys.find(name); found != kKeys.end()) return found->second;
    const char c = name.size() == 1 ? name[0] : ' ';
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') ? c : 0;
}

std::optional<double> parseScriptNumber(const std::string& word) {
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return std::abs(value) <= 1e9 ? std::optional(value) : std::nullopt;  // also NaN
}

double scriptNumber(const ScriptLine& line, std::size_t word) {
    const std::optional<double> value = parseScriptNumber(line.words[word]);
    if (!value) throw refuse(line, fmt::format("{} is no number in -1e9..1e9", line.words[word]));
    return *value;
}

std::vector<ScriptLine> parseScript(const std::string& text, const std::string& name) {
    std::vector<ScriptLine> lines;
    std::istringstream stream(text);
    int number = 0;
    for (std::string row; std::getline(stream, row);) {
        ++number;
        std::istringstream words(row.substr(0, row.find('#')));
        ScriptLine line{.file = name, .number = number};
        if (!(words >> line.verb)) continue;
        for (std::string word; words >> word;) line.words.push_back(word);
        check(line);
        lines.push_back(std::move(line));
    }
    return lines;
}

}  // namespace brume::view
