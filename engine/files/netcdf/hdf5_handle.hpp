// Handles of the HDF5 library that close themselves.
#pragma once

#include <hdf5.h>

#include <memory>

namespace grainreel {

// A handle of the library, which is closed with its last owner. Null where the library has none.
inline std::shared_ptr<void> owned(hid_t id, herr_t (*close)(hid_t)) {
    if (id < 0) return nullptr;
    auto* const held = new hid_t(id);
    return std::shared_ptr<void>(held, [close](void* pointer) {
        auto* const one = static_cast<hid_t*>(pointer);
        close(*one);
        delete one;
    });
}

inline hid_t id_of(const std::shared_ptr<void>& handle) {
    return *static_cast<const hid_t*>(handle.get());
}

}  // namespace grainreel
