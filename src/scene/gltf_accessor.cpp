// SPDX-License-Identifier: Apache-2.0
// Typed reads from glTF buffers; every bound is checked here before a byte is touched.
#include <scene/gltf_model.hpp>

#include <fmt/format.h>

#include <cmath>
#include <cstring>

namespace brume::scene {
namespace {

/// `count` elements of `componentCount` numbers in a buffer view.
struct Layout {
    int view = -1;
    std::size_t byteOffset = 0;
    std::size_t count = 0;
    int componentType = 0;
    int componentCount = 0;
    std::size_t stride = 0;  ///< 0: tightly packed
    bool normalized = false;

    std::size_t componentBytes() const {
        const int bytes =
            tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(componentType));
        return bytes > 0 ? static_cast<std::size_t>(bytes) : 0;
    }
};

template <typename T>
double loadAs(const unsigned char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
}

double loadComponent(const unsigned char* bytes, int type, bool normalized) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE: {
            const double x = loadAs<std::int8_t>(bytes);
            return normalized ? std::max(x / 127.0, -1.0) : x;
        }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return loadAs<std::uint8_t>(bytes) / (normalized ? 255.0 : 1.0);
        case TINYGLTF_COMPONENT_TYPE_SHORT: {
            const double x = loadAs<std::int16_t>(bytes);
            return normalized ? std::max(x / 32767.0, -1.0) : x;
        }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return loadAs<std::uint16_t>(bytes) / (normalized ? 65535.0 : 1.0);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return loadAs<std::uint32_t>(bytes);
        default:
            return loadAs<float>(bytes);
    }
}

bool isKnownComponentType(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
           type == TINYGLTF_COMPONENT_TYPE_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT || type == TINYGLTF_COMPONENT_TYPE_FLOAT;
}

/// Reads all numbers of a layout; `name` and `index` say in messages whose they are.
std::vector<double> readNumbers(const GltfModel& gltf, const Layout& layout, int index) {
    const auto fail = [&](const std::string& problem) {
        return gltf.error("accessors", index, problem);
    };
    const std::span<const unsigned char> bytes = viewBytes(gltf, layout.view);
    const std::size_t componentBytes = layout.componentBytes();
    const auto perElement = static_cast<std::size_t>(layout.componentCount);
    const std::size_t elementBytes = componentBytes * perElement;
    const std::size_t stride = layout.stride > 0 ? layout.stride : elementBytes;
    if (stride < elementBytes)
        throw fail(fmt::format("stride {}, must be at least the element's {} bytes", stride,
                               elementBytes));
    // No overflow: count and stride are below 2^32.
    if (layout.count > 0 &&
        (layout.byteOffset > bytes.size() ||
         (layout.count - 1) * stride + elementBytes > bytes.size() - layout.byteOffset))
        throw fail(fmt::format("{} elements from byte {} do not fit into its view of {} bytes",
                               layout.count, layout.byteOffset, bytes.size()));
    std::vector<double> numbers;
    numbers.reserve(layout.count * perElement);
    for (std::size_t i = 0; i < layout.count; ++i)
        for (std::size_t k = 0; k < perElement; ++k) {
            const unsigned char* at =
                bytes.data() + layout.byteOffset + i * stride + k * componentBytes;
            numbers.push_back(loadComponent(at, layout.componentType, layout.normalized));
        }
    return numbers;
}

/// Replaces the elements that a sparse accessor lists.
void applySparse(const GltfModel& gltf, int index, const Layout& base,
                 std::vector<double>& numbers) {
    const tinygltf::Accessor& accessor = gltf.model.accessors[static_cast<std::size_t>(index)];
    const auto fail = [&](const std::string& problem) {
        return gltf.error("accessors", index, "sparse: " + problem);
    };
    const auto& sparse = accessor.sparse;
    if (sparse.count < 0 || static_cast<std::size_t>(sparse.count) > base.count ||
        sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
        throw fail("count or offset out of range");
    Layout where;
    where.view = sparse.indices.bufferView;
    where.byteOffset = static_cast<std::size_t>(sparse.indices.byteOffset);
    where.count = static_cast<std::size_t>(sparse.count);
    where.componentType = sparse.indices.componentType;
    where.componentCount = 1;
    if (!isKnownComponentType(where.componentType)) throw fail("unknown component type");
    Layout what = base;
    what.view = sparse.values.bufferView;
    what.byteOffset = static_cast<std::size_t>(sparse.values.byteOffset);
    what.count = where.count;
    what.stride = 0;
    const std::vector<double> indices = readNumbers(gltf, where, index);
    const std::vector<double> values = readNumbers(gltf, what, index);
    const auto perElement = static_cast<std::size_t>(base.componentCount);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (!(indices[i] >= 0 && indices[i] < static_cast<double>(base.count)))
            throw fail("an index is out of range");
        const auto element = static_cast<std::size_t>(indices[i]);
        for (std::size_t k = 0; k < perElement; ++k)
            numbers[element * perElement + k] = values[i * perElement + k];
    }
}

std::vector<double> readAccessor(const GltfModel& gltf, int index, int componentCount,
                                 std::size_t maxCount) {
    const tinygltf::Accessor& accessor = pick(gltf, gltf.model.accessors, "accessors", index);
    const auto fail = [&](const std::string& problem) {
        return gltf.error("accessors", index, problem);
    };
    if (tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)) !=
        componentCount)
        throw fail(fmt::format("wrong type, must have {} components", componentCount));
    if (!isKnownComponentType(accessor.componentType)) throw fail("unknown component type");
    if (accessor.count > maxCount)
        throw fail(fmt::format("{} elements, at most {} are allowed", accessor.count, maxCount));
    Layout layout;
    layout.view = accessor.bufferView;
    layout.byteOffset = accessor.byteOffset;
    layout.count = accessor.count;
    layout.componentType = accessor.componentType;
    layout.componentCount = componentCount;
    layout.normalized = accessor.normalized;
    std::vector<double> numbers;
    if (accessor.bufferView >= 0) {
        layout.stride =
            pick(gltf, gltf.model.bufferViews, "bufferViews", accessor.bufferView).byteStride;
        if (layout.stride > 0xffffffffu) throw fail("stride out of range");
        numbers = readNumbers(gltf, layout, index);
    } else {
        numbers.assign(accessor.count * static_cast<std::size_t>(componentCount), 0.0);
    }
    if (accessor.sparse.isSparse) applySparse(gltf, index, layout, numbers);
    return numbers;
}

}  // namespace

std::span<const unsigned char> viewBytes(const GltfModel& gltf, int view) {
    const tinygltf::BufferView& source = pick(gltf, gltf.model.bufferViews, "bufferViews", view);
    const tinygltf::Buffer& buffer = pick(gltf, gltf.model.buffers, "buffers", source.buffer);
    if (source.byteOffset > buffer.data.size() ||
        source.byteLength > buffer.data.size() - source.byteOffset)
        throw gltf.error("bufferViews", view,
                         fmt::format("bytes {} to {} of a buffer of {} bytes", source.byteOffset,
                                     source.byteOffset + source.byteLength, buffer.data.size()));
    return std::span(buffer.data).subspan(source.byteOffset, source.byteLength);
}

std::vector<float> readFloats(const GltfModel& gltf, int accessor, int componentCount) {
    const std::vector<double> numbers =
        readAccessor(gltf, accessor, componentCount, kMaxGltfVertices);
    std::vector<float> values;
    values.reserve(numbers.size());
    for (const double number : numbers) {
        if (!(std::abs(number) <= 1e30))
            throw gltf.error("accessors", accessor,
                             fmt::format("element {} is not a finite number up to 1e30",
                                         values.size() / static_cast<std::size_t>(componentCount)));
        values.push_back(static_cast<float>(number));
    }
    return values;
}

std::vector<std::uint32_t> readIndices(const GltfModel& gltf, int accessor) {
    const int type = pick(gltf, gltf.model.accessors, "accessors", accessor).componentType;
    if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        throw gltf.error("accessors", accessor, "indices must be unsigned integers");
    const std::vector<double> numbers = readAccessor(gltf, accessor, 1, kMaxGltfIndices);
    std::vector<std::uint32_t> indices;
    indices.reserve(numbers.size());
    for (const double number : numbers) indices.push_back(static_cast<std::uint32_t>(number));
    return indices;
}

}  // namespace brume::scene
