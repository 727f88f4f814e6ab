/* SPDX-License-Identifier: Apache-2.0
 *
 * Brume for hosts: smoke, particles and glass recorded into the Vulkan frame of another renderer.
 *
 * The host owns the instance, the device, the queues, the command buffers and the pace of frames.
 * Brume owns pipelines and memory, and records; it never creates a queue, submits, waits or
 * presents. The host submits what Brume recorded to one queue, in the order of the calls.
 *
 * Threads: all calls with one context, and with the scenes of it, are the caller's to serialise.
 * Contexts are independent of each other. brumeLastError() belongs to the calling thread.
 *
 * Errors: every function that can fail returns a BrumeResult and, but for BRUME_SUCCESS, leaves one
 * line of text for brumeLastError(). Nothing is thrown across this border and nothing aborts. After
 * an error of a brumeCmd function the command buffer is to be discarded; everything else stays
 * usable, and the call may be made again.
 *
 * Structures begin with their size, so that programs built against an older header go on working:
 * start them with BRUME_INIT(Type), which sets the size and all other members to zero, which means
 * the default.
 *
 * Space: metres, seconds, radiance; right-handed or left-handed world as the host's matrices have
 * it. Matrices are double[16], column after column; a matrix b_from_a turns coordinates of a into
 * those of b.
 */
#ifndef BRUME_BRUME_H
#define BRUME_BRUME_H

#include <stdint.h>
#include <vulkan/vulkan_core.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Version of this header: major * 1000000 + minor * 1000 + patch. */
#define BRUME_HEADER_VERSION 1000u

#if defined(BRUME_BUILDS_LIBRARY)
#define BRUME_API __attribute__((visibility("default")))
#else
#define BRUME_API
#endif

/** Starts a structure: its size, and zero for everything else. */
#ifdef __cplusplus
#define BRUME_INIT(Type)             \
    ([] {                            \
        Type type{};                 \
        type.structSize = sizeof(Type); \
        return type;                 \
    }())
#else
#define BRUME_INIT(Type) ((Type){.structSize = sizeof(Type)})
#endif

/** Everything that one device has of Brume. */
typedef struct BrumeContext_T* BrumeContext;
/** Things to show, the way of showing them, and the memory for one view of them. */
typedef struct BrumeScene_T* BrumeScene;
/** Something in a scene; 0 is nothing. Ids are not used twice. */
typedef uint64_t BrumeId;

/** How a call ended. */
typedef enum BrumeResult {
    BRUME_SUCCESS = 0,
    BRUME_ERROR_INVALID_ARGUMENT = 1, /**< a bad argument, file or setting: see brumeLastError() */
    BRUME_ERROR_OUT_OF_HOST_MEMORY = 2,
    BRUME_ERROR_OUT_OF_DEVICE_MEMORY = 3, /**< or beyond the budget that the host has set */
    BRUME_ERROR_DEVICE_LOST = 4,
    BRUME_ERROR_FAILED = 5, /**< another failure of device or files */
    BRUME_ERROR_INTERNAL = 6, /**< a mistake of Brume's: please report it */
    BRUME_RESULT_MAX_ENUM = 0x7fffffff
} BrumeResult;

/** How much a message matters. */
typedef enum BrumeLogLevel {
    BRUME_LOG_DEBUG = 0,
    BRUME_LOG_INFO = 1,
    BRUME_LOG_WARNING = 2,
    BRUME_LOG_ERROR = 3,
    BRUME_LOG_MAX_ENUM = 0x7fffffff
} BrumeLogLevel;

/** Optional features and extensions that the host has enabled; a set of bits. */
typedef enum BrumeFeatureBits {
    BRUME_FEATURE_SHADER_FLOAT64 = 1,         /**< shaderFloat64: finer distances */
    BRUME_FEATURE_SHADER_INT64_ATOMICS = 2,   /**< shaderBufferInt64Atomics: method k_buffer */
    BRUME_FEATURE_FLOAT32_ATOMIC_ADD = 4,     /**< VK_EXT_shader_atomic_float, on buffers */
    BRUME_FEATURE_GEOMETRY_SHADER = 8,        /**< geometryShader */
    BRUME_FEATURE_DRAW_PARAMETERS = 16,       /**< shaderDrawParameters */
    BRUME_FEATURE_DEPTH_CLAMP = 32,           /**< depthClamp */
    BRUME_FEATURE_DEBUG_UTILS = 64,           /**< VK_EXT_debug_utils: names and labels */
    BRUME_FEATURE_MAX_ENUM = 0x7fffffff
} BrumeFeatureBits;

/** An image in linear RGBA, row after row from the top left; made by a reader, freed by `release`. */
typedef struct BrumePixels {
    uint32_t structSize; /**< set by BRUME_INIT */
    uint32_t width; /**< pixels */
    uint32_t height; /**< pixels */
    const float* rgba; /**< 4 * width * height; alpha is not multiplied into the colour */
    void* owner; /**< passed to `release` */
    void (*release)(void* owner); /**< may be null */
} BrumePixels;

/** Part of a density field where all values are the same; index coordinates. */
typedef struct BrumeTile {
    double lo[3]; /**< first voxel */
    double hi[3]; /**< last voxel, inclusive */
    float value; /**< density */
} BrumeTile;

/** A sparse density field. Voxel values sit at integer indices, trilinear between; 0 outside. */
typedef struct BrumeDensity {
    uint32_t structSize; /**< set by BRUME_INIT */
    uint32_t brickCount; /**< of `origins` and `values` */
    uint32_t tileCount; /**< of `tiles` */
    double worldFromIndex[16]; /**< affine, can be inverted */
    const int32_t* origins; /**< 3 per brick, multiples of 8, each brick only once */
    const float* values;    /**< 9 * 9 * 9 per brick, x fastest: the corners of its 8^3 cells */
    const BrumeTile* tiles; /**< may be null if there are none */
    void* owner; /**< passed to `release` */
    void (*release)(void* owner); /**< may be null; called once Brume has a copy */
} BrumeDensity;

/** What a context lives on. Handles must outlive it. */
typedef struct BrumeContextCreateInfo {
    uint32_t structSize; /**< set by BRUME_INIT */
    uint32_t headerVersion; /**< BRUME_HEADER_VERSION */
    VkInstance instance; /**< the host's */
    VkPhysicalDevice physicalDevice; /**< the one of `device` */
    /** Vulkan 1.3 with dynamicRendering, synchronization2, maintenance4, bufferDeviceAddress,
     *  scalarBlockLayout, timelineSemaphore, shaderInt64, independentBlend,
     *  fragmentStoresAndAtomics, shaderStorageImageExtendedFormats and VK_KHR_push_descriptor. */
    VkDevice device;
    PFN_vkGetInstanceProcAddr getInstanceProcAddr; /**< every Vulkan function comes from here */
    uint32_t queueFamily;    /**< of the queue that the commands go to: graphics and compute */
    uint32_t framesInFlight; /**< 1 to 16; 0 is 2 */
    uint32_t features;       /**< of BrumeFeatureBits */
    uint32_t maxTicksPerFrame; /**< simulation steps of an effect per brumeCmdSimulate(); what is left
                                    is caught up later; 0 is 600 */
    VkPipelineCache pipelineCache;          /**< may be null: then Brume has one of its own */
    const VkAllocationCallbacks* allocator; /**< copied; may be null */
    /** Device memory through the host: both or neither. Each call is one VkDeviceMemory. */
    VkResult (*allocateMemory)(void* user, const VkMemoryAllocateInfo* info, VkDeviceMemory* memory);
    void (*freeMemory)(void* user, VkDeviceMemory memory); /**< see allocateMemory */
    void* memoryUser; /**< passed to both */
    uint64_t memoryBudgetBytes; /**< of device memory: more is refused; 0 is no limit */
    uint32_t shadowPairBudget;  /**< per shadow map, pairs of caster and tile, 16 bytes each; 0 is
                                     2^18. What does not fit casts no shadow and is counted. */
    uint32_t reserved; /**< 0 */
    void (*log)(void* user, BrumeLogLevel level, const char* message); /**< may be null */
    void* logUser; /**< passed to `log` */
    /** Decodes an image file held in memory; without it scenes with textures are refused. */
    BrumeResult (*readImage)(void* user, const char* name, const void* bytes, uint64_t byteCount,
                             BrumePixels* pixels);
    /** Reads a volume file, e.g. brumeReadVdb() of brume_vdb.h; without it scenes with volumes are
     *  refused. `gridIndex` -1: the only grid of that name. */
    BrumeResult (*readVolume)(void* user, const char* file, const char* grid, int32_t gridIndex,
                              BrumeDensity* density);
    void* readUser; /**< passed to the readers */
} BrumeContextCreateInfo;

/** What a scene's brumeCmdDraw() is drawn into. */
typedef enum BrumeInside {
    BRUME_INSIDE_NOTHING = 0,     /**< brumeCmdDraw() is not used */
    BRUME_INSIDE_COLOR = 1,       /**< rendering with the view's colour format alone */
    BRUME_INSIDE_COLOR_DEPTH = 2, /**< and with its depth format, neither tested nor written */
    BRUME_INSIDE_MAX_ENUM = 0x7fffffff
} BrumeInside;

/** Where a scene comes from; all may be null for an empty one. */
typedef struct BrumeSceneCreateInfo {
    uint32_t structSize; /**< set by BRUME_INIT */
    uint32_t hostLayers; /**< 1: for brumeCmdBeginLayers(); the method is "weighted" then */
    const char* file; /**< a scene file; its camera and image size are not used */
    const char* text; /**< the text of one instead */
    const char* directory; /**< what paths in `text` are relative to; null: the current directory */
    const char* method;    /**< null: the file's own, "sorted" without a file or with `inside` */
    const char* settings;  /**< of the method, "key=value key=value"; may be null */
    BrumeInside inside; /**< for brumeCmdDraw(); the method is "sorted" or "unordered" then */
    uint32_t reserved; /**< 0 */
} BrumeSceneCreateInfo;

/** Phase functions. */
typedef enum BrumePhase {
    BRUME_PHASE_ISOTROPIC = 0,
    BRUME_PHASE_RAYLEIGH = 1,
    BRUME_PHASE_HENYEY_GREENSTEIN = 2,
    BRUME_PHASE_MAX_ENUM = 0x7fffffff
} BrumePhase;

/** What smoke is made of; per unit density. */
typedef struct BrumeMedium {
    uint32_t structSize; /**< set by BRUME_INIT */
    BrumePhase phase; /**< phase function */
    const char* name;     /**< by which effects ask for it */
    double extinction[3]; /**< 1/m, >= 0 */
    double albedo[3];     /**< [0, 1] */
    double emission[3];   /**< radiance per metre, >= 0 */
    double g;             /**< of Henyey-Greenstein, [-0.999, 0.999] */
} BrumeMedium;

/** Kinds of lights. */
typedef enum BrumeLightType {
    BRUME_LIGHT_AMBIENT = 0,
    BRUME_LIGHT_DIRECTIONAL = 1,
    BRUME_LIGHT_POINT = 2,
    BRUME_LIGHT_SPOT = 3,
    BRUME_LIGHT_MAX_ENUM = 0x7fffffff
} BrumeLightType;

/** A light of the host's, for what Brume draws. */
typedef struct BrumeLight {
    uint32_t structSize; /**< set by BRUME_INIT */
    BrumeLightType type; /**< kind of light */
    double color[3]; /**< radiance (ambient), irradiance (directional), intensity (point, spot) */
    double position[3]; /**< m; point and spot */
    double direction[3]; /**< in which the light travels; any length but 0 */
    double innerAngle;   /**< radians from the axis, full light within */
    double outerAngle;   /**< no light outside; at most pi/2 */
    double radius;       /**< m; irradiance = intensity / max(d^2, radius^2); 0 is 0.01 */
    const char* shadow;  /**< a shadow store such as "visibility"; null: none */
    const char* shadowSettings; /**< "resolution=256 ..."; may be null */
} BrumeLight;

/** A soft sphere. */
typedef struct BrumeSphere {
    double center[3]; /**< m, world */
    float radius; /**< m, >= 0 */
    float density; /**< per unit of the medium, >= 0 */
    float tint[3]; /**< multiplies albedo and emission; all 0 counts as 1 */
    uint32_t smooth; /**< 0: constant density; 1: density (1 - r^2/R^2)^2 */
} BrumeSphere;

/** A particle effect, running from the call on. */
typedef struct BrumeEffect {
    uint32_t structSize; /**< set by BRUME_INIT */
    uint32_t reserved; /**< 0 */
    const char* file; /**< an effect file */
    const char* text; /**< the text of one instead */
    BrumeId medium;   /**< 0: the one that the effect names */
    double worldFromEffect[16]; /**< all 0: identity; rotation, translation, uniform scale */
    uint64_t seed; /**< equal seeds give equal particles */
    double time;         /**< s that have passed already */
    double boundsRadius; /**< m about the effect's origin, which shadow maps must show; 0: estimated
                              from speeds and lifetimes */
} BrumeEffect;

/** A density field in the scene. */
typedef struct BrumeVolume {
    uint32_t structSize; /**< set by BRUME_INIT */
    uint32_t reserved; /**< 0 */
    BrumeId medium; /**< of the density */
    const BrumeDensity* density; /**< copied */
} BrumeVolume;

/** An image of the host's: one mip level, one layer, one sample. */
typedef struct BrumeImage {
    VkImage image; /**< the host's */
    VkImageView view; /**< of all of the image */
    VkFormat format; /**< of image and view */
    VkImageLayout layout; /**< in which it comes and goes again */
    uint32_t width; /**< pixels */
    uint32_t height; /**< pixels */
} BrumeImage;

/** How the host draws its opaque scene. */
typedef struct BrumeView {
    uint32_t structSize; /**< set by BRUME_INIT */
    uint32_t leftHanded; /**< orthographic only: 1 if the view looks along +z */
    double viewFromWorld[16]; /**< rotation and translation */
    /** Perspective or orthographic, also off-centre; conventional, reversed and infinite depth ranges are
     *  told by the matrix itself. */
    double clipFromView[16];
    int32_t x; /**< left edge of the viewport in pixels of both images */
    int32_t y; /**< top edge; bottom edge for a negative height */
    int32_t width; /**< of the viewport */
    int32_t height; /**< negative: turns the image over, as in VkViewport */
    float minDepth; /**< of the viewport; both 0 counts as 0 and 1 */
    float maxDepth; /**< likewise */
    BrumeImage color; /**< usage COLOR_ATTACHMENT and SAMPLED; linear, or sRGB by its format */
    BrumeImage depth; /**< usage SAMPLED; the view has the depth aspect only; MSAA resolved */
} BrumeView;

/** Time that has passed. */
typedef struct BrumeStep {
    uint32_t structSize; /**< set by BRUME_INIT */
    uint32_t reserved; /**< 0 */
    double seconds; /**< since the last step, >= 0 and finite */
} BrumeStep;

/** What there is and what became of it, as far as the device has told; asking never waits. */
typedef struct BrumeCounters {
    uint32_t structSize; /**< set by BRUME_INIT */
    uint32_t effects; /**< instances, without their sub-emitters */
    uint64_t frames;      /**< rendered by the scene */
    uint64_t sphereSlots; /**< spheres and room for particles */
    uint64_t boxes;       /**< bricks and tiles of volumes */
    uint64_t ticksBehind; /**< steps of the simulation still to be caught up, of the worst effect */
    uint64_t shadowPairsDropped; /**< that did not fit into shadowPairBudget */
    uint64_t sceneBytes;         /**< device memory of the scene */
    uint64_t contextBytes;       /**< device memory of all scenes of the context */
    uint64_t deviceAllocations;  /**< objects with memory, of the context, that live now */
    /** Of the last finished frame, methods "tile" and "linked_list": what had no room in the memory
     *  that is reserved for lists. Such a frame shows the nearest media of each pixel. The next
     *  brumePrepare() reserves more; brumeCmd functions never do. */
    uint64_t methodDropped;
    uint64_t methodBytesWanted; /**< that all of it would have taken */
} BrumeCounters;

/** The last error of this thread as one line: what was being done, where, what is wrong, what is
 *  allowed. Valid until the thread's next call; never null. */
BRUME_API const char* brumeLastError(void);
/** "BRUME_SUCCESS" and so on. */
BRUME_API const char* brumeResultName(BrumeResult result);
/** Version of the library, as BRUME_HEADER_VERSION counts. */
BRUME_API uint32_t brumeVersion(void);

/** Makes a context. On failure *context is null. */
BRUME_API BrumeResult brumeCreateContext(const BrumeContextCreateInfo* info, BrumeContext* context);
/** Destroys a context and its scenes. The device must be done with Brume's commands. Null is fine. */
BRUME_API void brumeDestroyContext(BrumeContext context);

/** Begins a frame: all commands of frame `frameIndex` - framesInFlight are done on the device.
 *  Indices rise. Due before any brumeCmd call of the frame. */
BRUME_API BrumeResult brumeBeginFrame(BrumeContext context, uint64_t frameIndex);

/** Makes a scene from a file, from text, or empty. On failure *scene is null. */
BRUME_API BrumeResult brumeCreateScene(BrumeContext context, const BrumeSceneCreateInfo* info,
                                       BrumeScene* scene);
/** Destroys a scene; its memory goes once the frames in flight are done. Null is fine. */
BRUME_API void brumeDestroyScene(BrumeScene scene);
/** Reads the scene's effect files again if they have changed, and its scene file if nothing was
 *  added to it since. Running effects go on with the new settings, as if they had always had
 *  them. On an error nothing changes. `changed` (may be null) receives the number of files read. */
BRUME_API BrumeResult brumeReloadScene(BrumeScene scene, uint32_t* changed);

/** Adding and removing things remakes the scene's memory and pipelines at the next brumePrepare() or
 *  brumeCmd call; running effects go on. Setting is free. */
BRUME_API BrumeResult brumeAddMedium(BrumeScene scene, const BrumeMedium* medium, BrumeId* id);
BRUME_API BrumeResult brumeSetMedium(BrumeScene scene, BrumeId id, const BrumeMedium* medium);
/** The medium of that name; 0 where the scene has none. */
BRUME_API BrumeId brumeFindMedium(BrumeScene scene, const char* name);
BRUME_API BrumeResult brumeAddLight(BrumeScene scene, const BrumeLight* light, BrumeId* id);
/** Type and shadow store stay those of brumeAddLight(). */
BRUME_API BrumeResult brumeSetLight(BrumeScene scene, BrumeId id, const BrumeLight* light);
/** A group of spheres of one medium. */
BRUME_API BrumeResult brumeAddSpheres(BrumeScene scene, BrumeId medium, uint32_t count,
                                      const BrumeSphere* spheres, BrumeId* id);
/** As many as were added. */
BRUME_API BrumeResult brumeSetSpheres(BrumeScene scene, BrumeId id, const BrumeSphere* spheres);
BRUME_API BrumeResult brumeAddVolume(BrumeScene scene, const BrumeVolume* volume, BrumeId* id);
BRUME_API BrumeResult brumeAddEffect(BrumeScene scene, const BrumeEffect* effect, BrumeId* id);
BRUME_API BrumeResult brumeSetEffectTransform(BrumeScene scene, BrumeId id,
                                              const double worldFromEffect[16]);
/** The world box that an effect's particles are taken to stay in (boundsRadius, or an estimate from
 *  speeds and lifetimes), where it stands now; for culling. */
BRUME_API BrumeResult brumeGetEffectBounds(BrumeScene scene, BrumeId id, double lo[3], double hi[3]);
/** The world counts from `newOrigin` (m, in the old coordinates) from now on: all that the scene holds
 *  moves by its negative, and nothing is seen to move, given that the next view and the next
 *  transforms are in the new coordinates. Of files read later too. */
BRUME_API BrumeResult brumeRebaseScene(BrumeScene scene, const double newOrigin[3]);
/** Lights, groups of spheres, volumes and effects; media stay. What an effect had of a particle budget
 *  goes to those that were cut; they begin anew and catch up. */
BRUME_API BrumeResult brumeRemove(BrumeScene scene, BrumeId id);

/** Makes all pipelines and memory for views of this size and these formats (`view`: images' formats
 *  and sizes, viewport, matrices; no handles needed). Slow; else the first brumeCmd call does it. */
BRUME_API BrumeResult brumePrepare(BrumeScene scene, const BrumeView* view);

/** Records the simulation. Outside of rendering. */
BRUME_API BrumeResult brumeCmdSimulate(BrumeScene scene, VkCommandBuffer commands,
                                       const BrumeStep* step);
/** Records the particles' places and the shadow maps for a view, once a frame; shaders of the host
 *  may sample them afterwards. brumeCmdRender() does it where it was not called. Outside of
 *  rendering. */
BRUME_API BrumeResult brumeCmdShadow(BrumeScene scene, VkCommandBuffer commands,
                                     const BrumeView* view);
/** Records everything else: takes the view's colours and depths in and leaves the composed image in
 *  the viewport of its colours. Outside of rendering. */
BRUME_API BrumeResult brumeCmdRender(BrumeScene scene, VkCommandBuffer commands,
                                     const BrumeView* view);

/** As brumeCmdRender(), but stops where the host may draw transparent things of its own into the same
 *  order-independent composition: rendering has begun, over the size of the viewport, with two
 *  attachments R32G32B32A32_SFLOAT that take what brume_store.glsl writes. The scene was created with
 *  hostLayers. Ends with brumeCmdEndLayers(). */
BRUME_API BrumeResult brumeCmdBeginLayers(BrumeScene scene, VkCommandBuffer commands,
                                          const BrumeView* view);
/** Ends the rendering that brumeCmdBeginLayers() has begun and composes the image. */
BRUME_API BrumeResult brumeCmdEndLayers(BrumeScene scene, VkCommandBuffer commands);

/** As brumeCmdRender(), but all except for the drawing itself: for scenes with `inside` set. The
 *  viewport begins at 0, 0. Outside of rendering, after the opaque scene. */
BRUME_API BrumeResult brumeCmdPrepareDraw(BrumeScene scene, VkCommandBuffer commands,
                                          const BrumeView* view);
/** Draws into the host's rendering, over the colours that are there. Viewport and scissor are the
 *  host's: those of the view of brumeCmdPrepareDraw(), once after each. */
BRUME_API BrumeResult brumeCmdDraw(BrumeScene scene, VkCommandBuffer commands);

/** The shadow map of a light for brume_shadow.glsl, 0 where it has none. Valid for commands after
 *  brumeCmdShadow() until the scene's memory is made anew. `light`: an id; of a scene file's lights:
 *  brumeGetLight(). */
BRUME_API BrumeResult brumeGetShadow(BrumeScene scene, BrumeId light, VkDeviceAddress* address);
/** The id of the scene's light number `index`, in the order of file and calls; 0 beyond the last. */
BRUME_API BrumeId brumeGetLight(BrumeScene scene, uint32_t index);

/** Counts of the newest finished frame, or of a newer one. */
BRUME_API BrumeResult brumeGetCounters(BrumeScene scene, BrumeCounters* counters);

#ifdef __cplusplus
}
#endif
#endif
