// SPDX-License-Identifier: Apache-2.0
#include <scene/gltf_loader.hpp>
#include <scene/gltf_model.hpp>
#include <scene/json_document.hpp>
#include <scene/mesh_shapes.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <optional>

namespace brume::scene {

namespace {

/// Node transform; each part that is given must have the right size.
dmat4 nodeMatrix(const GltfModel& gltf, int index) {
    const tinygltf::Node& node = gltf.model.nodes[static_cast<std::size_t>(index)];
    const auto hasSize = [&](const std::vector<double>& values, std::size_t size) {
        if (!values.empty() && values.size() != size)
            throw gltf.error(
                "nodes", index,
                fmt::format("a transform of {} numbers, must be {}", values.size(), size));
        return !values.empty();
    };
    dmat4 matrix(1);
    if (hasSize(node.matrix, 16)) {
        for (int i = 0; i < 16; ++i)
            matrix[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
        matrix[0][3] = matrix[1][3] = matrix[2][3] = 0;  // must be affine
        matrix[3][3] = 1;
        return matrix;
    }
    if (hasSize(node.translation, 3))
        matrix = glm::translate(
            matrix, dvec3(node.translation[0], node.translation[1], node.translation[2]));
    if (hasSize(node.rotation, 4)) {
        const glm::dquat q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
        if (!(glm::length(q) > 1e-9)) throw gltf.error("nodes", index, "rotation is zero");
        matrix *= glm::mat4_cast(glm::normalize(q));
    }
    if (hasSize(node.scale, 3))
        matrix = glm::scale(matrix, dvec3(node.scale[0], node.scale[1], node.scale[2]));
    return matrix;
}

bool isFinite(const dmat4& matrix) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!(std::abs(matrix[column][row]) <= 1e30)) return false;
    return true;
}

/// Triangles of a primitive as a list, whatever its mode; degenerate ones left out.
std::vector<std::uint32_t> listTriangles(const std::vector<std::uint32_t>& order, int mode) {
    std::vector<std::uint32_t> result;
    const std::size_t step = mode == TINYGLTF_MODE_TRIANGLES ? 3 : 1;
    for (std::size_t i = 0; i + 2 < order.size(); i += step) {
        std::array<std::uint32_t, 3> t{order[i], order[i + 1], order[i + 2]};
        if (mode == TINYGLTF_MODE_TRIANGLE_STRIP && i % 2 == 1) std::swap(t[1], t[2]);
        if (mode == TINYGLTF_MODE_TRIANGLE_FAN) t = {order[i + 1], order[i + 2], order[0]};
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
            result.insert(result.end(), t.begin(), t.end());
    }
    return result;
}

/// Gives each triangle its own vertices.
template <typename T>
void unshare(std::vector<T>& values, const std::vector<std::uint32_t>& indices) {
    std::vector<T> result;
    result.reserve(indices.size());
    for (const std::uint32_t index : indices) result.push_back(values[index]);
    values = std::move(result);
}

dvec3 areaNormal(const Mesh& mesh, std::size_t triangle) {
    const dvec3 a(mesh.positions[mesh.indices[triangle]]);
    const dvec3 b(mesh.positions[mesh.indices[triangle + 1]]);
    const dvec3 c(mesh.positions[mesh.indices[triangle + 2]]);
    return glm::cross(b - a, c - a);
}

vec3 unitOr(const dvec3& v, const vec3& fallback) {
    const double length = glm::length(v);
    return length > 0 && std::isfinite(length) ? vec3(v / length) : fallback;
}

/// glTF 2.0, 3.7.2.1: without normals the triangles are flat.
void makeFlat(Mesh& mesh) {
    unshare(mesh.positions, mesh.indices);
    unshare(mesh.uvs, mesh.indices);
    for (std::size_t i = 0; i < mesh.indices.size(); ++i)
        mesh.indices[i] = static_cast<std::uint32_t>(i);
    mesh.normals.clear();
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        mesh.normals.insert(mesh.normals.end(), 3, unitOr(areaNormal(mesh, i), vec3(0, 1, 0)));
}

/// Makes normals unit; those of no length become the mean of the triangles around.
void normaliseNormals(Mesh& mesh) {
    std::vector<dvec3> sums;
    for (std::size_t v = 0; v < mesh.normals.size(); ++v) {
        if (glm::length(dvec3(mesh.normals[v])) > 1e-6) {
            mesh.normals[v] = vec3(glm::normalize(dvec3(mesh.normals[v])));
            continue;
        }
        if (sums.empty()) {
            sums.assign(mesh.positions.size(), dvec3(0));
            for (std::size_t i = 0; i < mesh.indices.size(); ++i)
                sums[mesh.indices[i]] += areaNormal(mesh, i - i % 3);
        }
        mesh.normals[v] = unitOr(sums[v], vec3(0, 1, 0));
    }
}

/// Turns the model into meshes and materials.
class GltfConverter {
  public:
    explicit GltfConverter(const GltfModel& gltf) : mGltf(gltf), mMaterialReader(gltf) {}

    GltfContent convert() {
        for (int i = 0; i < static_cast<int>(mGltf.model.materials.size()); ++i) {
            GltfMaterial material = mMaterialReader.read(i);
            mContent.materials.push_back(std::move(material.material));
            mUvSources.push_back(material.uv);
        }
        mPrimitives.resize(mGltf.model.meshes.size());
        visitNodes();
        return std::move(mContent);
    }

  private:
    struct Visit {
        int node;
        dmat4 worldFromParent;
    };

    std::vector<int> rootNodes() const {
        const tinygltf::Model& model = mGltf.model;
        if (!model.scenes.empty())
            return pick(mGltf, model.scenes, "scenes", std::max(model.defaultScene, 0)).nodes;
        std::vector<bool> isChild(model.nodes.size());
        for (const tinygltf::Node& node : model.nodes)
            for (int child : node.children)
                if (child >= 0 && static_cast<std::size_t>(child) < isChild.size())
                    isChild[static_cast<std::size_t>(child)] = true;
        std::vector<int> roots;
        for (std::size_t i = 0; i < isChild.size(); ++i)
            if (!isChild[i]) roots.push_back(static_cast<int>(i));
        return roots;
    }

    void visitNodes() {
        std::vector<bool> isVisited(mGltf.model.nodes.size());
        std::vector<Visit> stack;
        const auto push = [&stack](const std::vector<int>& nodes, const dmat4& matrix) {
            for (auto it = nodes.rbegin(); it != nodes.rend(); ++it) stack.push_back({*it, matrix});
        };
        push(rootNodes(), dmat4(1));
        while (!stack.empty()) {
            const Visit visit = stack.back();
            stack.pop_back();
            const tinygltf::Node& node = pick(mGltf, mGltf.model.nodes, "nodes", visit.node);
            if (isVisited[static_cast<std::size_t>(visit.node)])
                throw mGltf.error("nodes", visit.node, "reached twice, nodes must form a tree");
            isVisited[static_cast<std::size_t>(visit.node)] = true;
            const dmat4 matrix = visit.worldFromParent * nodeMatrix(mGltf, visit.node);
            if (!isFinite(matrix))
                throw mGltf.error("nodes", visit.node, "its transform is not finite");
            if (node.mesh >= 0) placeNode(node, matrix);
            push(node.children, matrix);
        }
    }

    void placeNode(const tinygltf::Node& node, const dmat4& matrix) {
        pick(mGltf, mGltf.model.meshes, "meshes", node.mesh);
        // What a node squashes to nothing has no inside, no outside and no area.
        const double determinant = glm::determinant(dmat3(matrix));
        if (!(std::abs(determinant) > 1e-30)) {
            mGltf.ignored.insert("nodes of scale zero");
            return;
        }
        std::optional<std::vector<Mesh>>& primitives =
            mPrimitives[static_cast<std::size_t>(node.mesh)];
        if (!primitives) primitives = readMesh(node.mesh);
        for (Mesh mesh : *primitives) {
            mVertexCount += mesh.positions.size();
            mIndexCount += mesh.indices.size();
            if (mVertexCount > kMaxGltfVertices || mIndexCount > kMaxGltfIndices)
                throw mGltf.error(fmt::format("more than {} vertices or {} indices",
                                              kMaxGltfVertices, kMaxGltfIndices));
            if (!node.name.empty()) mesh.name = mGltf.name + ": " + quoteForMessage(node.name, 100);
            placeMesh(mesh, matrix);
            mContent.meshes.push_back(std::move(mesh));
        }
    }

    std::vector<Mesh> readMesh(int index) {
        const tinygltf::Mesh& source = mGltf.model.meshes[static_cast<std::size_t>(index)];
        std::vector<Mesh> primitives;
        for (const tinygltf::Primitive& primitive : source.primitives) {
            if (!primitive.targets.empty()) mGltf.ignored.insert("morph targets");
            if (primitive.mode != TINYGLTF_MODE_TRIANGLES &&
                primitive.mode != TINYGLTF_MODE_TRIANGLE_STRIP &&
                primitive.mode != TINYGLTF_MODE_TRIANGLE_FAN) {
                mGltf.ignored.insert("points and lines");
                continue;
            }
            Mesh mesh = readPrimitive(primitive, index);
            mesh.name = mGltf.name + ": " + quoteForMessage(source.name, 100);
            if (!mesh.indices.empty()) primitives.push_back(std::move(mesh));
        }
        return primitives;
    }

    Mesh readPrimitive(const tinygltf::Primitive& primitive, int meshIndex) {
        const auto attribute = [&primitive](const std::string& name) {
            const auto it = primitive.attributes.find(name);
            return it == primitive.attributes.end() ? -1 : it->second;
        };
        Mesh mesh;
        if (attribute("POSITION") < 0)
            throw mGltf.error("meshes", meshIndex, "a primitive without POSITION");
        mesh.positions = readVec3s(attribute("POSITION"));
        mesh.material = materialIndex(primitive.material);
        const UvSource uv = primitive.material < 0 ? UvSource() : mUvSources[mesh.material];
        mesh.uvs = readUvs(attribute("TEXCOORD_" + std::to_string(uv.set)), uv,
                           mesh.positions.size(), meshIndex);
        mesh.indices = readTriangles(primitive, mesh.positions.size(), meshIndex);
        if (attribute("COLOR_0") >= 0) mGltf.ignored.insert("vertex colours");
        if (attribute("NORMAL") < 0) {
            makeFlat(mesh);
            return mesh;
        }
        mesh.normals = readVec3s(attribute("NORMAL"));
        if (mesh.normals.size() != mesh.positions.size())
            throw mGltf.error("meshes", meshIndex, "NORMAL and POSITION differ in their count");
        normaliseNormals(mesh);
        return mesh;
    }

    std::vector<vec3> readVec3s(int accessor) const {
        const std::vector<float> values = readFloats(mGltf, accessor, 3);
        std::vector<vec3> result;
        result.reserve(values.size() / 3);
        for (std::size_t i = 0; i < values.size(); i += 3)
            result.emplace_back(values[i], values[i + 1], values[i + 2]);
        return result;
    }

    std::vector<vec2> readUvs(int accessor, const UvSource& uv, std::size_t vertexCount,
                              int meshIndex) const {
        if (accessor < 0) return std::vector<vec2>(vertexCount, vec2(0));
        const std::vector<float> values = readFloats(mGltf, accessor, 2);
        if (values.size() != 2 * vertexCount)
            throw mGltf.error("meshes", meshIndex, "TEXCOORD and POSITION differ in their count");
        std::vector<vec2> result;
        result.reserve(vertexCount);
        for (std::size_t i = 0; i < values.size(); i += 2)
            result.push_back(uv.apply(vec2(values[i], values[i + 1])));
        return result;
    }

    std::vector<std::uint32_t> readTriangles(const tinygltf::Primitive& primitive,
                                             std::size_t vertexCount, int meshIndex) const {
        std::vector<std::uint32_t> order;
        if (primitive.indices >= 0) {
            order = readIndices(mGltf, primitive.indices);
        } else {
            order.resize(vertexCount);
            for (std::size_t i = 0; i < vertexCount; ++i) order[i] = static_cast<std::uint32_t>(i);
        }
        for (const std::uint32_t index : order)
            if (index >= vertexCount)
                throw mGltf.error(
                    "meshes", meshIndex,
                    fmt::format("vertex index {}, there are {} vertices", index, vertexCount));
        return listTriangles(order, primitive.mode);
    }

    /// Primitives without a material get glTF's default one, appended when first needed.
    std::uint32_t materialIndex(int index) {
        if (index >= 0) {
            pick(mGltf, mGltf.model.materials, "materials", index);
            return static_cast<std::uint32_t>(index);
        }
        if (mContent.materials.size() == mGltf.model.materials.size()) {
            Material material;
            material.name = "default";
            material.albedo = dvec3(1);
            material.roughness = 1;
            mContent.materials.push_back(std::move(material));
        }
        return static_cast<std::uint32_t>(mGltf.model.materials.size());
    }

    const GltfModel& mGltf;
    GltfMaterialReader mMaterialReader;
    GltfContent mContent;
    std::vector<UvSource> mUvSources;
    std::vector<std::optional<std::vector<Mesh>>> mPrimitives;  ///< per mesh, once a node shows it
    std::size_t mVertexCount = 0;
    std::size_t mIndexCount = 0;
};

}  // namespace

GltfContent parseGltf(const std::vector<unsigned char>& bytes, const std::filesystem::path& file,
                      const Log& log) {
    const GltfModel gltf = parseGltfModel(bytes, file);
    GltfContent content = GltfConverter(gltf).convert();
    if (!gltf.ignored.empty())
        log.warning(fmt::format("{}: ignored: {}", gltf.name, fmt::join(gltf.ignored, ", ")));
    return content;
}

GltfContent loadGltf(const std::filesystem::path& file, const Log& log) {
    return parseGltf(readGltfBytes(file), file, log);
}

}  // namespace brume::scene
