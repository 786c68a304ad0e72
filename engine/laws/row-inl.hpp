// Loads and stores registers from and to Rows. A Row (law_kernel.hpp) holds one number for each contact of a
// chunk, and `c` is the first of the contacts in the register.
#if defined(GRAINREEL_LAWS_ROW_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_ROW_INL
#undef GRAINREEL_LAWS_ROW_INL
#else
#define GRAINREEL_LAWS_ROW_INL
#endif

#include "engine/laws/law_kernel.hpp"
#include "engine/vector/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// `Number` is the type of the numbers in a row. In a step it is that of L. Observers keep doubles in rows,
// even if L is of floats.
template <class L, class Number = NumberOf<L>>
HWY_INLINE L row_at(const Row& from, int c) {
    return load_as<L>(from.of<Number>() + c);
}
template <class L, class Number = NumberOf<L>>
HWY_INLINE Triple<L> triple_at(const Row* from, int c) {
    return {row_at<L, Number>(from[0], c), row_at<L, Number>(from[1], c), row_at<L, Number>(from[2], c)};
}

template <class Number, class L>
HWY_INLINE void put(L value, Row& to, int c) {
    store_as(value, to.of<Number>() + c);
}
template <class Number, class L>
HWY_INLINE void put(const Triple<L>& t, Row* to, int c) {
    put<Number>(t.x, to[0], c), put<Number>(t.y, to[1], c), put<Number>(t.z, to[2], c);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
