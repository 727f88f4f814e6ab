// SPDX-License-Identifier: Apache-2.0
#include <particles/budget.hpp>
#include <particles/compiled_effect.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

namespace brume::particles {
namespace {

std::uint32_t wantedBy(const scene::Effect& effect) {
    return effect.uncutCapacity > 0 ? effect.uncutCapacity : effect.capacity;
}

void setCapacity(scene::Effect& effect, std::uint32_t capacity) {
    const std::uint32_t wanted = wantedBy(effect);
    effect.uncutCapacity = capacity < wanted ? wanted : 0;
    effect.capacity = capacity;
}

/// The effect with the capacities of its populations, in their order.
scene::Effect withCapacities(scene::Effect effect, const std::uint32_t*& next) {
    setCapacity(effect, *next++);
    for (scene::SubEmitter& sub : effect.subEmitters)
        sub.effect =
            std::make_shared<const scene::Effect>(withCapacities(*sub.effect, next));
    return effect;
}

/// What is left to hand out.
class Purse {
  public:
    explicit Purse(std::uint64_t limit)
        : mLeft(limit > 0 ? limit : std::numeric_limits<std::uint64_t>::max()) {}
    std::uint64_t left() const { return mLeft; }
    void take(std::uint64_t count) { mLeft -= count; }

  private:
    std::uint64_t mLeft;
};

}  // namespace

BudgetCut applyBudgets(scene::Scene& scene) {
    BudgetCut cut;
    Purse all(scene.particleBudget);
    std::map<std::pair<std::filesystem::path, std::size_t>, Purse> purses;  // by file, population
    for (std::size_t root = 0, end = 0; root < scene.effects.size(); root = end) {
        std::vector<std::uint32_t> capacities;
        bool isNew = false;
        for (end = root; end == root || (end < scene.effects.size() &&
                                         scene.effects[end].isSubEmitter);
             ++end) {
            scene::EffectInstance& entry = scene.effects[end];
            // Effects made in code have no file to know them by: each has its own budget.
            const std::pair key(entry.file, entry.file.empty() ? end : end - root);
            Purse& own = purses.try_emplace(key, entry.effect.budget).first->second;
            const auto granted = static_cast<std::uint32_t>(
                std::min<std::uint64_t>({wantedBy(entry.effect), own.left(), all.left()}));
            own.take(granted);
            all.take(granted);
            cut.wanted += wantedBy(entry.effect);
            cut.granted += granted;
            if (granted < wantedBy(entry.effect) && cut.entries++ == 0) cut.first = end;
            isNew |= granted != entry.effect.capacity;
            capacities.push_back(granted);
        }
        if (!isNew) continue;
        cut.changed.push_back(root);
        const std::uint32_t* next = capacities.data();
        scene.effects[root].effect = withCapacities(scene.effects[root].effect, next);
        for (std::size_t i = root + 1; i < end; ++i)
            setCapacity(scene.effects[i].effect, capacities[i - root]);
    }
    return cut;
}

void warnOfCut(const BudgetCut& cut, const scene::Scene& scene, const Log& log) {
    if (cut.entries == 0 || cut.changed.empty()) return;
    const scene::EffectInstance& first = scene.effects[cut.first];
    log.warning(fmt::format(
        "setting up effects: the budget leaves room for {} of {} particles; {} of {} effects are cut, "
        "from effect {} on{}",
        cut.granted, cut.wanted, cut.entries, scene.effects.size(), cut.first,
        first.file.empty() ? "" : " (" + first.file.filename().string() + ")"));
}

}  // namespace brume::particles
