// Loads parameters, histories and touches from the rows of a chunk into registers, and stores forces and
// histories. Each access takes as many contacts as a register holds.
#if defined(GRAINREEL_LAWS_CHUNK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_CHUNK_INL
#undef GRAINREEL_LAWS_CHUNK_INL
#else
#define GRAINREEL_LAWS_CHUNK_INL
#endif

#include "engine/laws/law_kernel.hpp"
#include "engine/laws/row-inl.hpp"
#include "engine/laws/touch-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// each() calls a visitor for each number of a history or of parameters. This is the base of these visitors. A
// `turning` triple changes sign when the bodies swap places; here it is only three numbers.
template <class Visit>
struct Visitor {
    template <class R>
    HWY_INLINE void turning(Triple<R>& t) const {
        const Visit& visit = *static_cast<const Visit*>(this);
        visit(t.x), visit(t.y), visit(t.z);
    }
};

template <class L>
struct LoadHistory : Visitor<LoadHistory<L>> {
    mutable const NumberOf<L>* at;
    explicit LoadHistory(const NumberOf<L>* from) : at(from) {}
    HWY_INLINE void operator()(L& x) const { x = load<L>(at), at += kBlock; }
};

template <class L>
struct StoreHistory : Visitor<StoreHistory<L>> {
    typename L::Mask kept;
    mutable NumberOf<L>* at;
    StoreHistory(typename L::Mask which, NumberOf<L>* to) : kept(which), at(to) {}
    HWY_INLINE void operator()(L& x) const { store(select(kept, x, L(0.0)), at), at += kBlock; }
};

template <class L>
struct SameParameters : Visitor<SameParameters<L>> {
    std::ptrdiff_t kinds;
    mutable const NumberOf<L>* at;
    SameParameters(const LawParameters& p, std::int32_t kind)
        : kinds(p.kinds), at(p.numbers<NumberOf<L>>() + kind) {}
    HWY_INLINE void operator()(L& x) const { x = L(static_cast<double>(*at)), at += kinds; }
};

template <class L>
struct ParametersOfKind : Visitor<ParametersOfKind<L>> {
    using Tag = typename L::Tag;
    using Indices = hn::RebindToSigned<Tag>;
    hn::Vec<Indices> kind;
    std::ptrdiff_t kinds;
    mutable const NumberOf<L>* at;
    ParametersOfKind(const LawParameters& p, const std::int32_t* kind_of)
        : kind(indices(kind_of)), kinds(p.kinds), at(p.numbers<NumberOf<L>>()) {}
    HWY_INLINE void operator()(L& x) const {
        x = L(hn::GatherIndex(Tag(), at, kind));
        at += kinds;
    }
    static HWY_INLINE hn::Vec<Indices> indices(const std::int32_t* kind_of) {
        if constexpr (sizeof(NumberOf<L>) == sizeof(std::int32_t))
            return hn::LoadU(Indices(), kind_of);
        else
            return hn::PromoteTo(Indices(), hn::LoadU(hn::Rebind<std::int32_t, Tag>(), kind_of));
    }
};

template <class Law, class L>
HWY_INLINE typename Law::template Parameters<L> parameters_at(const LawInput& in, int c) {
    typename Law::template Parameters<L> p;
    p.each(ParametersOfKind<L>(*in.parameters, in.kind + c));
    return p;
}

template <class Number, class L>
HWY_INLINE void put_where(typename L::Mask which, L value, Row& to, int c) {
    put<Number>(select(which, value, L(0.0)), to, c);
}
template <class Number, class L>
HWY_INLINE void put_where(typename L::Mask which, const Triple<L>& t, Row* to, int c) {
    put<Number>(select(which, t, Triple<L>{L(0.0), L(0.0), L(0.0)}), to, c);
}

template <class L, class Number>
HWY_INLINE typename L::Mask touching_at(const LawInput& in, int c) {
    return row_at<L, Number>(in.touch->overlap, c) > L(0.0);
}

template <class Law, class L, class Number>
HWY_INLINE Touch<L> touch_at(const LawInput& in, int c) {
    const TouchChunk& chunk = *in.touch;
    Touch<L> t;
    t.normal = triple_at<L, Number>(chunk.normal, c);
    t.overlap = row_at<L, Number>(chunk.overlap, c);
    t.turn = {L(0.0), L(0.0), L(0.0)};
    if constexpr (Law::rubs) t.turn = triple_at<L, Number>(chunk.turn, c);
    t.inverse_mass = t.effective_mass = t.effective_radius = L(0.0);
    if constexpr (Law::uses_mass) {
        t.inverse_mass = row_at<L, Number>(chunk.inverse_mass, c);
        t.effective_mass = L(1.0) / t.inverse_mass;
    }
    if constexpr (Law::uses_radius) t.effective_radius = row_at<L, Number>(chunk.effective_radius, c);
    t.closing_speed = t.step = L(0.0);
    t.slip = t.slip_velocity = {L(0.0), L(0.0), L(0.0)};
    return t;
}

template <class Law, class L, class Number>
HWY_INLINE Triple<L> velocity_at(const LawInput& in, int c) {
    if constexpr (Law::rubs || Law::uses_velocity) {
        return triple_at<L, Number>(in.touch->velocity, c);
    } else {
        return {L(0.0), L(0.0), L(0.0)};
    }
}

template <class Law, class L, class Number, class Force>
HWY_INLINE void put_force(typename L::Mask touching, const Force& f, int c, ForceChunk& out) {
    put_where<Number>(touching, f.normal, out.normal, c);
    if constexpr (Law::rubs) put_where<Number>(touching, f.tangential, out.tangential, c);
}

template <class Law, class L>
HWY_INLINE void put_nothing(int c, ForceChunk& out) {
    store(L(0.0), out.normal.of<NumberOf<L>>() + c);
    if constexpr (Law::rubs) {
        for (Row& axis : out.tangential) store(L(0.0), axis.of<NumberOf<L>>() + c);
    }
}

// Place of the first number of contact c in a history with `stride` numbers for each contact.
HWY_INLINE std::size_t place_in_history(int c, std::size_t stride) {
    return (c / kBlock) * (stride * kBlock) + c % kBlock;
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
