// SPDX-License-Identifier: Apache-2.0
// glTF materials to Brume's three kinds of surface.
#include <scene/gltf_model.hpp>
#include <scene/json_document.hpp>
#include <scene/texture.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace brume::scene {
namespace {

/// Absorption is capped through these, so that attenuation colour 0 stays finite.
constexpr double kSmallestAttenuation = 1e-6;
constexpr double kShortestDistance = 1e-6;

/// Reads numbers out of one material's object, checking their ranges.
class FactorReader {
  public:
    FactorReader(const GltfModel& gltf, int index) : mGltf(gltf), mIndex(index) {}

    double check(const std::string& name, double value, double lo, double hi) const {
        if (!(value >= lo && value <= hi))
            throw mGltf.error("materials", mIndex,
                              fmt::format("{} is {}, must be from {} to {}", name, value, lo, hi));
        return value;
    }

    double number(const tinygltf::Value& object, const std::string& name, double fallback,
                  double lo, double hi) const {
        if (!object.IsObject() || !object.Has(name)) return fallback;
        const tinygltf::Value& value = object.Get(name);
        if (!value.IsNumber()) throw mGltf.error("materials", mIndex, name + " must be a number");
        return check(name, value.GetNumberAsDouble(), lo, hi);
    }

    dvec3 color(const tinygltf::Value& object, const std::string& name) const {
        dvec3 result(1);
        if (!object.IsObject() || !object.Has(name)) return result;
        const tinygltf::Value& value = object.Get(name);
        for (int channel = 0; channel < 3; ++channel) {
            if (value.ArrayLen() != 3 || !value.Get(channel).IsNumber())
                throw mGltf.error("materials", mIndex, name + " must be three numbers");
            result[channel] = check(name, value.Get(channel).GetNumberAsDouble(), 0, 1);
        }
        return result;
    }

  private:
    const GltfModel& mGltf;
    int mIndex;
};

const tinygltf::Value* findExtension(const tinygltf::ExtensionMap& extensions, const char* name) {
    const auto it = extensions.find(name);
    return it != extensions.end() && it->second.IsObject() ? &it->second : nullptr;
}

UvSource readUvSource(const GltfModel& gltf, int material, const tinygltf::TextureInfo& info) {
    UvSource uv;
    uv.set = info.texCoord;
    const tinygltf::Value* transform = findExtension(info.extensions, "KHR_texture_transform");
    if (!transform) return uv;
    const FactorReader factors(gltf, material);
    for (const auto& [name, target] : {std::pair("offset", &uv.offset), {"scale", &uv.scale}}) {
        if (!transform->Has(name)) continue;
        const tinygltf::Value& value = transform->Get(name);
        for (int axis = 0; axis < 2; ++axis) {
            if (value.ArrayLen() != 2 || !value.Get(axis).IsNumber())
                throw gltf.error("materials", material,
                                 fmt::format("{} must be two numbers", name));
            (*target)[axis] = factors.check(name, value.Get(axis).GetNumberAsDouble(), -1e6, 1e6);
        }
    }
    uv.rotation = factors.number(*transform, "rotation", 0, -1e6, 1e6);
    uv.set = static_cast<int>(factors.number(*transform, "texCoord", uv.set, 0, 64));
    return uv;
}

}  // namespace

vec2 UvSource::apply(const vec2& uv) const {
    const dvec2 scaled = scale * dvec2(uv);
    const double c = std::cos(rotation), s = std::sin(rotation);
    // KHR_texture_transform: translation * rotation * scale.
    return vec2(dvec2(c * scaled.x - s * scaled.y, s * scaled.x + c * scaled.y) + offset);
}

GltfMaterial GltfMaterialReader::read(int index) {
    const tinygltf::Material& source = pick(mGltf, mGltf.model.materials, "materials", index);
    if (source.alphaMode != "OPAQUE" && source.alphaMode != "MASK" && source.alphaMode != "BLEND")
        throw mGltf.error("materials", index,
                          "alphaMode is \"" + quoteForMessage(source.alphaMode, 40) +
                              "\", must be OPAQUE, MASK or BLEND");
    GltfMaterial result;
    result.material.name = quoteForMessage(
        source.name.empty() ? "material " + std::to_string(index) : source.name, 100);
    readColor(source, index, result);
    readEmission(source, index, result);
    readGlass(source, index, result.material);
    if (source.normalTexture.index >= 0) mGltf.ignored.insert("normal textures");
    if (source.occlusionTexture.index >= 0) mGltf.ignored.insert("occlusion textures");
    if (source.pbrMetallicRoughness.metallicRoughnessTexture.index >= 0)
        mGltf.ignored.insert("roughness textures");
    return result;
}

/// Base colour and alpha: OPAQUE and MASK give an opaque surface, BLEND a thin one.
void GltfMaterialReader::readColor(const tinygltf::Material& source, int index,
                                   GltfMaterial& result) {
    const FactorReader factors(mGltf, index);
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    if (pbr.baseColorFactor.size() != 4)
        throw mGltf.error("materials", index, "baseColorFactor must be four numbers");
    for (const double factor : pbr.baseColorFactor) factors.check("baseColorFactor", factor, 0, 1);
    const dvec3 color(pbr.baseColorFactor[0], pbr.baseColorFactor[1], pbr.baseColorFactor[2]);
    Material& material = result.material;
    material.roughness = factors.check("roughnessFactor", pbr.roughnessFactor, 0, 1);
    material.coverage = source.alphaMode == "OPAQUE" ? 1 : pbr.baseColorFactor[3];
    if (source.alphaMode == "MASK")
        material.alphaCutoff = factors.check("alphaCutoff", source.alphaCutoff, 0, 1e6);
    material.type = source.alphaMode == "BLEND" ? MaterialType::Thin : MaterialType::Opaque;
    material.albedo = color;
    material.reflected = color;
    if (pbr.baseColorTexture.index >= 0) {
        result.uv = readUvSource(mGltf, index, pbr.baseColorTexture);
        material.colorTexture = readTexture(pbr.baseColorTexture.index,
                                            /*keepAlpha=*/source.alphaMode != "OPAQUE");
    }
}

void GltfMaterialReader::readEmission(const tinygltf::Material& source, int index,
                                      GltfMaterial& result) {
    const FactorReader factors(mGltf, index);
    double strength = 1;
    if (const auto* extension = findExtension(source.extensions, "KHR_materials_emissive_strength"))
        strength = factors.number(*extension, "emissiveStrength", 1, 0, 1e9);
    if (source.emissiveFactor.empty()) return;
    if (source.emissiveFactor.size() != 3)
        throw mGltf.error("materials", index, "emissiveFactor must be three numbers");
    for (int channel = 0; channel < 3; ++channel)
        result.material.emission[channel] =
            strength * factors.check("emissiveFactor",
                                     source.emissiveFactor[static_cast<std::size_t>(channel)], 0,
                                     1e9);
    if (source.emissiveTexture.index < 0) return;
    result.material.emissionTexture =
        readTexture(source.emissiveTexture.index, /*keepAlpha=*/false);
    const UvSource uv = readUvSource(mGltf, index, source.emissiveTexture);
    if (!result.material.colorTexture)
        result.uv = uv;
    else if (uv.set != result.uv.set || uv.offset != result.uv.offset ||
             uv.scale != result.uv.scale || uv.rotation != result.uv.rotation)
        mGltf.ignored.insert("texture coordinates of emission that differ from those of colour");
}

/// Transmission makes a thin surface; with a thickness too, the inside of a solid.
void GltfMaterialReader::readGlass(const tinygltf::Material& source, int index,
                                   Material& material) const {
    const FactorReader factors(mGltf, index);
    if (const auto* extension = findExtension(source.extensions, "KHR_materials_ior")) {
        // 0 stands for infinity in the extension; Brume takes the default instead.
        const double ior = factors.number(*extension, "ior", 1.5, 0, 10);
        material.ior = ior == 0 ? 1.5 : std::max(ior, 1.0);
    }
    const auto* glass = findExtension(source.extensions, "KHR_materials_transmission");
    const double transmission = glass ? factors.number(*glass, "transmissionFactor", 0, 0, 1) : 0.0;
    if (!(transmission > 0)) {
        if (material.type == MaterialType::Thin) material.roughness = -1;  // leaves, cloth: matt
        return;
    }
    if (glass->Has("transmissionTexture")) mGltf.ignored.insert("transmission textures");
    const dvec3 color = material.albedo;
    const auto* volume = findExtension(source.extensions, "KHR_materials_volume");
    const double thickness = volume ? factors.number(*volume, "thicknessFactor", 0, 0, 1e30) : 0.0;
    if (thickness > 0) {
        material.type = MaterialType::Solid;
        const dvec3 attenuation = factors.color(*volume, "attenuationColor");
        if (volume->Has("thicknessTexture")) mGltf.ignored.insert("thickness textures");
        if (color != dvec3(1) || material.colorTexture)
            mGltf.ignored.insert("base colour of solid glass");
        if (!volume->Has("attenuationDistance")) return;  // infinite: no absorption
        const double distance =
            factors.number(*volume, "attenuationDistance", 1, kShortestDistance, kInfinity);
        // KHR_materials_volume: transmittance over a distance x = attenuationColor^(x / distance).
        for (int channel = 0; channel < 3; ++channel)
            material.absorption[channel] =
                -std::log(std::max(attenuation[channel], kSmallestAttenuation)) / distance + 0.0;
        return;
    }
    material.type = MaterialType::Thin;
    material.transmission = transmission * color;
    material.reflected = (1 - transmission) * color;
}

std::vector<unsigned char> GltfMaterialReader::imageBytes(int index) const {
    const tinygltf::Image& image = pick(mGltf, mGltf.model.images, "images", index);
    if (image.bufferView >= 0) {
        const std::span<const unsigned char> bytes = viewBytes(mGltf, image.bufferView);
        return {bytes.begin(), bytes.end()};
    }
    if (image.image.empty())
        throw mGltf.error("images", index,
                          "cannot be read: \"" + quoteForMessage(image.uri, 200) + "\"");
    return image.image;  // as it was in the file: see the image callback
}

std::shared_ptr<const Texture> GltfMaterialReader::readTexture(int index, bool keepAlpha) {
    const tinygltf::Texture& source = pick(mGltf, mGltf.model.textures, "textures", index);
    if (source.source < 0) {
        mGltf.ignored.insert("textures without a PNG or JPEG image");
        return nullptr;
    }
    std::shared_ptr<const Texture>& texture = mTextures[{source.source, keepAlpha}];
    if (!texture)
        texture =
            decodeTexture(imageBytes(source.source),
                          fmt::format("{}: images[{}]", mGltf.name, source.source), keepAlpha);
    return texture;
}

}  // namespace brume::scene
