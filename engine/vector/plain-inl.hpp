// Products of triples that give the same bits as those of Vec3: nothing is fused, and terms are added in the
// same order. So the kernels agree with code that computes one contact at a time.
#if defined(GRAINREEL_VECTOR_PLAIN_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_VECTOR_PLAIN_INL
#undef GRAINREEL_VECTOR_PLAIN_INL
#else
#define GRAINREEL_VECTOR_PLAIN_INL
#endif

#include "engine/vector/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

HWY_INLINE Lanes plain_dot(const Triple<Lanes>& a, const Triple<Lanes>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
HWY_INLINE Triple<Lanes> plain_cross(const Triple<Lanes>& a, const Triple<Lanes>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
