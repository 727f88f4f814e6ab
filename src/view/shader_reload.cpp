// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <view/programs.hpp>
#include <view/shader_reload.hpp>

#include <unistd.h>

#include <fstream>
#include <iterator>
#include <regex>

namespace brume::view {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDoing = "watching shaders";
constexpr const char* kCompiler = "glslangValidator";

std::string readText(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// The compiler's first line that says what is wrong, without the word ERROR.
std::string firstComplaint(const std::string& output) {
    std::smatch found;
    const std::regex error("ERROR: ([^\n]*)");
    return std::regex_search(output, found, error) ? found[1].str() : "the compiler failed";
}

}  // namespace

ShaderReload::ShaderReload(fs::path folder) : mFolder(fs::absolute(folder).lexically_normal()) {
    if (!fs::exists(mFolder / "common" / "frame.h"))
        throw inputError(kDoing, folder.string(),
                         "has no common/frame.h, it must be the folder shaders of Brume's sources");
    if (!hasProgram(kCompiler))
        throw failure(kDoing, folder.string(), "glslangValidator is not installed (glslang-tools)");
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(mFolder))
        if (entry.is_regular_file()) files.push_back(entry.path());
    mWatch.watch(files);
}

int ShaderReload::poll(gpu::Device& device) {
    const std::vector<fs::path> news = mWatch.takeChanged();
    if (news.empty()) return 0;
    mBroken.insert(news.begin(), news.end());
    std::vector<std::pair<const std::uint32_t*, std::vector<std::uint32_t>>> compiled;
    for (const ShaderSource& shader : listShaders()) {
        std::set<fs::path> seen;
        if (fs::exists(mFolder / shader.file) && dependsOn(mFolder / shader.file, mBroken, seen))
            compiled.emplace_back(shader.embedded.data(), compile(shader));
    }
    // All or nothing: shaders that share a header must agree about it.
    for (auto& [original, words] : compiled) device.replaceShader(original, std::move(words));
    mBroken.clear();
    return static_cast<int>(compiled.size());
}

// Whether the file or what it includes, relative to itself or to the folder, is among `changed`.
bool ShaderReload::dependsOn(const fs::path& file, const std::set<fs::path>& changed,
                             std::set<fs::path>& seen) const {
    if (!seen.insert(file).second) return false;
    if (changed.count(file)) return true;
    const std::string text = readText(file);
    static const std::regex include("#include [\"<]([^\">]+)[\">]");
    for (std::sregex_iterator i(text.begin(), text.end(), include), end; i != end; ++i)
        for (const fs::path& base : {file.parent_path(), mFolder}) {
            const fs::path target = (base / (*i)[1].str()).lexically_normal();
            if (fs::exists(target) && dependsOn(target, changed, seen)) return true;
        }
    return false;
}

std::vector<std::uint32_t> ShaderReload::compile(const ShaderSource& shader) const {
    const fs::path result =
        fs::temp_directory_path() / ("brume_shader_" + std::to_string(::getpid()) + ".spv");
    std::vector<std::string> arguments = {kCompiler,        "-V", "--target-env", "vulkan1.3",
                                          "-I" + mFolder.string(), "-o", result.string()};
    if (*shader.defines) arguments.emplace_back(shader.defines);
    arguments.push_back((mFolder / shader.file).string());
    std::string output;
    const int status = runProgram(arguments, output);
    const std::string bytes = readText(result);
    std::error_code isMissing;
    fs::remove(result, isMissing);
    if (status != 0 || bytes.empty() || bytes.size() % 4 != 0)
        throw inputError("compiling shader", shader.file, firstComplaint(output));
    std::vector<std::uint32_t> words(bytes.size() / 4);
    std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(words.data()));
    return words;
}

}  // namespace brume::view
