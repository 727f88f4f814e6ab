// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <core/error.hpp>
#include <particles/fields.hpp>

namespace brume::particles {
namespace {

constexpr const char* kDoing = "setting up an effect";
constexpr std::size_t kMaxValues = std::size_t{1} << 25u;  // 128 MiB, what every device can bind

std::string describe(const scene::FieldSource& source) {
    return fmt::format("{}: grid \"{}\"", source.file, source.grid);
}

}  // namespace

dmat4 effectFromFile(const scene::FieldPlacement& placement) {
    return glm::scale(glm::translate(dmat4(1), placement.position), dvec3(placement.scale));
}

dmat4 effectFromIndex(const scene::FieldPlacement& placement, const scene::FieldValues& field) {
    return effectFromFile(placement) * field.fileFromIndex;
}

const scene::FieldValues& findField(const scene::Effect& effect,
                                    const scene::FieldPlacement& placement, int componentCount) {
    const auto found = effect.fields.find(placement.source);
    if (found == effect.fields.end())
        throw inputError(kDoing, placement.where,
                         describe(placement.source) + " is not loaded, loaded grids are allowed");
    const scene::FieldValues& field = *found->second;
    if (field.componentCount != componentCount)
        throw inputError(kDoing, placement.where,
                         fmt::format("{} has values of {} components, {} allowed",
                                     describe(placement.source), field.componentCount,
                                     componentCount));
    return field;
}

shader::FieldGrid FieldPacker::add(const scene::FieldPlacement& placement,
                                   const scene::FieldValues& field, double outside) {
    const auto [entry, isNew] =
        mFirstValue.try_emplace(&field, static_cast<std::uint32_t>(mValues->size()));
    if (isNew) {
        if (mValues->size() + field.values.size() > kMaxValues)
            throw inputError(kDoing, placement.where,
                             fmt::format("the effect's grids have more than {} values, at most that "
                                         "many are allowed",
                                         kMaxValues));
        mValues->insert(mValues->end(), field.values.begin(), field.values.end());
    }
    const dmat4 map = glm::inverse(effectFromIndex(placement, field));
    shader::FieldGrid grid{};
    grid.axisX = vec3(dvec3(map[0]));
    grid.axisY = vec3(dvec3(map[1]));
    grid.axisZ = vec3(dvec3(map[2]));
    grid.origin = vec3(dvec3(map[3]) - dvec3(field.lo));
    grid.size = shader::uvec3(field.size);
    grid.firstValue = entry->second;
    grid.componentCount = static_cast<std::uint32_t>(field.componentCount);
    grid.isStaggered = field.isStaggered;
    grid.outside = static_cast<float>(outside);
    return grid;
}

}  // namespace brume::particles
