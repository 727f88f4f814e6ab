// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <view/script.hpp>
#include <view/window.hpp>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace brume::view {
Script::Script(const std::filesystem::path& file) {
    std::ifstream stream(file);
    if (!stream) throw inputError("reading script", file.string(), "no such file");
    std::ostringstream text;
    text << stream.rdbuf();
    mLines = parseScript(text.str(), file.string());
}

bool Script::mustWait(const ScriptLine& line, const Stage& stage) {
    if (line.verb == "frames") {
        if (mFramesLeft == 0) mFramesLeft = static_cast<int>(scriptNumber(line, 0)) + 1;
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
        const ScriptLine& line = mLines[mNext];
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

void Script::run(const ScriptLine& line, Stage& stage, ScriptInput& input) {
    const std::string& verb = line.verb;
    const std::string word = line.words.empty() ? "" : line.words[0];
    if (verb == "play" || verb == "pause") stage.timeline.isPlaying = verb == "play";
    if (verb == "seek") stage.timeline.seek(scriptNumber(line, 0));
    if (verb == "end") stage.timeline.setEnd(scriptNumber(line, 0));
    if (verb == "turn") stage.camera.apply({.turn = {scriptNumber(line, 0), scriptNumber(line, 1)}});
    if (verb == "shift")
        stage.camera.apply({.shift = {scriptNumber(line, 0), scriptNumber(line, 1)}, .viewHeight = 500});
    if (verb == "zoom") stage.camera.apply({.zoom = scriptNumber(line, 0)});
    if (verb == "resolution")
        stage.resolutionDivisor = std::clamp(static_cast<int>(scriptNumber(line, 0)), 1, 8);
    if (verb == "exposure") stage.exposure = scriptNumber(line, 0);
    if (verb == "key") input.key = scriptKey(word);
    if (verb == "mouse" || verb == "press") input.mouse = {scriptNumber(line, 0), scriptNumber(line, 1)};
    if (verb == "press") input.isPressed = true;
    if (verb == "window") input.capture = word;
    if (verb == "picture") stage.saveScreenshot(word);
    if (verb == "record") stage.startRecording(word);
    if (verb == "quit") input.isEnd = true;
    runSetting(line, stage);
}

void Script::runSetting(const ScriptLine& line, Stage& stage) {
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
        if (const std::optional<double> at = parseScriptNumber(word)) stage.splitAt = *at;
    }
    if (verb == "show")
        stage.show = word == "picture"     ? Show::Picture
                     : word == "reference" ? Show::Reference
                     : word == "errors"    ? Show::Errors
                     : word == "layers"    ? Show::Layers
                                           : Show::Fragments;
}

}  // namespace brume::view
