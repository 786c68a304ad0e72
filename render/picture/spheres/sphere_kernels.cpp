// Gathers the hot loops of drawing spheres (*-inl.hpp) for each instruction set.
#include "render/picture/spheres/sphere_kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/picture/spheres/sphere_kernels.cpp"
#include "engine/vector/targets.hpp"
//
#include "render/picture/spheres/draw-inl.hpp"
#include "render/picture/spheres/light/light-inl.hpp"
#include "render/picture/spheres/light/wall-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

const SphereKernels* kernels_here() {
    static constexpr SphereKernels kernels{draw,   draw_shape,    farthest, mark_changes, mark_edges,
                                           settle, settle_shapes, light,    light_wall};
    return &kernels;
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grainreel {

HWY_EXPORT(kernels_here);

const SphereKernels& sphere_kernels() {
    static const SphereKernels* const best = HWY_DYNAMIC_DISPATCH(kernels_here)();
    return *best;
}

}  // namespace grainreel
#endif
