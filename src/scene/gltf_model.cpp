// SPDX-License-Identifier: Apache-2.0
// Reads a glTF file into tinygltf's model and checks what tinygltf would not survive.
#include <scene/gltf_model.hpp>
#include <scene/json_document.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <filesystem>
#include <fstream>

namespace brume::scene {
namespace {

constexpr const char* kDoing = "loading mesh";
constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{1} << 30;

}  // namespace

Error GltfModel::error(const char* list, int index, const std::string& problem) const {
    return inputError(kDoing, name, fmt::format("{}[{}]: {}", list, index, problem));
}

Error GltfModel::error(const std::string& problem) const {
    return inputError(kDoing, name, problem);
}

namespace {

const std::set<std::string> kKnownExtensions() {
    return {"KHR_materials_transmission",      "KHR_materials_volume",  "KHR_materials_ior",
            "KHR_materials_emissive_strength", "KHR_texture_transform", "KHR_mesh_quantization"};
}

/// Reads a regular file of limited size, for us and for tinygltf.
bool readWholeFile(std::vector<unsigned char>* out, std::string* problem, const std::string& path,
                   void*) {
    std::error_code error;
    const std::uintmax_t size =
        std::filesystem::is_regular_file(path, error) ? std::filesystem::file_size(path, error) : 0;
    if (error || size == 0 || size > kMaxFileBytes) {
        *problem =
            size > kMaxFileBytes ? "too large, at most 1 GiB is allowed" : "no such file, or empty";
        return false;
    }
    out->resize(static_cast<std::size_t>(size));
    std::ifstream stream(path, std::ios::binary);
    if (stream.read(reinterpret_cast<char*>(out->data()), static_cast<std::streamsize>(size)))
        return true;
    *problem = "cannot be read";
    return false;
}

bool isRegularFile(const std::string& path, void*) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored);
}

/// Keeps an image as it is in its file. Images in buffer views are left alone: tinygltf has not
/// checked those pointers.
bool keepImageBytes(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                    const unsigned char* bytes, int size, void*) {
    if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
    image->as_is = true;
    return true;
}

bool isBinary(const std::vector<unsigned char>& bytes) {
    return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
}

/// The JSON text of a file; of a binary one, its first chunk.
std::string extractJson(const GltfModel& gltf, const std::vector<unsigned char>& bytes) {
    if (!isBinary(bytes)) return {bytes.begin(), bytes.end()};
    std::uint32_t words[5] = {};  // magic, version, length, length of chunk 0, type of chunk 0
    if (bytes.size() < sizeof words) throw gltf.error("cut off in its header");
    std::memcpy(words, bytes.data(), sizeof words);
    if (words[1] != 2) throw gltf.error(fmt::format("glTF version {}, must be 2", words[1]));
    if (words[2] > bytes.size() || words[3] > bytes.size() - sizeof words)
        throw gltf.error(fmt::format("cut off: {} bytes of {}", bytes.size(), words[2]));
    return {bytes.begin() + sizeof words,
            bytes.begin() + static_cast<std::ptrdiff_t>(sizeof words + words[3])};
}

/// What tinygltf would not survive or not notice: deep nesting, several copies of the binary chunk.
void checkJson(const GltfModel& gltf, const std::string& text) {
    JsonRules rules;
    rules.doing = kDoing;
    rules.name = gltf.name;
    rules.isStrict = false;
    rules.keepPlaces = false;
    rules.maxBytes = std::size_t{256} << 20;
    const JsonDocument document = JsonDocument::parse(text, rules);
    const nlohmann::json& root = document.root();
    if (!root.is_object()) throw gltf.error("the JSON root must be an object");
    const auto buffers = root.find("buffers");
    if (buffers == root.end() || !buffers->is_array()) return;
    for (std::size_t i = 1; i < buffers->size(); ++i)
        if (!(*buffers)[i].contains("uri"))
            throw gltf.error("buffers", static_cast<int>(i),
                             "has no uri, which only the first buffer of a .glb may lack");
}

void parseModel(GltfModel& gltf, const std::vector<unsigned char>& bytes,
                const std::filesystem::path& file) {
    const std::string text = extractJson(gltf, bytes);
    checkJson(gltf, text);
    tinygltf::TinyGLTF parser;
    parser.SetImageLoader(keepImageBytes, nullptr);
    tinygltf::FsCallbacks files{};
    files.FileExists = isRegularFile;
    files.ExpandFilePath = tinygltf::ExpandFilePath;
    files.ReadWholeFile = readWholeFile;
    parser.SetFsCallbacks(files);
    std::string problem, warning;
    const std::string folder = file.parent_path().string();
    bool isRead = false;
    try {
        isRead = isBinary(bytes)
                     ? parser.LoadBinaryFromMemory(&gltf.model, &problem, &warning, bytes.data(),
                                                   static_cast<unsigned>(bytes.size()), folder)
                     : parser.LoadASCIIFromString(&gltf.model, &problem, &warning, text.data(),
                                                  static_cast<unsigned>(text.size()), folder);
    } catch (const std::exception& exception) {
        problem = exception.what();
    }
    if (!isRead)
        throw gltf.error(quoteForMessage(problem.empty() ? "not valid glTF" : problem, 300));
}

void checkExtensions(const GltfModel& gltf) {
    const std::set<std::string> known = kKnownExtensions();
    for (const std::string& name : gltf.model.extensionsRequired)
        if (!known.contains(name))
            throw gltf.error(fmt::format("requires the extension {}, supported are {}",
                                         quoteForMessage(name, 60), fmt::join(known, ", ")));
    for (const std::string& name : gltf.model.extensionsUsed)
        if (!known.contains(name)) gltf.ignored.insert(quoteForMessage(name, 60));
    if (!gltf.model.animations.empty()) gltf.ignored.insert("animations");
    if (!gltf.model.skins.empty()) gltf.ignored.insert("skins");
}

}  // namespace

std::vector<unsigned char> readGltfBytes(const std::filesystem::path& file) {
    std::vector<unsigned char> bytes;
    std::string problem;
    if (!readWholeFile(&bytes, &problem, file.string(), nullptr))
        throw inputError(kDoing, file.string(), problem);
    return bytes;
}

GltfModel parseGltfModel(const std::vector<unsigned char>& bytes,
                         const std::filesystem::path& file) {
    GltfModel gltf;
    gltf.name = file.string();
    if (bytes.empty()) throw gltf.error("the file is empty");
    parseModel(gltf, bytes, file);
    checkExtensions(gltf);
    return gltf;
}

}  // namespace brume::scene
