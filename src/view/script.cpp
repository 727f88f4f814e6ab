// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <view/script.hpp>
#include <view/window.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

namespace brume::view {
namespace {

constexpr const char* kReading = "reading script";

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

/// 0 for what is no key.
int keyOf(const std::string& name) {
    if (const auto found = kKeys.find(name); found != kKeys.end()) return found->second;
    const char c = name.size() == 1 ? name[0] : ' ';
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') ? c : 0;
}

std::optional<double> parseNumber(const std::string& word) {
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return value;
}

}  // namespace

Script::Script(const std::filesystem::path& file) : mFile(file) {
    std::ifstream stream(file);
    if (!stream) throw inputError(kReading, file.string(), "no such file");
    int number = 0;
    for (std::string text; std::getline(stream, text);) {
        ++number;
        std::istringstream words(text.substr(0, text.find('#')));
        Line line{.number = number};
        if (!(words >> line.verb)) continue;
        for (std::string word; words >> word;) line.words.push_back(word);
        check(line);
        mLines.push_back(std::move(line));
    }
}

Error Script::refuse(const Line& line, const std::string& problem) const {
    return inputError(kReading, fmt::format("{}:{}", mFile.string(), line.number), problem);
}

void Script::check(const Line& line) const {
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
        for (std::size_t i = 0; i < line.words.size(); ++i) number(line, i);
    if (const auto words = kWords.find(line.verb);
        words != kWords.end() && !words->second.contains(line.words[0]))
        throw refuse(line, fmt::format("unknown word {}, allowed are {}", line.words[0],
                                       fmt::join(words->second, ", ")));
    if (line.verb == "key" && keyOf(line.words[0]) == 0)
        throw refuse(line, fmt::format("unknown key {}", line.words[0]));
    if (line.verb == "set" && line.words[0].find('=') == std::string::npos)
        throw refuse(line, "not of the form key=value");
}

double Script::number(const Line& line, std::size_t word) const {
    const std::optional<double> value = parseNumber(line.words[word]);
    if (!value) throw refuse(line, fmt::format("{} is no number", line.words[word]));
    return *value;
}

bool Script::mustWait(const Line& line, const Stage& stage) {
    if (line.verb == "frames") {
        if (mFramesLeft == 0) mFramesLeft = static_cast<int>(number(line, 0)) + 1;
        return --mFramesLeft > 0;
    }
    if (line.verb != "wait") return false;
    if (line.words[0] == "settled") return !stage.isSettled();
    if (line.words[0] == "recorded") return stage.isRecording();
    if (line.words[0] == "compared") return !stage.isSettled() || stage.comparison().divisor == 0;
    return !stage.isSettled() || stage.comparisonProgress() ||
           stage.comparison().divisor != stage.resolutionDivisor;
}

// Input takes a frame each, so that it is seen.
ScriptInput Script::step(Stage& stage) {
    ScriptInput input;
    input.mouse = mMouse;
    while (mNext < mLines.size()) {
        const Line& line = mLines[mNext];
        if (mustWait(line, stage)) return input;
        ++mNext;
        run(line, stage, input);
        mMouse = input.mouse;
        const bool takesFrame = input.key != 0 || input.isPressed || !input.capture.empty() ||
                                line.verb == "mouse";
        if (takesFrame || input.isEnd) return input;
    }
    input.isEnd = true;
    return input;
}

void Script::run(const Line& line, Stage& stage, ScriptInput& input) {
    const std::string& verb = line.verb;
    const std::string word = line.words.empty() ? "" : line.words[0];
    if (verb == "play" || verb == "pause") stage.timeline.isPlaying = verb == "play";
    if (verb == "seek") stage.timeline.seek(number(line, 0));
    if (verb == "end") stage.timeline.setEnd(number(line, 0));
    if (verb == "turn") stage.camera.apply({.turn = {number(line, 0), number(line, 1)}});
    if (verb == "shift")
        stage.camera.apply({.shift = {number(line, 0), number(line, 1)}, .viewHeight = 500});
    if (verb == "zoom") stage.camera.apply({.zoom = number(line, 0)});
    if (verb == "resolution")
        stage.resolutionDivisor = std::clamp(static_cast<int>(number(line, 0)), 1, 8);
    if (verb == "exposure") stage.exposure = number(line, 0);
    if (verb == "key") input.key = keyOf(word);
    if (verb == "mouse" || verb == "press") input.mouse = {number(line, 0), number(line, 1)};
    if (verb == "press") input.isPressed = true;
    if (verb == "window") input.capture = word;
    if (verb == "picture") stage.saveScreenshot(word);
    if (verb == "record") stage.startRecording(word);
    if (verb == "quit") input.isEnd = true;
    runSetting(line, stage);
}

void Script::runSetting(const Line& line, Stage& stage) {
    const std::string& verb = line.verb;
    if (line.words.empty()) return;
    const std::string& word = line.words[0];
    if (verb == "method") stage.choices[0] = {word, {}, stage.choices[0].shadow};
    if (verb == "right") stage.choices[1] = {word, {}, stage.choices[1].shadow};
    if (verb == "shadow") stage.choices[0].shadow = word;
    if (verb == "preview") stage.preview.isEnabled = word == "on";
    if (verb == "set") {
        const std::size_t equals = word.find('=');
        stage.choices[0].settings[word.substr(0, equals)] = word.substr(equals + 1);
    }
    if (verb == "split") {
        stage.isSplit = word != "off";
        if (const std::optional<double> at = parseNumber(word)) stage.splitAt = *at;
    }
    if (verb == "show")
        stage.show = word == "picture"     ? Show::Picture
                     : word == "reference" ? Show::Reference
                     : word == "errors"    ? Show::Errors
                     : word == "layers"    ? Show::Layers
                                           : Show::Fragments;
}

}  // namespace brume::view
