// Loads bundles of four numbers from scattered places in memory into four registers: each register holds one
// of the four numbers, in one lane for each bundle. Other functions turn registers back into bundles.
#if defined(GRAINREEL_VECTOR_BUNDLES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_VECTOR_BUNDLES_INL
#undef GRAINREEL_VECTOR_BUNDLES_INL
#else
#define GRAINREEL_VECTOR_BUNDLES_INL
#endif

#include <utility>

#include "engine/vector/bundle-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

template <class D>
struct Four {
    hn::Vec<D> a, b, c, d;
};

// As many bundles as there are lanes.
template <int size>
struct Rows {
    Bundle<size> bundles[kLanes];

    template <int k>
    HWY_INLINE Bundle<size> row() const {
        return bundles[k];
    }
};

#if HWY_TARGET == HWY_SCALAR

template <class D = Doubles>
HWY_INLINE Four<D> load_bundles(const hn::TFromD<D>* base, std::size_t stride, const std::int32_t* index) {
    const D d;
    const auto* at = base + stride * static_cast<std::size_t>(*index);
    return {hn::Load(d, at), hn::Load(d, at + 1), hn::Load(d, at + 2), hn::Load(d, at + 3)};
}

// a - b for the first three numbers, a + b for the fourth.
template <class D = Doubles>
HWY_INLINE Four<D> load_relative(const hn::TFromD<D>* base, std::size_t stride, const std::int32_t* a,
                                 const std::int32_t* b) {
    const Four<D> one = load_bundles<D>(base, stride, a), two = load_bundles<D>(base, stride, b);
    return {hn::Sub(one.a, two.a), hn::Sub(one.b, two.b), hn::Sub(one.c, two.c), hn::Add(one.d, two.d)};
}

HWY_INLINE Rows<4> rows_of(const Four<Doubles>& f) {
    return {{{{f.a, f.b, f.c, f.d}}}};
}

HWY_INLINE Rows<8> rows_of(const Four<Doubles>& f, const Four<Doubles>& g) {
    return {{{{f.a, f.b, f.c, f.d, g.a, g.b, g.c, g.d}}}};
}

template <int size>
struct FloatRows {
    hn::Vec<Floats> part[size];

    template <int>
    HWY_INLINE Bundle<size> row() const {
        Bundle<size> r;
        for (int p = 0; p < size; ++p) r.part[p] = hn::PromoteTo(Doubles(), part[p]);
        return r;
    }
};
HWY_INLINE FloatRows<4> float_rows_of(const Four<Floats>& f) {
    return {{f.a, f.b, f.c, f.d}};
}
HWY_INLINE FloatRows<8> float_rows_of(const Four<Floats>& f, const Four<Floats>& g) {
    return {{f.a, f.b, f.c, f.d, g.a, g.b, g.c, g.d}};
}

#else

// Transposes rows of 128-bit blocks. Before, row k holds the blocks (a b)(c d) of bundles k and k + 4;
// afterwards `a` holds the first number of all bundles, and so on. The same steps undo it.
template <class D>
HWY_INLINE Four<D> transposed(D d, const Four<D>& r) {
    const auto low01 = hn::InterleaveLower(d, r.a, r.b), high01 = hn::InterleaveUpper(d, r.a, r.b);
    const auto low23 = hn::InterleaveLower(d, r.c, r.d), high23 = hn::InterleaveUpper(d, r.c, r.d);
    return {hn::OddEvenBlocks(hn::SwapAdjacentBlocks(low23), low01),
            hn::OddEvenBlocks(hn::SwapAdjacentBlocks(high23), high01),
            hn::OddEvenBlocks(low23, hn::SwapAdjacentBlocks(low01)),
            hn::OddEvenBlocks(high23, hn::SwapAdjacentBlocks(high01))};
}

template <class D>
HWY_INLINE hn::Vec<D> both_halves(D d, const double* low, const double* high) {
    const hn::Half<D> half;
    return hn::Combine(d, hn::Load(half, high), hn::Load(half, low));
}

// Loads four numbers from each address, of which there is one for each lane, aligned to 32 bytes. They are
// not transposed yet.
template <class D>
HWY_INLINE Four<D> rows_at(D d, const double* const* at) {
    if constexpr (hn::MaxLanes(D()) == 8) {
        return {both_halves(d, at[0], at[4]), both_halves(d, at[1], at[5]), both_halves(d, at[2], at[6]),
                both_halves(d, at[3], at[7])};
    } else if constexpr (hn::MaxLanes(D()) == 4) {
        return {hn::Load(d, at[0]), hn::Load(d, at[1]), hn::Load(d, at[2]), hn::Load(d, at[3])};
    } else {
        return {hn::Load(d, at[0]), hn::Load(d, at[1]), hn::Load(d, at[0] + 2), hn::Load(d, at[1] + 2)};
    }
}
template <class D>
HWY_INLINE Four<D> transposed_rows(D d, const Four<D>& r) {
    if constexpr (hn::MaxLanes(D()) >= 4)
        return transposed(d, r);
    else
        return {hn::InterleaveLower(d, r.a, r.b), hn::InterleaveUpper(d, r.a, r.b),
                hn::InterleaveLower(d, r.c, r.d), hn::InterleaveUpper(d, r.c, r.d)};
}

// Loads a block of 128 bits from every fourth address.
template <class D>
HWY_INLINE hn::Vec<D> every_fourth(D d, const float* const* at) {
    if constexpr (hn::MaxLanes(D()) == 4) {
        return hn::Load(d, at[0]);
    } else {
        const hn::Half<D> half;
        return hn::Combine(d, every_fourth(half, at + hn::MaxLanes(half)), every_fourth(half, at));
    }
}

// Transposes four rows. Row k has bundles k, k + 4, ... in its blocks of 128 bits; afterwards `a` has the
// first number of all bundles, and so on. The same steps undo it.
template <class D>
HWY_INLINE Four<D> transposed_floats(D d, const Four<D>& r) {
    const hn::Repartition<double, D> pairs;
    const auto low01 = hn::BitCast(pairs, hn::InterleaveLower(d, r.a, r.b));
    const auto low23 = hn::BitCast(pairs, hn::InterleaveLower(d, r.c, r.d));
    const auto high01 = hn::BitCast(pairs, hn::InterleaveUpper(d, r.a, r.b));
    const auto high23 = hn::BitCast(pairs, hn::InterleaveUpper(d, r.c, r.d));
    return {hn::BitCast(d, hn::InterleaveLower(pairs, low01, low23)),
            hn::BitCast(d, hn::InterleaveUpper(pairs, low01, low23)),
            hn::BitCast(d, hn::InterleaveLower(pairs, high01, high23)),
            hn::BitCast(d, hn::InterleaveUpper(pairs, high01, high23))};
}

// rows_at() for bundles of four floats, aligned to 16 bytes.
template <class D>
HWY_INLINE Four<D> rows_at(D d, const float* const* at) {
    return {every_fourth(d, at), every_fourth(d, at + 1), every_fourth(d, at + 2), every_fourth(d, at + 3)};
}
template <class D>
requires(sizeof(hn::TFromD<D>) == sizeof(float)) HWY_INLINE Four<D> transposed_rows(D d, const Four<D>& r) {
    return transposed_floats(d, r);
}

// The first four numbers of bundles index[0] ... index[lanes - 1], which have `stride` numbers each.
template <class D>
HWY_INLINE Four<D> rows_of_bundles(const hn::TFromD<D>* base, std::size_t stride, const std::int32_t* index) {
    const hn::TFromD<D>* at[hn::MaxLanes(D())];
    for (std::size_t k = 0; k < hn::MaxLanes(D()); ++k)
        at[k] = base + stride * static_cast<std::size_t>(index[k]);
    return rows_at(D(), at);
}
template <class D = Doubles>
HWY_INLINE Four<D> load_bundles(const hn::TFromD<D>* base, std::size_t stride, const std::int32_t* index) {
    return transposed_rows(D(), rows_of_bundles<D>(base, stride, index));
}

// a - b for the first three numbers and a + b for the fourth. This takes half as many shuffles as two
// operations.
template <class D = Doubles>
HWY_INLINE Four<D> load_relative(const hn::TFromD<D>* base, std::size_t stride, const std::int32_t* a,
                                 const std::int32_t* b) {
    using T = hn::TFromD<D>;
    HWY_ALIGN static constexpr T signs[16] = {-1, -1, -1, 1, -1, -1, -1, 1, -1, -1, -1, 1, -1, -1, -1, 1};
    const D d;
    const Four<D> one = rows_of_bundles<D>(base, stride, a), two = rows_of_bundles<D>(base, stride, b);
    constexpr bool split = hn::MaxLanes(D()) < 4;  // c and d have the third and fourth numbers
    const auto low = hn::Load(d, signs), high = hn::Load(d, signs + (split ? 2 : 0));
    return transposed_rows(d, Four<D>{hn::MulAdd(two.a, low, one.a), hn::MulAdd(two.b, low, one.b),
                                      hn::MulAdd(two.c, high, one.c), hn::MulAdd(two.d, high, one.d)});
}

// `count` numbers of a register from the n-th on.
template <int count, int n, class D>
HWY_INLINE auto some_of(D, hn::Vec<D> v) {
    constexpr int half_lanes = static_cast<int>(hn::MaxLanes(D())) / 2;
    if constexpr (count > half_lanes) {
        return v;
    } else {
        const hn::Half<D> half;
        if constexpr (n < half_lanes)
            return some_of<count, n>(half, hn::LowerHalf(half, v));
        else
            return some_of<count, n - half_lanes>(half, hn::UpperHalf(half, v));
    }
}

// As many bundles of four or eight floats as a register has lanes. Bundles of four are in four registers as
// transposed_floats() leaves them. Bundles of eight are in eight registers; registers 2 k and 2 k + 1 share
// bundles k, k + 4, ...
template <int size>
struct FloatRows {
    hn::Vec<Floats> part[size];

    template <int k>
    HWY_INLINE Bundle<size> row() const {
        return [this]<int... p>(std::integer_sequence<int, p...>) HWY_ATTR {
            using R = Bundle<size>;
            return R{{hn::PromoteTo(typename R::D(), some_of<R::lanes, at(k, p * R::lanes) % lanes>(
                                                         Floats(), part[at(k, p * R::lanes) / lanes]))...}};
        }
        (std::make_integer_sequence<int, Bundle<size>::parts>());
    }

  private:
    static constexpr int lanes = static_cast<int>(hn::MaxLanes(Floats()));
    // The place of number m of bundle k, counted through all registers.
    static constexpr int at(int k, int m) {
        const int row = k % 4, block = k / 4;
        if (size == 4) return row * lanes + block * 4 + m;
        if (lanes == 4) return 2 * row * lanes + m;
        return (2 * row + block % 2) * lanes + block / 2 * 8 + m;
    }
};
HWY_INLINE FloatRows<4> float_rows_of(const Four<Floats>& f) {
    const Four<Floats> r = transposed_floats(Floats(), f);
    return {{r.a, r.b, r.c, r.d}};
}
// The even blocks of both registers in turn, or the odd ones.
HWY_INLINE hn::Vec<Floats> even_blocks(hn::Vec<Floats> f, hn::Vec<Floats> g) {
    if constexpr (hn::MaxLanes(Floats()) == 4)
        return f;
    else
        return hn::OddEvenBlocks(hn::SwapAdjacentBlocks(g), f);
}
HWY_INLINE hn::Vec<Floats> odd_blocks(hn::Vec<Floats> f, hn::Vec<Floats> g) {
    if constexpr (hn::MaxLanes(Floats()) == 4)
        return g;
    else
        return hn::OddEvenBlocks(g, hn::SwapAdjacentBlocks(f));
}
HWY_INLINE FloatRows<8> float_rows_of(const Four<Floats>& f, const Four<Floats>& g) {
    const Four<Floats> r = transposed_floats(Floats(), f), s = transposed_floats(Floats(), g);
    return {{even_blocks(r.a, s.a), odd_blocks(r.a, s.a), even_blocks(r.b, s.b), odd_blocks(r.b, s.b),
             even_blocks(r.c, s.c), odd_blocks(r.c, s.c), even_blocks(r.d, s.d), odd_blocks(r.d, s.d)}};
}

// The opposite of load_bundles(): from registers into bundles.
template <class D>
HWY_INLINE Rows<4> rows_of(const Four<D>& f) {
    const D d;
    Rows<4> rows;
    if constexpr (hn::MaxLanes(D()) == 8) {
        const Four<D> r = transposed(d, f);
        const hn::Half<D> half;
        rows.bundles[0].part[0] = hn::LowerHalf(half, r.a),
        rows.bundles[4].part[0] = hn::UpperHalf(half, r.a);
        rows.bundles[1].part[0] = hn::LowerHalf(half, r.b),
        rows.bundles[5].part[0] = hn::UpperHalf(half, r.b);
        rows.bundles[2].part[0] = hn::LowerHalf(half, r.c),
        rows.bundles[6].part[0] = hn::UpperHalf(half, r.c);
        rows.bundles[3].part[0] = hn::LowerHalf(half, r.d),
        rows.bundles[7].part[0] = hn::UpperHalf(half, r.d);
    } else if constexpr (hn::MaxLanes(D()) == 4) {
        const Four<D> r = transposed(d, f);
        rows.bundles[0].part[0] = r.a, rows.bundles[1].part[0] = r.b;
        rows.bundles[2].part[0] = r.c, rows.bundles[3].part[0] = r.d;
    } else {
        rows.bundles[0].part[0] = hn::InterleaveLower(d, f.a, f.b);
        rows.bundles[0].part[1] = hn::InterleaveLower(d, f.c, f.d);
        rows.bundles[1].part[0] = hn::InterleaveUpper(d, f.a, f.b);
        rows.bundles[1].part[1] = hn::InterleaveUpper(d, f.c, f.d);
    }
    return rows;
}

// The same for bundles of eight: f holds their first four numbers, g the other four.
template <class D>
HWY_INLINE Rows<8> rows_of(const Four<D>& f, const Four<D>& g) {
    Rows<8> rows;
    if constexpr (hn::MaxLanes(D()) == 8) {
        const D d;
        const Four<D> r = transposed(d, f), s = transposed(d, g);
        rows.bundles[0].part[0] = hn::ConcatLowerLower(d, s.a, r.a);
        rows.bundles[1].part[0] = hn::ConcatLowerLower(d, s.b, r.b);
        rows.bundles[2].part[0] = hn::ConcatLowerLower(d, s.c, r.c);
        rows.bundles[3].part[0] = hn::ConcatLowerLower(d, s.d, r.d);
        rows.bundles[4].part[0] = hn::ConcatUpperUpper(d, s.a, r.a);
        rows.bundles[5].part[0] = hn::ConcatUpperUpper(d, s.b, r.b);
        rows.bundles[6].part[0] = hn::ConcatUpperUpper(d, s.c, r.c);
        rows.bundles[7].part[0] = hn::ConcatUpperUpper(d, s.d, r.d);
    } else {
        const Rows<4> r = rows_of(f), s = rows_of(g);
        for (int k = 0; k < kLanes; ++k) rows.bundles[k] = both(r.bundles[k], s.bundles[k]);
    }
    return rows;
}

#endif

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
