// SPDX-License-Identifier: Apache-2.0
// The scene as plain structs: what the files of docs/formats.md say, with every default filled in
// and every path made absolute. No Vulkan, no rendering. Lengths in metres, angles in radians,
// extinction in 1/m, linear radiance.
#pragma once

#include <core/math.hpp>
#include <scene/effect.hpp>
#include <scene/settings.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace brume::scene {

enum class CameraType { Perspective, Orthographic };

struct Camera {
    CameraType type = CameraType::Perspective;
    dvec3 position{0, 0, 5};
    dvec3 target{0};
    dvec3 up{0, 1, 0};
    double verticalFov = radians(40);  ///< perspective: full angle, (0, pi)
    double height = 1;                 ///< orthographic: world height of the image
    double near =
        0.01;  ///< surfaces nearer than this view depth are not seen; media start at the camera

    bool operator==(const Camera&) const = default;
};

struct ImageSettings {
    int width = 960;
    int height = 540;
    int supersample = 1;  ///< n: each pixel is the mean of n x n samples at sub-pixel centres
};

/// Linear RGBA texels from the top left; wraps around in both directions; bilinear between texel
/// centres.
struct Texture {
    std::string name;
    int width = 0;
    int height = 0;
    std::vector<vec4> texels;  ///< colour linear, alpha as stored
};

struct Background {
    dvec3 radiance{0};
    /// Latitude-longitude map, +Y up: u = atan2(x, -z) / 2pi + 1/2, v = acos(y) / pi. Null:
    /// constant `radiance`.
    std::shared_ptr<const Texture> environment;
    double scale = 1;  ///< of the environment
};

enum class LightType { Ambient, Directional, Point, Spot };

/// `color` is radiance (ambient), irradiance (directional) or intensity (point, spot).
/// Point and spot: E = I / max(d^2, radius^2). Spot: times s^2, s = clamp((cos - cosOuter) /
/// (cosInner - cosOuter), 0, 1).
struct Light {
    LightType type = LightType::Ambient;
    dvec3 color{0};
    dvec3 position{0};
    dvec3 direction{0, -1, 0};        ///< in which the light travels, unit length
    double innerAngle = radians(20);  ///< from the axis
    double outerAngle = radians(30);
    double radius = 0.01;
    std::string shadow = "none";  ///< name of a shadow store, or "none"
    Settings shadowSettings;      ///< of the store and its map
};

enum class MaterialType { Opaque, Thin, Solid };

struct Material {
    std::string name;
    MaterialType type = MaterialType::Opaque;
    // Opaque; emission also of thin surfaces.
    dvec3 albedo{0.5};
    dvec3 emission{0};
    // Thin.
    double coverage = 1;
    dvec3 transmission{0};
    dvec3 reflected{
        0};  ///< Lambert albedo of the light that a thin surface sends back on both sides
    double collimation = 1;
    // Thin and solid.
    double ior = 1.5;
    /// >= 0: mirrors the background by Fresnel's equations and shows highlights of that roughness
    /// (GGX, squared); what it mirrors is not let through. < 0: matt.
    double roughness = -1;
    // Solid: homogeneous medium inside a closed mesh.
    dvec3 absorption{0};
    dvec3 scattering{0};
    // Textures multiply: colour -> albedo (opaque), reflected and transmission (thin); its alpha ->
    // coverage (thin).
    std::shared_ptr<const Texture> colorTexture;
    std::shared_ptr<const Texture> emissionTexture;
    double alphaCutoff =
        -1;  ///< >= 0: fragments whose coverage * texture alpha is below do not exist (glTF MASK)
};

enum class PhaseType { Isotropic, Rayleigh, HenyeyGreenstein };

/// Optical properties per unit density. Scattering = extinction * albedo.
struct Medium {
    std::string name;
    dvec3 extinction{1};
    dvec3 albedo{0};
    dvec3 emission{0};  ///< radiance per metre
    PhaseType phase = PhaseType::Isotropic;
    double g = 0;  ///< Henyey-Greenstein mean cosine, |g| <= 0.999
};

/// Triangles with one material. Winding: counter-clockwise seen from outside in the world, so that
/// a mirroring worldFromObject needs nothing more; normals point outside in object space (world:
/// inverse transpose). Every surface is seen from both sides.
struct Mesh {
    std::string name;
    std::vector<vec3> positions;  ///< object space
    std::vector<vec3> normals;    ///< unit, one per position
    std::vector<vec2> uvs;  ///< one per position (zero where the file has none); v grows downwards
    std::vector<std::uint32_t> indices;  ///< three per triangle
    std::uint32_t material = 0;          ///< index into Scene::materials
    dmat4 worldFromObject{1};
};

enum class VolumeRepresentation { Bricks, Boxes, Particles };

struct Volume {
    std::filesystem::path file;  ///< may be a sequence: its name holds #### or %04d
    int frameOffset = 0;         ///< sequences: number of the file that frame 0 shows
    std::string density = "density";  ///< name of the grid
    int gridIndex =
        -1;  ///< among the grids of that name; -1: the only one (several: an error that lists them)
    std::uint32_t medium = 0;
    VolumeRepresentation representation = VolumeRepresentation::Bricks;
    double tolerance = 0.03;  ///< boxes: largest (max - min) * extinction * size of a box
    dmat4 worldFromFile{1};   ///< applied after the grid's own transform
};

enum class Profile { Constant, Smooth };  ///< Smooth: density * (1 - r^2/R^2)^2

struct Sphere {
    dvec3 center{0};
    double radius = 1;
    std::uint32_t medium = 0;
    double density = 1;
    Profile profile = Profile::Constant;
    Shadowing shadowing = Shadowing::Sample;
};

/// An effect of the scene, or a sub-emitter of the instance before it: those follow their root in
/// the order of particles::compileEffect(), with its transform, seed and times.
struct EffectInstance {
    std::filesystem::path file;
    Effect effect;  ///< its medium name resolved to `medium`
    std::uint32_t medium = 0;
    std::uint32_t material = 0;  ///< of an effect with a surface
    bool isPrepared = false;     ///< that material shows the effect's look over life
    dmat4 worldFromEffect{1};
    Path path;  ///< along which it moves, in its own seconds
    std::uint64_t seed = 0;
    double time = 0;       ///< of the frame, s
    double start = 0;      ///< the effect begins at that time, s
    double timeScale = 1;  ///< >= 0; 0: paused at its beginning
    double loop = 0;       ///< > 0: it begins anew after as many of its own seconds
    double prewarm = 0;    ///< own seconds that it is older than it would be
    bool isSubEmitter = false;
    std::uint64_t key = 0;  ///< of a host: who it is and which revision of its effect; 0: nobody asks

    /// What the simulation has run for, own seconds.
    double simulatedSeconds() const {
        if (time < start) return 0;
        const double own = (time - start) * timeScale;
        return prewarm + (loop > 0 ? std::fmod(own, loop) : own);
    }
    Placement placement() const { return {worldFromEffect, path}; }
    /// Where it is at the time of the frame.
    dmat4 placed() const { return placement().at(simulatedSeconds()); }
};

struct RenderSettings {
    std::string method = "tile";
    Settings settings;
};

struct Scene {
    std::filesystem::path file;  ///< absolute; empty if made by code
    Camera camera;
    ImageSettings image;
    Background background;
    std::vector<Light> lights;
    std::vector<Material> materials;
    std::vector<Medium> media;
    std::vector<Mesh> meshes;
    std::vector<Volume> volumes;
    std::vector<Sphere> spheres;
    std::vector<EffectInstance> effects;
    std::uint64_t particleBudget = 0;  ///< capacity of all effects together; 0: no limit
    RenderSettings render;
};

}  // namespace brume::scene
