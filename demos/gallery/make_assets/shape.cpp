// SPDX-License-Identifier: Apache-2.0
#include "shape.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>
#include <fstream>
#include <numbers>
#include <stdexcept>

namespace brume::gallery {
namespace {

constexpr float kTurn = 2 * std::numbers::pi_v<float>;

/// The outline with four points between each two, by Catmull and Rom, sharp at its corners.
Outline refine(const Outline& outline) {
    Outline fine;
    const int last = static_cast<int>(outline.size()) - 1;
    for (int i = 0; i < last; ++i) {
        const auto at = [&](int k) { return outline[static_cast<std::size_t>(k)]; };
        const vec2 p1 = at(i), p2 = at(i + 1);
        if (p1 == p2) {
            fine.push_back(p1);
            continue;
        }
        const vec2 p0 = i > 0 && at(i - 1) != p1 ? at(i - 1) : p1 - (p2 - p1);
        const vec2 p3 = i + 1 < last && at(i + 2) != p2 ? at(i + 2) : p2 + (p2 - p1);
        for (int k = 0; k < 5; ++k) {
            const float t = static_cast<float>(k) / 5;
            vec2 p = 0.5f * (2.0f * p1 + (p2 - p0) * t +
                             (2.0f * p0 - 5.0f * p1 + 4.0f * p2 - p3) * (t * t) +
                             (3.0f * p1 - p0 - 3.0f * p2 + p3) * (t * t * t));
            p.x = std::max(p.x, 0.0f);
            fine.push_back(p);
        }
    }
    fine.push_back(outline.back());
    return fine;
}

/// Outward normals at both ends of a stretch of the outline: those of neighbours that go on
/// without a corner are averaged in.
void findNormals(const Outline& line, std::size_t i, vec2& atStart, vec2& atEnd) {
    const auto normal = [&](std::size_t k) {
        const vec2 d = line[k + 1] - line[k];
        return glm::length(d) > 0 ? glm::normalize(vec2(d.y, -d.x)) : vec2(0);
    };
    const auto joined = [](vec2 own, vec2 other) {
        return glm::dot(own, other) > 0.75f ? glm::normalize(own + other) : own;
    };
    const vec2 own = normal(i);
    atStart = i > 0 ? joined(own, normal(i - 1)) : own;
    atEnd = i + 2 < line.size() ? joined(own, normal(i + 1)) : own;
}

nlohmann::json makeMaterial(const Paint& paint) {
    nlohmann::json material = {
        {"name", paint.name},
        {"doubleSided", true},
        {"pbrMetallicRoughness",
         {{"baseColorFactor", {paint.color.r, paint.color.g, paint.color.b, 1}},
          {"metallicFactor", 0}}}};
    const float brightest = std::max({paint.emission.r, paint.emission.g, paint.emission.b});
    if (brightest > 0) {
        const vec3 hue = paint.emission / brightest;
        material["emissiveFactor"] = {hue.r, hue.g, hue.b};
        material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = brightest;
    }
    if (paint.transmission > 0)
        material["extensions"]["KHR_materials_transmission"]["transmissionFactor"] =
            paint.transmission;
    return material;
}

/// Appends an array to the buffer and returns the number of its accessor.
template <class T>
std::size_t addAccessor(nlohmann::json& gltf, std::string& bytes, const std::vector<T>& values,
                        const char* type, int componentType) {
    const std::size_t size = values.size() * sizeof(T);
    gltf["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}});
    bytes.append(reinterpret_cast<const char*>(values.data()), size);
    nlohmann::json accessor = {{"bufferView", gltf["bufferViews"].size() - 1},
                               {"componentType", componentType},
                               {"count", values.size()},
                               {"type", type}};
    if constexpr (std::is_same_v<T, vec3>) {
        vec3 lo(values.front()), hi(lo);
        for (const vec3& v : values) lo = glm::min(lo, v), hi = glm::max(hi, v);
        accessor["min"] = {lo.x, lo.y, lo.z};
        accessor["max"] = {hi.x, hi.y, hi.z};
    }
    gltf["accessors"].push_back(accessor);
    return gltf["accessors"].size() - 1;
}

void appendWord(std::string& out, std::size_t value) {
    const auto word = static_cast<std::uint32_t>(value);
    char bytes[4];
    std::memcpy(bytes, &word, 4);
    out.append(bytes, 4);
}

}  // namespace

void Shape::add(const Shape& other) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), other.positions.begin(), other.positions.end());
    normals.insert(normals.end(), other.normals.begin(), other.normals.end());
    for (const std::uint32_t i : other.indices) indices.push_back(first + i);
}

void Shape::addTriangle(vec3 a, vec3 b, vec3 c) {
    const vec3 normal = glm::normalize(glm::cross(b - a, c - a));
    for (const vec3& p : {a, b, c}) {
        indices.push_back(static_cast<std::uint32_t>(positions.size()));
        positions.push_back(p);
        normals.push_back(normal);
    }
}

void Shape::addQuad(vec3 a, vec3 b, vec3 c, vec3 d) {
    addTriangle(a, b, c);
    addTriangle(a, c, d);
}

Shape Shape::moved(vec3 by) const {
    Shape shape = *this;
    for (vec3& p : shape.positions) p += by;
    return shape;
}

Shape Shape::turned(float degreesAboutY) const {
    Shape shape = *this;
    const float angle = degreesAboutY * kTurn / 360, c = std::cos(angle), s = std::sin(angle);
    const auto turn = [&](vec3& v) { v = {c * v.x + s * v.z, v.y, c * v.z - s * v.x}; };
    for (vec3& p : shape.positions) turn(p);
    for (vec3& n : shape.normals) turn(n);
    return shape;
}

Shape makeBox(vec3 center, vec3 size) {
    Shape box;
    const vec3 h = size * 0.5f;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            vec3 n(0), u(0), v(0);
            n[axis] = side * h[axis];
            u[(axis + 1) % 3] = h[(axis + 1) % 3];
            v[(axis + 2) % 3] = side * h[(axis + 2) % 3];
            const vec3 c = center + n;
            box.addQuad(c - u - v, c + u - v, c + u + v, c - u + v);
        }
    return box;
}

Shape revolve(const Outline& outline, int segments) {
    Shape shape;
    const Outline line = refine(outline);
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        if (glm::distance(line[i], line[i + 1]) < 1e-6f) continue;
        vec2 n0, n1;
        findNormals(line, i, n0, n1);
        const auto first = static_cast<std::uint32_t>(shape.positions.size());
        for (int k = 0; k <= segments; ++k) {
            // The last column repeats the first, to the bit.
            const float a = kTurn * static_cast<float>(k % segments) / static_cast<float>(segments);
            const vec3 out(std::cos(a), 0, std::sin(a));
            for (const auto& [p, n] : {std::pair(line[i], n0), std::pair(line[i + 1], n1)}) {
                shape.positions.push_back(out * p.x + vec3(0, p.y, 0));
                shape.normals.push_back(out * n.x + vec3(0, n.y, 0));
            }
        }
        for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(segments); ++k) {
            const std::uint32_t a = first + 2 * k;
            if (line[i].x > 0)
                for (const std::uint32_t j : {a, a + 1, a + 2}) shape.indices.push_back(j);
            if (line[i + 1].x > 0)
                for (const std::uint32_t j : {a + 1, a + 3, a + 2}) shape.indices.push_back(j);
        }
    }
    return shape;
}

Shape makeSurface(int columns, int rows, const std::function<vec3(float u, float v)>& place) {
    Shape shape;
    const float du = 1.0f / static_cast<float>(columns), dv = 1.0f / static_cast<float>(rows);
    for (int y = 0; y <= rows; ++y)
        for (int x = 0; x <= columns; ++x) {
            const float u = du * static_cast<float>(x), v = dv * static_cast<float>(y);
            const float e = 0.5f;
            const vec3 along = place(u + e * du, v) - place(u - e * du, v);
            const vec3 up = place(u, v + e * dv) - place(u, v - e * dv);
            const vec3 normal = glm::cross(along, up);
            const float length = glm::length(normal);
            shape.positions.push_back(place(u, v));
            shape.normals.push_back(length > 0 ? normal / length : vec3(0, 1, 0));
        }
    const auto at = [&](int x, int y) { return static_cast<std::uint32_t>(y * (columns + 1) + x); };
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x)
            for (const std::uint32_t i : {at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y),
                                          at(x + 1, y + 1), at(x, y + 1)})
                shape.indices.push_back(i);
    return shape;
}

Shape makeBall(int segments, const std::function<vec3(vec3 direction)>& place) {
    return makeSurface(segments, segments / 2, [&](float u, float v) {
        // Sines that are exactly equal at both ends close the surface.
        const float a = kTurn * (u - std::floor(u)), b = kTurn / 2 * (1 - v);
        const float ring = v <= 0 || v >= 1 ? 0.0f : std::sin(b);
        return place({ring * std::cos(a), std::cos(b), -ring * std::sin(a)});
    });
}

void writeGlb(const std::filesystem::path& file, const std::vector<Part>& parts) {
    nlohmann::json gltf = {
        {"asset", {{"version", "2.0"}, {"generator", "brume_gallery_assets"}}},
        {"scene", 0},
        {"scenes", {{{"nodes", {0}}}}},
        {"nodes", {{{"mesh", 0}}}},
        {"extensionsUsed", {"KHR_materials_transmission", "KHR_materials_emissive_strength"}}};
    std::string bytes;
    for (const Part& part : parts) {
        const std::size_t positions = addAccessor(gltf, bytes, part.shape.positions, "VEC3", 5126);
        const std::size_t normals = addAccessor(gltf, bytes, part.shape.normals, "VEC3", 5126);
        const std::size_t indices = addAccessor(gltf, bytes, part.shape.indices, "SCALAR", 5125);
        gltf["meshes"][0]["primitives"].push_back(
            {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
             {"indices", indices},
             {"material", gltf["materials"].size()}});
        gltf["materials"].push_back(makeMaterial(part.paint));
    }
    gltf["buffers"] = {{{"byteLength", bytes.size()}}};
    std::string text = gltf.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');

    std::string out = "glTF";
    appendWord(out, 2);
    appendWord(out, 12 + 8 + text.size() + 8 + bytes.size());
    appendWord(out, text.size());
    out += "JSON" + text;
    appendWord(out, bytes.size());
    out += std::string("BIN\0", 4) + bytes;
    std::ofstream stream(file, std::ios::binary);
    if (!stream.write(out.data(), static_cast<std::streamsize>(out.size())))
        throw std::runtime_error("writing " + file.string() + ": the file cannot be written");
}

}  // namespace brume::gallery
