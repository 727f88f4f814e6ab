// SPDX-License-Identifier: Apache-2.0
// The stores listed in this folder's CMakeLists, by name.
#include <core/error.hpp>
#include <shadows/shadow_store.hpp>

namespace brume::shadows {

namespace {

struct Registration {
    const StoreInfo& (*info)();
    std::unique_ptr<ShadowStore> (*create)(gpu::Device&, const StoreRequest&,
                                           const scene::Settings&);
};

}  // namespace

#include <shadows/registered_stores.inc>

namespace {

const Registration& findStore(std::string_view name) {
    std::string known;
    for (const Registration& store : kStores) {
        if (store.info().name == name) return store;
        known += std::string(store.info().name) + ", ";
    }
    throw inputError("setting up the renderer", "shadow \"" + std::string(name) + "\"",
                     "unknown, known are " + known + "none");
}

}  // namespace

std::span<const StoreInfo> listStores() {
    static const std::vector<StoreInfo> infos = [] {
        std::vector<StoreInfo> list;
        for (const Registration& store : kStores) list.push_back(store.info());
        return list;
    }();
    return infos;
}

std::uint32_t storeBits(std::string_view name) {
    if (name == "none") return 0;
    const std::uint32_t bit = findStore(name).info().bit;
    return bit == shader::kStoreExact ? bit : bit | shader::kStoreOpaque;
}

std::unique_ptr<ShadowStore> createStore(const std::string& name, gpu::Device& device,
                                         const StoreRequest& request,
                                         const scene::Settings& settings) {
    return findStore(name).create(device, request, settings);
}

}  // namespace brume::shadows
